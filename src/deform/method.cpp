#include "deform/method.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr std::array<std::string_view, 3> kModeNames = {"on-demand", "full", "full-volume"};
constexpr std::array<std::string_view, 3> kTractionNames = {"discontinuous", "restricted", "continuous"};
constexpr std::array<std::string_view, 3> kUpdateNames = {"direct", "eqn9", "reduced"};
constexpr std::array<std::string_view, 2> kElementNames = {"quadratic", "linear"};

template <class Choice, std::size_t n>
std::optional<Choice> choice_in(const std::array<Choice, n>& choices, std::string_view text) {
    for (const Choice choice : choices)
        if (name(choice) == text) return choice;
    return std::nullopt;
}

}  // namespace

std::string_view name(Mode mode) { return kModeNames[static_cast<std::size_t>(mode)]; }
std::string_view name(Tractions tractions) { return kTractionNames[static_cast<std::size_t>(tractions)]; }
std::string_view name(Update update) { return kUpdateNames[static_cast<std::size_t>(update)]; }
std::optional<Mode> parse_mode(std::string_view text) { return choice_in(kAllModes, text); }
std::optional<Tractions> parse_tractions(std::string_view text) { return choice_in(kAllTractions, text); }
std::optional<Update> parse_update(std::string_view text) { return choice_in(kAllUpdates, text); }
std::string_view name(ElementDegree elements) {
    return elements == ElementDegree::quadratic ? kElementNames[0] : kElementNames[1];
}
std::optional<ElementDegree> parse_elements(std::string_view text) { return choice_in(kAllElements, text); }

bool has(MethodKind kind, Mode mode) {
    return std::find(kind->modes.begin(), kind->modes.end(), mode) != kind->modes.end();
}
bool has(MethodKind kind, Update update) {
    return std::find(kind->updates.begin(), kind->updates.end(), update) != kind->updates.end();
}

std::string refusal(const Method& method, double poisson_ratio) {
    const MethodTraits& traits = *method.kind;
    const auto say = [&](std::string_view object, std::string_view finding) {
        return std::string(object).append(": ").append(finding);
    };
    const std::string mode = "mode " + std::string(name(method.mode)),
                      update = "update " + std::string(name(method.update));
    if (!has(method.kind, method.mode))
        return say(mode, method.mode == Mode::full_volume && !traits.has_inside
                             ? "boundary elements have no volume. Choose the mode full, or FEM."
                             : std::string(traits.label) + " does not offer it. Choose the mode on-demand.");
    if (!has(method.kind, method.update))
        return say(update, std::string(traits.label) + " does not offer it. Choose the update reduced.");
    if (method.update == Update::eqn9 && method.mode == Mode::on_demand)
        return say(update, "needs K and its inverse in memory. Choose the mode full.");
    if (poisson_ratio > traits.largest_poisson_ratio)
        return say("poisson_ratio", std::string(traits.label) + " takes values up to " +
                                        readable_number(traits.largest_poisson_ratio, 6) +
                                        ". Lower it, or choose linear-bem, which takes 0.5.");
    if (poisson_ratio < 0.5) return {};
    if (!traits.takes_incompressible)
        return say("poisson_ratio", std::string(traits.label) +
                                        " needs a value below 0.5. Lower it, or choose linear-bem, which takes 0.5.");
    if (!traits.K_takes_incompressible && method.mode != Mode::on_demand && method.update != Update::reduced)
        return say(update, std::string(traits.label) +
                               " has no stiffness matrix at Poisson's ratio 0.5, where G is singular. Choose the "
                               "update reduced, or the mode on-demand.");
    return {};
}

}  // namespace elastolab
