#pragma once

#include <atomic>

namespace elastolab {

/// Thrown by Control::checkpoint after a cancel; control flow, not an Error.
struct Cancelled {};

/// The one object that a worker and its watcher share: cancel in, progress out. All members may be called from any
/// thread.
class Control {
public:
    void cancel() { cancelled_ = true; }
    bool cancelled() const { return cancelled_; }

    /// Throws Cancelled once cancel() was called. Long loops call it every few milliseconds.
    void checkpoint() const {
        if (cancelled_) throw Cancelled{};
    }

    /// Names the stage that begins; its progress restarts at zero. `name` must have static storage.
    void begin_stage(const char* name) {
        fraction_ = 0.0;
        stage_ = name;
        checkpoint();
    }
    const char* stage() const { return stage_; }

    /// Progress of the present stage in [0, 1].
    void set_progress(double fraction) { fraction_ = fraction; }
    double progress() const { return fraction_; }

private:
    std::atomic<bool> cancelled_{false};
    std::atomic<const char*> stage_{""};
    std::atomic<double> fraction_{0.0};
};

}  // namespace elastolab
