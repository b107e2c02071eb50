#include "findings/words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/text.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

namespace {

constexpr double kRounding = std::numeric_limits<double>::epsilon();

std::string place_of(const Finding& finding) { return readable_point(finding.place.value_or(Eigen::Vector3d::Zero())); }

/// "1 hole", "1020 holes".
std::string counted(double count, const std::string& noun) {
    return formatted("%.0f ", count) + noun + (count == 1.0 ? "" : "s");
}

/// Two significant digits, without an exponent: "3.7 %", "370 %".
std::string percent(double part) {
    const std::string digits = readable_number(100.0 * part);
    const double rounded = std::stod(digits);
    return (rounded < 100.0 ? digits : formatted("%.0f", rounded)) + " %";
}

std::string locking(const Finding& finding) {
    return std::string(finding.method->name) + ": linear tetrahedra lock at Poisson's ratio " +
           readable_number(finding.value, 6) +
           ". In bending their error is 3, 9 and 29 times that at 0.3 for ratios of 0.49, 0.499 and 0.4999. Choose "
           "galerkin-bem or linear-bem, which do not lock, or refine the mesh.";
}

std::string uncertain_pressure(const Finding& finding) {
    const std::string begin = std::string(finding.method->name) + ": ";
    const std::string ratio = "Poisson's ratio " + readable_number(finding.value, 6);
    if (finding.first == 1)
        return begin + "a whole closed surface is constrained, and next to 1/2 (" + ratio +
               ") collocation does not find the pressure inside: stresses may be off by several times their size and "
               "displacements by 15 %, on finer meshes too. Choose galerkin-bem.";
    return begin + ratio +
           " is so close to 1/2 that pressures, and with them stresses, are off by more than displacements: in bending "
           "by a quarter to three quarters at 0.499. Choose galerkin-bem for stresses.";
}

std::string lost_digits(const Finding& finding) {
    return finding.object + ": nearly dependent equations (condition " + readable_number(finding.value) +
           "). Displacements may be off by " + readable_number(std::min(finding.value * kRounding, 1.0)) +
           " of their size, and forces by more. Remove handles that nearly coincide, slivers, or a Poisson's ratio "
           "next to 1/2; of a long slender body it is so by nature.";
}

std::string thin_triangle(const Finding& finding) {
    return "boundary elements: the triangle at " + place_of(finding) + " is so thin (" +
           readable_number(finding.value) + " of its length) that its integrals are accurate to " +
           readable_number(10.0 * kRounding / (finding.value * finding.value)) +
           " only. Remesh the surface there, or choose fem.";
}

std::string slender_body(const Finding& finding) {
    return std::string(finding.method->name) + ": the body is " + readable_number(finding.value, 3) +
           " times as long as it is thick. With two elements across, collocation is off by " +
           (finding.method->shows_averages ? "29 % in bending at 20 times and by 36 %"
                                           : "9 % in bending at 20 times and by 15 %") +
           " at 40 times. Choose galerkin-bem, or compare with fem.";
}

std::string thin_wall(const Finding& finding) {
    const std::string_view errors =
        finding.method->shows_averages    ? "of 35 to 45 %. Refine there, or choose linear-bem."
        : finding.method->balances_forces ? "of 2 % or, where they are slender, many times that. Refine there, or "
                                            "compare with quadratic-fem."
                                          : "of 1 to 10 %. Refine there, or choose galerkin-bem.";
    return "boundary elements: the surface near " + place_of(finding) + " is only " + readable_number(finding.value) +
           " of a triangle's edge away from its other side. Walls and gaps that thin have bending errors " +
           std::string(errors);
}

std::string contact(const Finding& finding) {
    return "solids " + std::to_string(finding.first + 1) + " and " + std::to_string(finding.second + 1) +
           ": touch near " + place_of(finding) +
           ", but are separate bodies: they neither stick together nor push each other. Join their surfaces if they "
           "are one body.";
}

std::string point_constraint(const Finding& finding) {
    const auto count = static_cast<int>(finding.value);
    const std::string others = count > 1 ? " and " + std::to_string(count - 1) + " more are" : " is";
    return "constraints: vertex " + std::to_string(finding.first) + " at " + place_of(finding) + others +
           " constrained alone, without a whole triangle. How far the body follows a point depends on the mesh: "
           "constrain a patch, not a single vertex.";
}

std::string weak_hold(const Finding& finding) {
    return "constraints: almost on one line near " + place_of(finding) +
           ", so the body can hardly resist turning about it: an error of a handle is amplified " +
           readable_number(finding.value) + " times. Constrain a vertex farther from the line.";
}

/// What helps against a coarse mesh, as far as there are patches whose rims could be refined and that is the way.
std::string against_coarseness(const Finding& finding) {
    return std::string(finding.second == 0 ? "Refine the mesh." : finding.method->against_coarseness);
}

std::string coarse_mesh(const Finding& finding) {
    return std::string(finding.method->name) + ": displacements" + std::string(kAreOffBy) + percent(finding.value) +
           " of the largest near " + place_of(finding) + ": the mesh is too coarse there. " +
           against_coarseness(finding);
}

std::string proxy(const Finding& finding) {
    return finding.object + ": simulated through a proxy, a closed surface of " + std::to_string(finding.first) +
           " vertices around it, " +
           (finding.value > 0.0
                ? "from which no vertex is farther than " + readable_number(finding.value) + " mesh units."
                : std::string("with all vertices of the mesh on it.")) +
           " Displacements are those of that body. " +
           (finding.kind == FindingKind::proxy
                ? "Repair the surface, or have its holes filled, to simulate the surface itself."
                : "The surface is sound: turn the proxy off to simulate the surface itself.");
}

/// For a student who has heard of Hooke's law.
std::string linear_theory(const Finding& finding) {
    if (std::isinf(finding.value))
        return std::string(finding.method->name) +
               ": linear theory cannot be right for these motions and loads: nonlinear-fem, which follows large turns "
               "and stretches, finds no equilibrium that would last, as where a body is crushed or buckles. Make "
               "them smaller, or check the units.";
    return std::string(finding.method->name) + ": linear theory is off by about " + percent(finding.value) +
           " of the largest displacement. It takes turns and stretches to be small, so that what turns swells. Choose "
           "nonlinear-fem, which follows them" +
           (finding.first == 1 ? ", with a Poisson's ratio that is farther from 1/2." : ".");
}

std::string thin_sheets(const Finding& finding) {
    const std::string thick = " mesh units thick. Give it its thickness in the file";
    if (finding.first <= 0)
        return finding.object + ": is an open sheet in places, which is simulated as a wall " +
               readable_number(finding.value) + thick + ".";
    return finding.object + ": taken for a sheet, " + std::to_string(finding.first) +
           (finding.first == 1 ? " opening" : " openings") + " left open; it is simulated as a wall " +
           readable_number(finding.value) + thick + ", or take it for a solid (proxy as solid).";
}

std::string coarse_forces(const Finding& finding) {
    return std::string(finding.method->name) + ": forces" + std::string(kAreOffBy) + percent(finding.value) +
           " of the largest at fixed sets and handles: the mesh is too coarse for them. " + against_coarseness(finding);
}

std::string imbalance(const Finding& finding, const char* what) {
    return std::string(finding.method->name) + ": the reaction " + what + " do not balance; their sum is " +
           percent(finding.value) + " of the largest. " +
           (finding.method->balances_forces
                ? "They must, so the answer is lost in rounding. Fix more vertices, or thicken what is very thin."
                : "Collocation does not balance them; choose galerkin-bem or fem where forces matter.");
}

std::string of_one(const Finding& finding) {
    switch (finding.kind) {
        case FindingKind::locking:
            return locking(finding);
        case FindingKind::uncertain_pressure:
            return uncertain_pressure(finding);
        case FindingKind::lost_digits:
            return lost_digits(finding);
        case FindingKind::singular_stiffness:
            return "K = G^-1 H: G is singular to rounding, or nearly so (constant elements at Poisson's ratio 1/2), so "
                   "K and Eqns. 7 and 9 carry few digits or none. Use the update reduced, or the mode on-demand.";
        case FindingKind::thin_triangle:
            return thin_triangle(finding);
        case FindingKind::slender_body:
            return slender_body(finding);
        case FindingKind::thin_wall:
            return thin_wall(finding);
        case FindingKind::contact:
            return contact(finding);
        case FindingKind::point_constraint:
            return point_constraint(finding);
        case FindingKind::weak_hold:
            return weak_hold(finding);
        case FindingKind::free_motion:
            return std::string("constraints: leave the body free to move as a rigid body; ") +
                   (finding.method != nullptr && !finding.method->linear ? "one such motion is shown"
                                                                         : "the smallest such motion is chosen") +
                   ". Constrain three vertices that are not on one line.";
        case FindingKind::singular_though_held:
            return std::string(kSingularThoughHeld) + " The smallest solution is chosen.";
        case FindingKind::coarse_mesh:
            return coarse_mesh(finding);
        case FindingKind::coarse_forces:
            return coarse_forces(finding);
        case FindingKind::no_estimate:
            if (finding.value > 0.0)
                return std::string(finding.method->name) +
                       ": the error is not estimated, and may be large: the surface is " +
                       formatted("%.1f", finding.value) +
                       " triangles across. Boundary elements are too stiff in bending then, by about 26 % at one "
                       "triangle across and 4 % at two, and more where triangles are long. The second answer that the "
                       "error is told by takes too long or too much memory, or cannot be computed. Use a surface with "
                       "smaller triangles, or finite elements with ten nodes.";
            return std::string(finding.method->name) +
                   ": the error is not estimated. The second, better answer that it is told by would take more than "
                   "ten times as long as this one, more memory than there is, cannot be computed, or finds no rim "
                   "where it would be better.";
        case FindingKind::force_imbalance:
            return imbalance(finding, "forces");
        case FindingKind::moment_imbalance:
            return imbalance(finding, "moments");
        case FindingKind::nothing_constrained:
            return finding.object + ": no vertex is fixed or moved, so the body rests. Add a handle.";
        case FindingKind::choice_left_aside:
            return finding.object + ": applies to " + std::string(name(finding.method)) + " only, and was ignored.";
        case FindingKind::impossible_volume:
            return "constraints: prescribe the whole surface of an incompressible body and change its volume by " +
                   percent(finding.value) +
                   ", which no displacement can satisfy. Free some vertices, or choose a Poisson's ratio below 1/2.";
        case FindingKind::large_residual:
            return finding.object + ": the solution leaves a relative residual of " + readable_number(finding.value) +
                   ", so it is wrong. Fix more vertices, or use another method.";
        case FindingKind::proxy:
        case FindingKind::chosen_proxy:
            return proxy(finding);
        case FindingKind::capped_holes:
            return finding.object + ": taken for a solid, " + counted(finding.value, "hole") +
                   " closed. Take it for a sheet (proxy as sheet) where thin walls are meant, or close the holes in "
                   "the file.";
        case FindingKind::filled_holes:
            return finding.object + ": simulated with its " + counted(finding.value, "hole") + " filled by " +
                   std::to_string(finding.first) +
                   " triangles, which no output contains. Close them in the file where another shape is meant.";
        case FindingKind::linear_theory:
            return linear_theory(finding);
        case FindingKind::unstable_equilibrium:
            return std::string(finding.method->name) +
                   ": the equilibrium is not stable: a real body would buckle away from it at the least push, and no "
                   "stable one was found nearby. Pull a little to one side, or in smaller steps.";
        case FindingKind::thin_sheets:
            return thin_sheets(finding);
        case FindingKind::idle_handle:
            return "handle " + finding.object +
                   ": moves nothing but its own vertices. It is smaller than the proxy's triangles, and others hold "
                   "the proxy's vertices there. Ask for more proxy vertices.";
        case FindingKind::narrow_openings:
            return finding.object + ": " + counted(finding.value, "opening") + (finding.value == 1.0 ? " is" : " are") +
                   " narrower than the proxy's triangles, so it is simulated as a solid although it was to be a sheet. "
                   "Ask for more proxy vertices.";
    }
    return {};
}

}  // namespace

std::string words(const Finding& finding) {
    if (finding.n_more == 0) return of_one(finding);
    return of_one(finding) + " The same is true of " + counted(finding.n_more, "other solid") + ", which are no worse.";
}

std::vector<std::string> words(const Findings& findings) {
    std::vector<std::string> texts;
    for (const Finding& finding : findings) texts.push_back(words(finding));
    return texts;
}

}  // namespace elastolab
