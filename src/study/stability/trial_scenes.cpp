#include <set>
#include <string>

#include "study/error/finite_problems.hpp"
#include "study/error/loaded_problems.hpp"
#include "study/stability/trial_bodies.hpp"
#include "study/stability/trials.hpp"

namespace elastolab {

namespace {

std::vector<TrialGroup> all_groups() {
    return {
        {"nu-to-half",
         "bending bar, Poisson's ratio towards 1/2",
         "nu",
         {0.3, 0.45, 0.49, 0.499, 0.4999, 0.499999, 0.49999999, 0.5},
         trial::bending_bar},
        {"nu-to-minus-one",
         "bending bar, Poisson's ratio towards -1",
         "nu",
         {0.3, 0.0, -0.5, -0.9, -0.99, -0.999, -0.99999, -0.9999999},
         trial::bending_bar},
        {"plate",
         "plate of one cell through its thickness, bent",
         "thickness / length",
         {0.125, 0.05, 0.02, 0.01, 0.003, 0.001, 0.0001},
         trial::plate},
        {"needle",
         "needle of one cell across, bent",
         "thickness / length",
         {0.125, 0.05, 0.02, 0.01, 0.003, 0.001, 0.0001},
         trial::needle},
        {"long-bar", "bar of regular cells, ever longer, bent", "length / width", {2, 5, 10, 20, 40}, trial::long_bar},
        {"slivers",
         "triangles on a stretched cube pressed flat",
         "altitude / edge",
         {1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12},
         trial::slivers},
        {"irregular",
         "bending bar, vertices moved at random",
         "movement / cell",
         {0.0, 0.1, 0.2, 0.3, 0.4, 0.49},
         trial::irregular},
        {"graded",
         "bending cube, cells beside three faces halved again and again",
         "halvings",
         {0, 1, 2, 4, 6, 8, 10},
         trial::graded},
        {"scale",
         "bending bar in other units of length",
         "size",
         {1.0, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9},
         trial::scaled},
        {"far-away",
         "bending bar far from the origin",
         "distance / size",
         {0.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12, 1e14},
         trial::far_away},
        {"close-handles",
         "two handle vertices nearly in one place, stretched cube",
         "distance",
         {0.25, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14},
         trial::close_handles},
        {"barely-held",
         "turned cube, held by three vertices nearly on a line",
         "distance from the line",
         {0.25, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10},
         trial::barely_held},
        {"few-held",
         "turned cube held by one to five vertices, the first three on a line",
         "vertices",
         {5, 4, 3, 2, 1},
         trial::few_held},
        {"share",
         "bending bar, more and more vertices prescribed",
         "share",
         {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95},
         trial::share},
        {"two-bodies",
         "two stretched cubes, nearer and nearer, then overlapping",
         "gap / size",
         {1.0, 0.1, 1e-2, 1e-4, 1e-8, 0.0, -0.1},
         trial::two_bodies},
        {"nested", "a ball inside a hollow one", "radius", {0.25, 0.4, 0.49, 0.5, 0.6}, trial::nested},
        {"displacement",
         "bending bar, tiny to huge displacements",
         "factor",
         {1.0, 1e-300, 1e-100, 1e-12, 1e12, 1e100, 1e300},
         trial::large_values},
        {"pressure",
         "bar under pressure on its sides, Poisson's ratio towards 1/2",
         "nu",
         {0.3, 0.49, 0.4999, 0.499999, 0.5},
         [](double nu) { return pressed_bar(4, nu); }},
        {"pressed-wall",
         "hollow sphere under inner pressure, held by nothing, its wall thinner and thinner",
         "thickness / radius",
         {0.5, 0.3, 0.2, 0.1, 0.05},
         trial::pressed_wall},
        {"weight",
         "bar that hangs under its weight",
         "factor",
         {1.0, 1e-300, 1e-100, 1e-12, 1e12, 1e100, 1e300},
         trial::weight},
        {"cantilever",
         "bar fixed at one end and bent by its weight, longer and longer",
         "length / width",
         {1.0, 2.0, 4.0},
         [](double length) { return cantilever(3, 0.3, length); }},
        {"finite-bending",
         "bar bent to a sector of a cylinder, further and further",
         "degrees",
         {1.0, 30.0, 60.0, 90.0, 120.0},
         [](double angle) { return finite_bending(4, 0.3, angle); },
         true},
        {"finite-torsion",
         "cylinder whose ends are twisted, further and further",
         "degrees",
         {1.0, 30.0, 60.0, 90.0, 120.0, 170.0},
         [](double angle) { return finite_torsion(4, 0.3, angle); },
         true},
        // Pressed to less than half of its length the bar buckles (at 0.3 with 0.28 of the energy of the straight one),
        // and nothing tells which of its equilibria would be the right one.
        {"finite-stretch",
         "bar pulled or pressed to so many times its length",
         "length / length at rest",
         {1.01, 0.55, 0.7, 1.5, 2.0, 4.0},
         [](double stretch) { return finite_stretch(3, 0.3, stretch); },
         true},
        {"finite-swelling",
         "hollow sphere whose inner side is pushed out to so many times its radius",
         "radius / radius at rest",
         {1.01, 1.2, 1.5, 2.0},
         [](double stretch) { return finite_swelling(4, 0.3, stretch); },
         true},
        {"young", "bending bar, Young's modulus", "E", {1.0, 1e-300, 1e-100, 1e-12, 1e12, 1e100, 1e300}, trial::stiff},
    };
}

}  // namespace

const std::vector<TrialGroup>& trial_groups(bool quick) {
    static const std::vector<TrialGroup> all = all_groups();
    static const std::vector<TrialGroup> few = [] {
        std::vector<TrialGroup> groups = all_groups();
        const std::set<std::string> slow_at_last = {"plate", "slivers", "cantilever", "long-bar"};
        for (TrialGroup& group : groups) {  // the last level, or one that is quicker
            const std::vector<double> levels = group.levels;
            group.levels = {group.name == "graded"              ? levels[2]
                            : slow_at_last.contains(group.name) ? levels[levels.size() / 2]
                                                                : levels.back()};
        }
        return groups;
    }();
    return quick ? few : all;
}

}  // namespace elastolab
