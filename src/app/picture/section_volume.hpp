#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "deform/volume.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/method_runner.hpp"

namespace elastolab {

/// The inside of a body that is to be cut open, made on a worker. One serves all models of the body that have the same
/// Poisson's ratio: nothing else changes how the inside follows the surface.
class SectionVolume {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit SectionVolume(std::function<void()> wake) : job_(std::move(wake)) {}

    /// Of the body that `runner` answers for; begins to make it when it is not there. Null until it is, and for methods
    /// that have none. forget() must be called when the body changes.
    const Volume* of(const MethodRunner& runner);
    void forget();

    /// Takes over what the worker finished. Whether there is something new to see: the inside, or failure().
    bool poll();
    /// Why the last attempt failed, for the user; empty when it did not.
    const std::string& failure() const { return job_.failure(); }
    void cancel() { job_.cancel(); }
    bool running() const { return job_.running(); }
    bool working() const { return job_.working(); }

private:
    std::shared_ptr<const Volume> volume_;
    std::optional<double> poisson_ratio_;  ///< that volume_ is for, or will be
    BackgroundJob<std::shared_ptr<const Volume>> job_;
};

}  // namespace elastolab
