#include "methods/choices.hpp"

#include <algorithm>
#include <span>

#include "methods/registry.hpp"

namespace elastolab {

Findings choices_left_aside(const ChoicesForSome& given, MethodKind kind, const std::string& prefix) {
    Findings findings;
    const auto tell = [&](bool is_given, bool MethodTraits::*chooses, const char* option) {
        if (!is_given || kind->*chooses) return;
        const std::span<const MethodKind> all = all_methods();
        const auto its = std::find_if(all.begin(), all.end(), [&](MethodKind other) { return other->*chooses; });
        findings.push_back({.kind = FindingKind::choice_left_aside, .method = *its, .object = prefix + option});
    };
    tell(given.tractions, &MethodTraits::chooses_tractions, "tractions");
    tell(given.elements, &MethodTraits::chooses_elements, "elements");
    tell(given.rims, &MethodTraits::chooses_rims, "rims");
    return findings;
}

}  // namespace elastolab
