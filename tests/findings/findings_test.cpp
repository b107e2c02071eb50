#include "findings/surface.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "base/text.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/exact_fields.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/cost.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "mesh/surface_distance.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

double bending_error(const SurfaceMesh& mesh, double nu, const Method& method) {
    const Material material{1.0, nu};
    const Eigen::VectorXd exact = exact_displacements(mesh, PureBending{material});
    const double length = mesh.vertices.row(0).maxCoeff();
    const auto ends = vertices_where(mesh, [&](const auto& x) { return x[0] < 1e-9 || x[0] > length - 1e-9; });
    const Eigen::VectorXd u = displaced(precomputed(make_body(mesh, material), method), {{}, ends}, at(exact, ends));
    return (u - exact).norm() / exact.norm();
}

/// A plate of 1 x 1 whose faces are split into 8 x 8 cells.
SurfaceMesh plate(double thickness) {
    SurfaceMesh mesh = make_box(1, {8, 8, 1});
    mesh.vertices.topRows(2) /= 8.0;
    mesh.vertices.row(2) *= thickness;
    mesh.vertices.row(2).array() -= 0.5 * thickness;
    return mesh;
}

std::vector<std::string> warnings_of(const SurfaceMesh& mesh, const Method& method, double nu = 0.3) {
    return words(findings_of_model(*precomputed(make_body(mesh, {1.0, nu}), method)));
}

std::vector<std::string> warnings_of(const SurfaceMesh& mesh, const std::vector<int>& constrained,
                                     const Method& method = {.kind = kLinearBem}) {
    Control control;
    Deformer deformer(precomputed(make_body(mesh), method));
    deformer.constrain({{}, constrained}, control);
    return words(findings_of_set(deformer));
}

TEST(Findings, SayNothingOfSoundBodies) {
    for (const SurfaceMesh& mesh : {make_box(4), make_sphere(4), make_torus(3), make_rabbit(300).surface}) {
        // The tube and the ears have a cell and a half across: sound for all but constant elements.
        const bool is_sound_for_constants = closest_facing_approach(mesh).ratio > 0.8;
        const double lowest = mesh.vertices.row(2).minCoeff();
        const auto low = vertices_where(mesh, [&](const auto& x) { return x[2] < lowest + 0.5; });
        for (const Method& method : method_variants()) {
            Control control;
            Deformer deformer(precomputed(make_body(mesh), method));
            if (method.kind != kConstantBem || is_sound_for_constants) {
                EXPECT_THAT(words(findings_of_model(deformer.model())), IsEmpty()) << describe(method);
            }
            deformer.constrain({{}, low}, control);
            const std::vector<std::string> of_set = words(findings_of_set(deformer));
            EXPECT_THAT(of_set, Not(Contains(HasSubstr("nearly")))) << describe(method);
            EXPECT_THAT(of_set, Not(Contains(HasSubstr("line")))) << describe(method);
        }
    }
}

TEST(Findings, TellOfLockingFromWhereTheErrorHasDoubled) {
    const Method fem = make_method(kFem);
    const SurfaceMesh bar = make_box(6, {2.0, 1.0, 1.0});
    const double usual = bending_error(bar, 0.3, fem);
    for (const auto& [nu, factor] : {std::pair{0.48, 2.0}, {0.49, 3.0}, {0.499, 9.0}, {0.4999, 29.0}}) {
        const double measured = bending_error(bar, nu, fem) / usual;
        print_measured("fem, bending at nu " + std::to_string(nu) + ", error over that at 0.3", measured);
        EXPECT_NEAR(measured, factor, 0.3 * factor);
    }
    EXPECT_THAT(warnings_of(make_box(3), fem, 0.47), IsEmpty());
    EXPECT_THAT(warnings_of(make_box(3), fem, 0.49), Contains(HasSubstr("lock")));
    EXPECT_THAT(warnings_of(make_box(3), Method{.kind = kLinearBem}, 0.5), IsEmpty());
}

TEST(Findings, TellOfUncertainPressures) {
    for (const MethodKind kind : {kQuadraticFem, kNonlinearFem}) {
        EXPECT_THAT(warnings_of(make_box(2), Method{.kind = kind}, 0.49), IsEmpty());
        EXPECT_THAT(warnings_of(make_box(2), Method{.kind = kind}, 0.499), Contains(HasSubstr("pressures")));
    }
    // A hollow ball: its outer surface is prescribed, and the cavity free; or a part of each.
    const SurfaceMesh ball = make_hollow_sphere(3, 1.0, 0.4);
    std::vector<int> outer, upper;
    for (int v = 0; v < ball.n_vertices(); ++v) {
        if (ball.vertices.col(v).norm() > 0.7) outer.push_back(v);
        if (ball.vertices(2, v) > 0.3) upper.push_back(v);
    }
    const auto is_told = [&](MethodKind kind, double nu, const std::vector<int>& handles) {
        Control control;
        Deformer deformer(precomputed(make_body(ball, {1.0, nu}), Method{.kind = kind}));
        deformer.constrain({{}, handles}, control);
        const Findings all = findings_of_set(deformer);
        return std::any_of(all.begin(), all.end(),
                           [](const Finding& f) { return f.kind == FindingKind::uncertain_pressure; });
    };
    for (const MethodKind kind : {kLinearBem, kConstantBem}) {
        EXPECT_TRUE(is_told(kind, 0.4999, outer)) << name(kind);
        EXPECT_FALSE(is_told(kind, 0.4999, upper)) << name(kind);
        EXPECT_FALSE(is_told(kind, 0.3, outer)) << name(kind);
    }
    EXPECT_FALSE(is_told(kGalerkinBem, 0.4999, outer));
}

TEST(Findings, TellOfThinWalls) {
    for (const auto& [kind, least, most, words] : {std::tuple{kLinearBem, 0.03, 0.1, "bending errors of 1 to 10 %"},
                                                   std::tuple{kConstantBem, 0.35, 0.45, "bending errors of 35 to 45 %"},
                                                   std::tuple{kGalerkinBem, 0.0, 0.02, "bending errors of 2 % or"}}) {
        for (const double thickness : {0.002, 0.02, 0.08}) {
            const double error = bending_error(plate(thickness), 0.3, make_method(kind));
            EXPECT_GT(error, least) << name(kind) << " " << thickness;
            EXPECT_LT(error, most) << name(kind) << " " << thickness;
        }
        EXPECT_THAT(warnings_of(plate(0.02), make_method(kind)), Contains(HasSubstr(words)));
        EXPECT_THAT(warnings_of(make_box(2, {4, 4, 1}), make_method(kind)), Not(Contains(HasSubstr("bending errors"))));
    }
    EXPECT_THAT(warnings_of(plate(0.02), make_method(kFem)), IsEmpty());
    // One cell through the thickness: linear elements bend it, constant ones do not.
    const Method linear = make_method(kLinearBem), constant = make_method(kConstantBem);
    EXPECT_LT(bending_error(plate(0.125), 0.3, linear), 0.05);
    EXPECT_GT(bending_error(plate(0.125), 0.3, constant), 0.3);
    EXPECT_THAT(warnings_of(plate(0.125), linear), Not(Contains(HasSubstr("bending errors"))));
    EXPECT_THAT(warnings_of(plate(0.125), constant), Contains(HasSubstr("bending errors")));
}

constexpr const char* kSlenderWords = "times as long as it is thick";

TEST(Findings, TellOfSlenderBodies) {
    const SurfaceMesh bar = make_box(2, {20.0, 1.0, 1.0});
    for (const auto& [kind, error] : {std::pair{kLinearBem, 0.09}, std::pair{kConstantBem, 0.29}}) {
        EXPECT_NEAR(bending_error(bar, 0.3, Method{.kind = kind}), error, 0.005);
        EXPECT_THAT(warnings_of(bar, Method{.kind = kind}), Contains(HasSubstr(kSlenderWords)));
        EXPECT_THAT(warnings_of(make_box(2, {10.0, 1.0, 1.0}), Method{.kind = kind}), IsEmpty());
    }
    EXPECT_LT(bending_error(bar, 0.3, Method{.kind = kGalerkinBem}), 0.001);
    EXPECT_THAT(warnings_of(bar, Method{.kind = kGalerkinBem}), IsEmpty());
}

/// A bar of 1 x 1 x 24 along a helix of one turn and a half, in a box of 6 x 6 x 4: as slender as a straight one.
TEST(Findings, TellOfSlenderBodiesThatAreWound) {
    SurfaceMesh coil = make_box(2, {24.0, 1.0, 1.0});
    const double radius = 2.5, turn = 1.0 / radius, rise = 2.0 / (2.0 * std::numbers::pi);
    for (auto x : coil.vertices.colwise()) {
        const double angle = turn * x[0], r = radius + 0.5 - x[1];
        x = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), rise * angle + x[2]);
    }
    EXPECT_LT((coil.vertices.rowwise().maxCoeff() - coil.vertices.rowwise().minCoeff()).norm(), 10.0);
    EXPECT_THAT(warnings_of(coil, Method{.kind = kLinearBem}), Contains(HasSubstr(kSlenderWords)));
    EXPECT_THAT(warnings_of(coil, Method{.kind = kGalerkinBem}), IsEmpty());

    const SurfaceMesh straight = make_box(2, {24.0, 1.0, 1.0});
    const auto ends = vertices_where(straight, [&](const auto& x) { return x[0] < 1e-9 || x[0] > 24.0 - 1e-9; });
    Eigen::VectorXd values(3 * std::ssize(ends));
    for (std::size_t i = 0; i < ends.size(); ++i)
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) =
            straight.vertices(0, ends[i]) > 1.0 ? Eigen::Vector3d(0.0, 0.0, 1.0) : Eigen::Vector3d::Zero();
    const auto answer = [&](const Method& method) {
        return displaced(precomputed(make_body(coil), method), {{}, ends}, values);
    };
    const Eigen::VectorXd finite = answer({.kind = kFem, .elements = ElementDegree::quadratic});
    EXPECT_LT((answer({.kind = kGalerkinBem}) - finite).norm(), 0.02 * finite.norm());
    EXPECT_GT((answer({.kind = kLinearBem}) - finite).norm(), 0.05 * finite.norm());
}

TEST(Findings, MeasureTheWallAndTheGap) {
    EXPECT_NEAR(closest_facing_approach(plate(0.02)).ratio, 0.02 / (std::sqrt(2.0) / 8.0), 1e-12);
    // Two plates side by side, one above the other: what is between them is a gap, as wide as they are apart.
    const SurfaceMesh thick = plate(0.2), two = joined(thick, moved(thick, {0.0, 0.0, 0.21}));
    EXPECT_NEAR(closest_facing_approach(two).ratio, 0.01 / (std::sqrt(2.0) / 8.0), 1e-10);
}

TEST(Findings, TellOfTrianglesWhoseIntegralsLoseDigits) {
    SurfaceMesh mesh = make_box(2);
    const int v = mesh.triangles(0, 0), w = mesh.triangles(1, 0);
    mesh.vertices.col(v) = mesh.vertices.col(w) + 1e-5 * (mesh.vertices.col(v) - mesh.vertices.col(w));
    Control control;
    EXPECT_THAT(words(findings_of_surface(mesh, kLinearBem, control)), Contains(HasSubstr("Remesh")));
    EXPECT_THAT(findings_of_surface(mesh, kFem, control), IsEmpty());
    EXPECT_THAT(findings_of_surface(make_box(2), kLinearBem, control), IsEmpty());
}

TEST(Findings, TellOfSolidsThatTouch) {
    const SurfaceMesh cube = make_box(3);
    const Method method = make_method(kLinearBem);
    EXPECT_THAT(warnings_of(joined(cube, moved(cube, {1.001, 0.0, 0.0})), method),
                Contains(HasSubstr("solids 1 and 2")));
    EXPECT_THAT(warnings_of(joined(cube, moved(cube, {1.2, 0.0, 0.0})), method), IsEmpty());
}

/// Of a crowd the worst are named, with how many others there are.
TEST(Findings, OfManySolidsNameTheWorst) {
    SurfaceMesh all;
    for (int i = 0; i < 8; ++i) {
        SurfaceMesh wall = make_box(4);
        wall.vertices.row(2) *= 0.02 - 0.001 * i;
        wall.vertices.row(0).array() += 2.0 * i;
        all = i == 0 ? wall : joined(all, wall);
    }
    const std::vector<std::string> told = warnings_of(all, make_method(kConstantBem));
    EXPECT_EQ(std::ranges::count_if(told, [](const auto& text) { return text.find("edge away") != std::string::npos; }),
              3);
    EXPECT_THAT(told, Contains(::testing::AllOf(HasSubstr("edge away"), HasSubstr("5 other solids"))));
}

TEST(Findings, TellOfPointConstraintsAndWhereTheyAre) {
    const SurfaceMesh mesh = make_box(4);
    auto held = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    for (const Method& method : method_variants()) {
        EXPECT_THAT(warnings_of(mesh, held, method), IsEmpty()) << describe(method);
        auto with_a_point = held;
        with_a_point.push_back(vertices_where(mesh, [](const auto& x) { return x.minCoeff() > 1.0 - 1e-9; }).front());
        EXPECT_THAT(warnings_of(mesh, with_a_point, method), Contains(HasSubstr("at (1, 1, 1) is constrained alone")))
            << describe(method);
    }
}

TEST(Findings, TellOfABodyThatIsBarelyHeld) {
    SurfaceMesh mesh = make_box(4);
    auto edge = vertices_where(mesh, [](const auto& x) { return x[1] < 1e-9 && x[2] < 1e-9; });
    mesh.vertices(1, edge[2]) -= 0.002;  // just off the line
    for (const Method& method : {make_method(kFem), make_method(kLinearBem)})
        EXPECT_THAT(warnings_of(mesh, edge, method), Contains(HasSubstr("almost on one line"))) << describe(method);
    edge.push_back(mesh.n_vertices() - 1);
    EXPECT_THAT(warnings_of(mesh, edge), Not(Contains(HasSubstr("almost on one line"))));
}

TEST(Findings, TellOfABodyThatIsNotHeldWhateverTheMethod) {
    const SurfaceMesh mesh = make_box(4);
    for (const Method& method : method_variants())
        for (const auto& held : {vertices_where(mesh, [](const auto& x) { return x.norm() < 1e-9; }),
                                 vertices_where(mesh, [](const auto& x) { return x[1] < 1e-9 && x[2] < 1e-9; })}) {
            Control control;
            Deformer deformer(precomputed(make_body(mesh), method));
            deformer.constrain({{}, held}, control);
            EXPECT_FALSE(deformer.quality().held) << describe(method);
            EXPECT_THAT(words(findings_of_set(deformer)), Contains(HasSubstr("free to move as a rigid body")))
                << describe(method);
        }
}

TEST(Findings, BlameCollocationForItsOwnImbalanceOnly) {
    for (const MethodKind method : all_methods())
        for (const FindingKind kind : {FindingKind::force_imbalance, FindingKind::moment_imbalance}) {
            const std::string text = words(Finding{.kind = kind, .value = 0.4, .method = method});
            EXPECT_EQ(text.find("Collocation") != std::string::npos, !method->balances_forces) << text;
            EXPECT_EQ(text.find("lost in rounding") != std::string::npos, method->balances_forces) << text;
        }
}

TEST(Findings, WritePercentagesOut) {
    const auto told = [](double part) {
        return words(Finding{.kind = FindingKind::coarse_forces, .value = part, .method = kLinearBem});
    };
    EXPECT_THAT(told(0.0374), HasSubstr("about 3.7 %"));
    EXPECT_THAT(told(0.996), HasSubstr("about 100 %"));
    EXPECT_THAT(told(3.74), HasSubstr("about 370 %"));
}

/// They hold within a factor of two.
TEST(Predictions, AreToldInTwoDigits) {
    EXPECT_EQ(readable_prediction(2.344), "2.3 s");
    EXPECT_EQ(readable_prediction(0.02345), "23 ms");
    EXPECT_EQ(readable_prediction(99.7), "100 s");
    EXPECT_EQ(readable_prediction(1.0), "1 s");
    EXPECT_EQ(readable_prediction(444.0), "7.3 min");
    EXPECT_EQ(readable_prediction(0.0), readable_seconds(0.0));
}

TEST(Findings, CountHolesInWholeNumbers) {
    const auto holes = [](double n) {
        return words(Finding{.kind = FindingKind::capped_holes, .value = n, .object = "a.obj"});
    };
    EXPECT_THAT(holes(1.0), HasSubstr("a solid, 1 hole closed"));
    EXPECT_THAT(holes(1020.0), HasSubstr("a solid, 1020 holes closed"));
}

TEST(Findings, TellOfTheDigitsThatAConditionLeaves) {
    EXPECT_THAT(words(findings_of_condition("matrix", 1e9)), IsEmpty());
    EXPECT_THAT(words(findings_of_condition("matrix", 1e11)), Contains(HasSubstr("2.2e-05")));
    EXPECT_THAT(words(findings_of_condition("matrix", std::numeric_limits<double>::infinity())),
                Contains(HasSubstr("1 of their")));
    // Poisson's ratio so near 1/2 that the stiffness keeps few digits.
    EXPECT_THAT(warnings_of(make_box(3), make_method(kFem, Tractions::discontinuous, Mode::full), 0.5 - 1e-12),
                Contains(HasSubstr("nearly dependent")));
}

/// The methods that a text advises to choose or to compare with.
std::set<std::string> advised(const std::string& text) {
    std::set<std::string> methods;
    std::string word;
    bool is_advice = false;
    for (const char c : text + " ") {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-') {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            continue;
        }
        is_advice = is_advice || word == "choose" || word == "compare";
        if (is_advice && parse_method_kind(word)) methods.insert(word);
        if (c == '.') is_advice = false;
        word.clear();
    }
    return methods;
}

TEST(Findings, NeverAdviseTheMethodInUse) {
    EXPECT_THAT(advised("fem: locks. Choose linear-bem, or compare with fem."),
                ::testing::ElementsAre("fem", "linear-bem"));
    for (const MethodKind kind : all_methods()) {
        std::vector<std::string> texts = {"Choose " + std::string(kind->cheaper) + "."};
        for (const FindingKind finding : {FindingKind::coarse_mesh, FindingKind::coarse_forces,
                                          FindingKind::force_imbalance, FindingKind::moment_imbalance})
            texts.push_back(words({.kind = finding, .value = 0.1, .method = kind, .second = 1}));
        for (const int first : {0, 1})
            if (kind->name != "galerkin-bem")
                texts.push_back(
                    words({.kind = FindingKind::uncertain_pressure, .value = 0.499, .method = kind, .first = first}));
        if (kind->locks) texts.push_back(words({.kind = FindingKind::locking, .value = 0.49, .method = kind}));
        if (kind->integrates_boundary)
            for (const FindingKind finding : {FindingKind::thin_triangle, FindingKind::thin_wall})
                texts.push_back(words({.kind = finding, .value = 0.1, .method = kind}));
        if (!kind->balances_forces)
            texts.push_back(words({.kind = FindingKind::slender_body, .value = 20.0, .method = kind}));
        for (const std::string& text : texts) EXPECT_THAT(advised(text), Not(Contains(kind->name))) << text;
    }
}

/// Only collocation leaves a resultant; elsewhere it shows lost digits.
TEST(Findings, BlameCollocationForTheImbalanceOfCollocationAlone) {
    for (const MethodKind kind : all_methods()) {
        const std::string text = words({.kind = FindingKind::force_imbalance, .value = 0.1, .method = kind});
        const bool collocates = kind == kConstantBem || kind == kLinearBem;
        EXPECT_EQ(text.find("Collocation") != std::string::npos, collocates) << text;
    }
}

}  // namespace
}  // namespace elastolab::test
