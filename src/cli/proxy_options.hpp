#pragma once

#include <string>

#include "scene/document.hpp"

namespace CLI {
class App;
}

namespace elastolab {

/// --proxy, --proxy-vertices and --proxy-as, where they were given.
struct ProxyOptions {
    std::string use, taken_for;
    int n_vertices = 0;

    void add_to(CLI::App& parser);
    void apply(ProxyChoice& choice) const;
};

}  // namespace elastolab
