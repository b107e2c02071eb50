#pragma once

#include <functional>
#include <vector>

#include "methods/registry.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/proxy_keeper.hpp"

namespace elastolab {

/// Vertices of a preview's proxy, which a worker has ready within a second.
inline constexpr int kPreviewVertices = 500;

/// Whether the scene's body is not ready before a person has looked at it.
bool is_worth_a_preview(const LiveScene& scene);

/// What answers while a method cannot: one coarse answer for all linear methods, and one for a method that is not
/// linear while its equilibria take long, by the same method. Each is on the scene's own surface where that is coarse
/// enough, else on a proxy of it. All members are for one thread.
class Previews {
public:
    /// `wake` is called by the workers when an update will find something.
    explicit Previews(const std::function<void()>& wake) : linear_(wake), finite_(wake) {}

    /// Chooses what is needed where these methods are shown, the first of them first; first_answers: it has answered.
    void choose(const LiveScene& scene, const std::vector<MethodKind>& shown, bool first_answers, bool wanted);
    bool need_proxy() const { return (has_linear_ && on_itself_ == nullptr) || finite_kind_ != nullptr; }

    /// Each brings a preview up to date with the scene and returns whether its displacements changed. That of a method
    /// that is not linear follows while the method itself cannot; `method` is that of finite_kind(), if there is one.
    bool update_linear(const LiveScene& scene, const ProxyKeeper& proxies, FrameRule rule);
    bool update_finite(const LiveScene& scene, const ProxyKeeper& proxies, const MethodRunner* method);

    /// The one that answers for a method.
    const EmbeddedRunner& of(MethodKind kind) const { return kind->linear ? linear_ : finite_; }
    /// Whether it is asked what the scene asks for.
    bool follow(MethodKind kind) const { return kind->linear ? has_linear_ : finite_kind_ && finite_follows_; }
    /// The method on the screen that is not linear and needs a preview; null when there is none.
    MethodKind finite_kind() const { return finite_kind_; }
    bool any() const { return has_linear_ || finite_kind_ != nullptr; }
    /// One that is needed cannot answer yet, and will by itself.
    bool preparing() const;
    /// The same, and what is on its way takes more than a moment, as a linear one's constrained set does not.
    bool hold_up_methods() const;

    /// Constraints that may be asked for soon.
    void prefetch(const Constraints& constraints);
    void retry();
    void cancel();
    /// Whether a worker has not ended yet, after cancel().
    bool stopping() const { return linear_.stopping() || finite_.stopping(); }

private:
    EmbeddedRunner linear_;
    bool has_linear_ = false;
    MethodKind on_itself_ = nullptr;  ///< simulates the scene's own surface as linear_; null: a proxy does
    EmbeddedRunner finite_;
    MethodKind finite_kind_ = nullptr;
    bool finite_follows_ = false;
};

}  // namespace elastolab
