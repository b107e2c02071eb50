#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fem/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

/// Ways to the same displacements that share only the matrices: the capacitance system with columns on demand and from
/// K^-1 in memory, Eqn. 7 and Eqn. 9 on K (or on H and G where no K serves all sets), and a direct solve of the mixed
/// system (on demand, direct), which integrates and factorises afresh.
const std::vector<std::pair<Mode, Update>> kWays = {{Mode::on_demand, Update::direct},
                                                    {Mode::full, Update::direct},
                                                    {Mode::full, Update::eqn9},
                                                    {Mode::full, Update::reduced}};
constexpr double kTolerance = 1e-9;  // of displacements and forces, relative

std::vector<std::pair<Mode, Update>> ways_of(MethodKind kind) {
    std::vector<std::pair<Mode, Update>> ways = kWays;
    std::erase_if(ways, [&](const auto& way) { return !has(kind, way.first) || !has(kind, way.second); });
    return ways;
}

/// A random set of this share of the vertices; the first part of it is the fixed set, at rest.
ConstrainedSet random_set(const SurfaceMesh& mesh, double share, bool with_fixed, std::mt19937& random) {
    std::vector<int> vertices(static_cast<std::size_t>(mesh.n_vertices()));
    std::iota(vertices.begin(), vertices.end(), 0);
    std::shuffle(vertices.begin(), vertices.end(), random);
    vertices.resize(static_cast<std::size_t>(std::max(3.0, share * mesh.n_vertices())));
    const auto n_fixed = static_cast<std::ptrdiff_t>(with_fixed ? std::max<std::size_t>(vertices.size() / 2, 3) : 0);
    const auto middle = vertices.begin() + std::min<std::ptrdiff_t>(n_fixed, std::ssize(vertices));
    return {{vertices.begin(), middle}, {middle, vertices.end()}};
}

Eigen::VectorXd random_values(const ConstrainedSet& set, std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 0.1);
    Eigen::VectorXd values(3 * std::ssize(set.handles));
    for (double& value : values) value = normal(random);
    return values;
}

struct Outcome {
    Eigen::VectorXd displacements;
    Eigen::Matrix3Xd forces;
};

Outcome outcome(std::shared_ptr<const Model> model, const ConstrainedSet& set, const Eigen::VectorXd& values) {
    Control control;
    Deformer deformer(std::move(model));
    deformer.constrain(set, control);
    return {deformer.displace(values), deformer.reactions(values).forces};
}

struct Agreement : ::testing::TestWithParam<Method> {};

void expect_agreement(const SurfaceMesh& mesh, const Method& method, unsigned seed) {
    const Body body = make_body(mesh);
    const auto reference_model = precomputed(body, method);
    std::vector<std::shared_ptr<const Model>> models;
    for (const auto& [mode, update] : ways_of(method.kind))
        models.push_back(precomputed(body, make_method(method.kind, method.tractions, mode, update)));
    std::mt19937 random(seed);
    for (const double share : {0.01, 0.05, 0.2, 0.4, 0.6})
        for (const bool with_fixed : {false, true}) {
            const ConstrainedSet set = random_set(mesh, share, with_fixed, random);
            if (set.handles.empty()) continue;
            const Eigen::VectorXd values = random_values(set, random);
            const Outcome reference = outcome(reference_model, set, values);
            for (const auto& model : models) {
                const Outcome other = outcome(model, set, values);
                EXPECT_LT((other.displacements - reference.displacements).norm(),
                          kTolerance * reference.displacements.norm())
                    << describe(model->method()) << ", " << share << (with_fixed ? " with a fixed set" : "");
                EXPECT_LT((other.forces - reference.forces).norm(), kTolerance * reference.forces.norm())
                    << describe(model->method()) << ", " << share << (with_fixed ? " with a fixed set" : "");
            }
        }
}

TEST_P(Agreement, OfAllUpdatesOnACube) { expect_agreement(make_box(4), GetParam(), 3); }
TEST_P(Agreement, OfAllUpdatesOnAnOrganicBody) { expect_agreement(make_potato(150).surface, GetParam(), 4); }

/// Contiguous patches: whole triangles, rims and lone vertices together.
TEST_P(Agreement, OfAllUpdatesOnPatches) {
    const OrganicBody organic = make_potato(150);
    const Body body = make_body(organic.surface);
    ConstrainedSet set{organic.fixed, organic.pull};
    for (int v = 0; v < organic.surface.n_vertices() && set.handles.size() == organic.pull.size(); ++v)
        if (std::find(set.fixed.begin(), set.fixed.end(), v) == set.fixed.end() &&
            std::find(set.handles.begin(), set.handles.end(), v) == set.handles.end())
            set.handles.push_back(v);
    std::mt19937 random(5);
    const Eigen::VectorXd values = random_values(set, random);
    const Eigen::VectorXd reference = displaced(precomputed(body, GetParam()), set, values);
    for (const auto& [mode, update] : ways_of(GetParam().kind)) {
        const Method method = make_method(GetParam().kind, GetParam().tractions, mode, update);
        EXPECT_LT((displaced(precomputed(body, method), set, values) - reference).norm(), kTolerance * reference.norm())
            << describe(method);
    }
}

/// Cached columns of earlier sets serve later ones: the result must be that of a model that never saw another set.
TEST_P(Agreement, OfManySetChangesWithFreshModels) {
    const SurfaceMesh mesh = make_box(3);
    const Body body = make_body(mesh);
    Deformer deformer(precomputed(body, GetParam()));
    std::mt19937 random(6);
    Control control;
    for (int change = 0; change < 12; ++change) {
        const ConstrainedSet set = random_set(mesh, 0.05 + 0.05 * change, change % 2 == 0, random);
        if (set.handles.empty()) continue;
        const Eigen::VectorXd values = random_values(set, random);
        deformer.constrain(set, control);
        const Eigen::VectorXd fresh = displaced(precomputed(body, GetParam()), set, values);
        EXPECT_LT((deformer.displace(values) - fresh).norm(), kTolerance * fresh.norm()) << "change " << change;
    }
}

/// A set whose columns do not fit into what is kept is served without keeping any.
TEST_P(Agreement, OfKeptWithRecomputedColumns) {
    const OrganicBody organic = make_potato(150);
    const Body body = make_body(organic.surface);
    std::mt19937 random(9);
    Method lean = GetParam();
    lean.column_memory = 0;
    const auto model = precomputed(body, GetParam()), lean_model = precomputed(body, lean);
    for (const ConstrainedSet& set :
         {ConstrainedSet{organic.fixed, organic.pull}, random_set(organic.surface, 0.3, false, random)}) {
        const Eigen::VectorXd values = random_values(set, random);
        const Outcome kept = outcome(model, set, values), recomputed = outcome(lean_model, set, values);
        EXPECT_LT((kept.displacements - recomputed.displacements).norm(), 1e-11 * kept.displacements.norm());
        EXPECT_LT((kept.forces - recomputed.forces).norm(), 1e-11 * kept.forces.norm());
    }
}

TEST_P(Agreement, OfADragResponseWithTheFullSolution) {
    const SurfaceMesh mesh = make_box(4);
    Deformer deformer(precomputed(make_body(mesh), GetParam()));
    Control control;
    ConstrainedSet set{vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }),
                       vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - 1e-9 && x[1] > 0.4; })};
    deformer.constrain(set, control);
    std::mt19937 random(7);
    const Eigen::VectorXd values = random_values(set, random);
    const Eigen::MatrixXd basis =
        Eigen::MatrixXd::Identity(3, 3).replicate(std::ssize(set.handles), 1);  // a rigid translation
    const DragResponse drag = deformer.drag_response(values, basis);
    const Eigen::Vector3d shift(0.1, -0.2, 0.3);
    Eigen::VectorXd u;
    drag.displace(shift, u);
    const Eigen::VectorXd fresh = deformer.displace(values + basis * shift);
    EXPECT_LT((u - fresh).norm(), 1e-12 * fresh.norm());
}

INSTANTIATE_TEST_SUITE_P(Methods, Agreement, ::testing::ValuesIn(method_variants()), [](const auto& test) {
    std::string text = std::string(name(test.param.kind)) + "_" + std::string(name(test.param.tractions));
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
});

TEST(FullVolume, AgreesWithTheCondensedMatrixAndWithOnDemand) {
    const SurfaceMesh mesh = make_box(4);
    const Body body = make_body(mesh);
    std::mt19937 random(8);
    const ConstrainedSet set = random_set(mesh, 0.2, false, random);
    const Eigen::VectorXd values = random_values(set, random);
    const Eigen::VectorXd reference = displaced(precomputed(body, make_method(kFem)), set, values);
    for (const Update update : {Update::direct, Update::eqn9, Update::reduced}) {
        const Method method = make_method(kFem, Tractions::discontinuous, Mode::full_volume, update);
        EXPECT_LT((displaced(precomputed(body, method), set, values) - reference).norm(), kTolerance * reference.norm())
            << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
