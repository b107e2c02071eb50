#include "methods/registry.hpp"

#include <array>

namespace elastolab {

namespace {

constexpr std::array kMethods = {
    kFem, kConstantBem, kLinearBem, kGalerkinBem, kQuadraticFem, kNonlinearFem,
};

}  // namespace

std::span<const MethodKind> all_methods() { return kMethods; }

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MethodKind kind : kMethods) names.emplace_back(kind->name);
    return names;
}

MethodKind default_method() { return kLinearBem; }
MethodKind first_method() { return kGalerkinBem; }
MethodKind preview_method() { return kQuadraticFem; }

std::optional<MethodKind> parse_method_kind(std::string_view text) {
    for (const MethodKind kind : kMethods)
        if (kind->name == text) return kind;
    return std::nullopt;
}

}  // namespace elastolab
