#include "cli/proxy_options.hpp"

#include <CLI/CLI.hpp>

namespace elastolab {

void ProxyOptions::add_to(CLI::App& parser) {
    parser
        .add_option("--proxy", use,
                    "simulate a closed surface around the mesh (default: the scene's choice, else auto: where the "
                    "method cannot use it); fill: the mesh itself with its holes filled")
        ->check(CLI::IsMember({"never", "auto", "always", "fill"}));
    parser.add_option("--proxy-vertices", n_vertices, "approximate number of its vertices (default 1500)")
        ->check(CLI::Range(kFewestProxyVertices, kMostProxyVertices));
    parser
        .add_option("--proxy-as", taken_for,
                    "what an open surface is: solid: its holes are closed; sheet: it becomes a thin wall (default: "
                    "auto: a solid when its holes are small)")
        ->check(CLI::IsMember({"auto", "solid", "sheet"}));
}

void ProxyOptions::apply(ProxyChoice& choice) const {
    if (!use.empty()) choice.use = parse_proxy_use(use).value();  // the parser has checked it
    if (!taken_for.empty()) choice.taken_for = parse_open_surface(taken_for).value();
    if (n_vertices > 0) choice.n_vertices = n_vertices;
}

}  // namespace elastolab
