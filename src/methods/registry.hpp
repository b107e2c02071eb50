#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deform/method.hpp"

namespace elastolab {

/// All methods that the program has, in the order in which they are shown.
std::span<const MethodKind> all_methods();

/// Their names, in the same order.
std::vector<std::string> method_names();

/// The one that is taken when nobody chooses.
MethodKind default_method();
/// The one that the viewer begins with: the most accurate, and ready to be pulled hardly later than the default.
MethodKind first_method();
/// The one that is ready soonest on a surface as it is, for the first moments.
MethodKind quick_method();
/// The one that answers on coarse surfaces while others compute: the one that is ready soonest of those that are
/// accurate on few triangles of any shape.
MethodKind preview_method();
/// The one that holds for large deformations, by which linear theory is judged.
MethodKind large_deformation_method();
/// Those that are compared when nobody chooses: the ones of the paper, and the reference.
std::span<const MethodKind> compared_methods();

/// By MethodTraits::name; nothing for an unknown name.
std::optional<MethodKind> parse_method_kind(std::string_view text);

}  // namespace elastolab
