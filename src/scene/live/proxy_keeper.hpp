#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/live/background_job.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// Keeps the proxies of the scene's surface, made on a worker thread: one that is simulated in place of the surface,
/// and a coarser one that answers while the other models are being computed. All members are for one thread.
class ProxyKeeper {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit ProxyKeeper(std::function<void()> wake) : job_(std::move(wake)) {}

    /// Asks for the proxy of the scene's choice and a preview of so many vertices (0: none) of the scene's surface.
    /// Nothing happens when they are the present ones.
    void ask(const LiveScene& scene, bool needs_model, int n_preview_vertices);
    /// Takes over what the worker finished; true when there is something new.
    bool poll();

    /// Null until it is there, and when it was not asked for.
    const std::shared_ptr<const Proxy>& model() const { return model_; }
    const std::shared_ptr<const Proxy>& preview() const { return preview_; }
    /// Why there is none; empty when there is or will be.
    const std::string& failure() const { return failure_; }
    bool running() const { return job_.running(); }
    JobStatus status() const { return job_.status(); }
    void cancel();
    void retry();
    bool working() const { return job_.working(); }

private:
    struct Made {
        std::shared_ptr<const Proxy> model, preview;
        std::string failure;  ///< why there is no model
    };
    void begin();
    void begin_proxies(bool needs_model, bool needs_preview);
    void begin_filling(bool needs_preview);

    std::shared_ptr<const SurfaceMesh> surface_;
    MeshReport report_;
    std::string name_;
    std::optional<ProxyChoice> choice_;  ///< none: no model is wanted
    OpenSurface taken_for_ = OpenSurface::automatic;
    int n_preview_ = 0;
    std::shared_ptr<const Proxy> model_, preview_;
    std::string failure_;
    BackgroundJob<Made> job_;
};

}  // namespace elastolab
