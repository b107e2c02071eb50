#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "methods/registry.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/method_runner.hpp"

namespace elastolab {

/// What a person may choose about the methods.
struct MethodChoices {
    Mode mode = Mode::on_demand;
    Tractions tractions = Tractions::discontinuous;
    Update update = Update::reduced;
    FrameRule frame_rule = FrameRule::drag_columns;
    /// Bodies of at most so many vertices get K and its inverse in the background.
    int complete_up_to = 2000;

    /// The whole method of a kind under these choices.
    Method of(MethodKind kind) const;
};

/// The answers of several methods to one scene. Methods that nobody looks at are not computed; their last answers are
/// kept, so that switching back is instant. All members are for one thread, which calls update() once per frame.
class Simulation {
public:
    /// `wake` is called by the workers when update() will find something.
    explicit Simulation(const std::function<void()>& wake);

    /// Brings every method of `shown` up to date with the scene; the first is served first. The next one begins its
    /// precomputation when the one before has its model. Returns whether any displacement changed.
    bool update(const LiveScene& scene, const std::vector<MethodKind>& shown, const MethodChoices& choices);
    /// Prepares the methods of the last update for this set, that may be asked for soon.
    void prefetch(const ConstrainedSet& set);

    MethodRunner& runner(MethodKind kind);
    const MethodRunner& runner(MethodKind kind) const;
    /// Why a method cannot take this scene (a mesh or material that is not fit for it), else why it failed; empty when
    /// neither.
    std::string problem(MethodKind kind) const;

    bool waiting() const;   ///< a method of the last update is not ready yet, and will be by itself
    bool busy() const;      ///< the same, or K and its inverse are being completed
    bool checking() const;  ///< an answer is being checked, or will be once it has rested
    void cancel();          ///< stops all workers at their next checkpoints
    bool stopping() const;  ///< some worker has not stopped yet; for use after cancel(), without update()

private:
    struct Entry {
        MethodKind kind;
        std::unique_ptr<MethodRunner> runner;
        std::string unfit;
    };
    std::size_t place(MethodKind kind) const;
    bool is_shown(MethodKind kind) const;
    void rest_hidden(const LiveScene& scene);
    static bool give_body(Entry& entry, const LiveScene& scene, const MethodChoices& choices);
    void complete_one(const LiveScene& scene, const MethodChoices& choices);

    std::vector<Entry> entries_;
    std::vector<MethodKind> shown_;
};

}  // namespace elastolab
