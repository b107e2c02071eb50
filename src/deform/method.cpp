#include "deform/method.hpp"

#include <array>
#include <utility>

namespace elastolab {

namespace {

template <class Choice, std::size_t n>
using Names = std::array<std::pair<Choice, std::string_view>, n>;

constexpr Names<MethodKind, 3> kKinds = {
    {{MethodKind::fem, "fem"}, {MethodKind::constant_bem, "constant-bem"}, {MethodKind::linear_bem, "linear-bem"}}};
constexpr Names<Mode, 3> kModes = {
    {{Mode::on_demand, "on-demand"}, {Mode::full, "full"}, {Mode::full_volume, "full-volume"}}};
constexpr Names<Tractions, 3> kTractions = {{{Tractions::discontinuous, "discontinuous"},
                                             {Tractions::restricted, "restricted"},
                                             {Tractions::continuous, "continuous"}}};
constexpr Names<Update, 3> kUpdates = {
    {{Update::direct, "direct"}, {Update::eqn9, "eqn9"}, {Update::reduced, "reduced"}}};

template <class Choice, std::size_t n>
std::string_view name_in(const Names<Choice, n>& names, Choice choice) {
    for (const auto& [value, text] : names)
        if (value == choice) return text;
    return {};
}

template <class Choice, std::size_t n>
std::optional<Choice> choice_in(const Names<Choice, n>& names, std::string_view text) {
    for (const auto& [value, its_name] : names)
        if (its_name == text) return value;
    return std::nullopt;
}

}  // namespace

std::string_view name(MethodKind kind) { return name_in(kKinds, kind); }
std::string_view name(Mode mode) { return name_in(kModes, mode); }
std::string_view name(Tractions tractions) { return name_in(kTractions, tractions); }
std::string_view name(Update update) { return name_in(kUpdates, update); }
std::optional<MethodKind> parse_method_kind(std::string_view text) { return choice_in(kKinds, text); }
std::optional<Mode> parse_mode(std::string_view text) { return choice_in(kModes, text); }
std::optional<Tractions> parse_tractions(std::string_view text) { return choice_in(kTractions, text); }
std::optional<Update> parse_update(std::string_view text) { return choice_in(kUpdates, text); }

}  // namespace elastolab
