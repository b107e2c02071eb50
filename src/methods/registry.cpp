#include "methods/registry.hpp"

#include <array>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"

namespace elastolab {

namespace {

constexpr std::array kMethods = {
    kFem, kConstantBem, kLinearBem, kGalerkinBem, kQuadraticFem, kNonlinearFem,
};
constexpr std::array kCompared = {kFem, kConstantBem, kLinearBem, kGalerkinBem};

}  // namespace

std::span<const MethodKind> all_methods() { return kMethods; }

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MethodKind kind : kMethods) names.emplace_back(kind->name);
    return names;
}

MethodKind default_method() { return kLinearBem; }
MethodKind first_method() { return kGalerkinBem; }
MethodKind quick_method() { return kFem; }

MethodKind preview_method() { return kQuadraticFem; }
MethodKind large_deformation_method() { return kNonlinearFem; }
std::span<const MethodKind> compared_methods() { return kCompared; }

std::optional<MethodKind> parse_method_kind(std::string_view text) {
    for (const MethodKind kind : kMethods)
        if (kind->name == text) return kind;
    return std::nullopt;
}

}  // namespace elastolab
