#pragma once

#include <string_view>

namespace elastolab {

/// The page that shows a figure (figure_page.html), with @DATA@ where its data belong.
extern const std::string_view kFigurePage;

}  // namespace elastolab
