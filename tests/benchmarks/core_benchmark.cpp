// Speed of the core beside the LAPACK calls or memory traffic that it cannot do without. Every benchmark alternates the
// two and reports `ratio`, the median over the rounds of one divided by the other, so that a busy machine slows both,
// and `target`, the ratio that is wanted.
//   build/release/tests/benchmarks/core_benchmark

#include <random>

#include "base/blas.hpp"
#include "base/lapack.hpp"
#include "bem/collocation/assembly.hpp"
#include "bem/collocation/method.hpp"
#include "bem/collocation/traction_space.hpp"
#include "bem/galerkin/method.hpp"
#include "benchmarks/tools.hpp"
#include "elasticity/rigid_motion.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

/// H of linear elements, bordered: what the precomputation factorises.
const Eigen::MatrixXd& bordered_matrix() {
    static const Eigen::MatrixXd matrix = [] {
        const Boundary boundary(cube());
        const Eigen::Index n = 3 * cube().n_vertices();
        Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 6, n + 6);
        Control control;
        assemble(Layer::double_layer, boundary, vertex_collocation_points(boundary), vertex_elements(boundary),
                 {1.0, 0.3}, 1e-10, bordered.topLeftCorner(n, n), control);
        const Eigen::MatrixXd modes = rigid_modes(cube().vertices);
        bordered.topRightCorner(n, 6) = modes;
        bordered.bottomLeftCorner(6, n) = modes.transpose();
        return bordered;
    }();
    return matrix;
}

void assembly_beside_its_lu(benchmark::State& state) {
    const Boundary boundary(cube());
    const CollocationPoints points = vertex_collocation_points(boundary);
    const Elements elements = vertex_elements(boundary);
    Eigen::MatrixXd H(3 * points.size(), 3 * elements.n_slots), copy;
    compare(
        state, 1.0,
        [&] {
            Control control;
            assemble(Layer::double_layer, boundary, points, elements, {1.0, 0.3}, 1e-10, H, control);
        },
        [&] { LuFactorization(std::move(copy), "H"); }, [&] { copy = bordered_matrix(); });
}

void on_demand_precomputation_beside_its_lu(benchmark::State& state) {
    const Body body = make_body(cube());
    Eigen::MatrixXd copy;
    compare(
        state, 2.2, [&] { benchmark::DoNotOptimize(precomputed(body, Method{.kind = kLinearBem})); },
        [&] { LuFactorization(std::move(copy), "H"); }, [&] { copy = bordered_matrix(); });
}

/// K = G^-1 H and K^-1 = H^-1 G: two factorisations, two solves of full rank.
void full_precomputation_beside_its_lapack_calls(benchmark::State& state) {
    const Body body = make_body(cube());
    Method method{.kind = kLinearBem};
    method.mode = Mode::full;
    Eigen::MatrixXd H, G, right;
    compare(
        state, 1.5, [&] { benchmark::DoNotOptimize(precomputed(body, method)); },
        [&] {
            const LuFactorization lu_H(std::move(H), "H"), lu_G(std::move(G), "G");
            lu_G.solve_in_place(right);
            lu_H.solve_in_place(right);
        },
        [&] { H = G = right = bordered_matrix(); });
}

std::vector<int> random_vertices(double share, unsigned seed) {
    std::vector<int> vertices(static_cast<std::size_t>(cube().n_vertices()));
    std::iota(vertices.begin(), vertices.end(), 0);
    std::shuffle(vertices.begin(), vertices.end(), std::mt19937(seed));
    vertices.resize(static_cast<std::size_t>(share * cube().n_vertices()));
    return vertices;
}

/// A tenth of the vertices: the left end of the cube and a patch of the right one.
std::vector<int> patches() {
    return vertices_where(cube(), [](const Eigen::Vector3d& x) {
        return (x[0] < 1e-9 && x[1] < 0.6) || (x[0] > 1 - 1e-9 && x[1] > 0.75 && x[2] > 0.75);
    });
}

/// A set change with no column known, under the traction model state.range(0). It needs the solves for the columns of
/// its unknowns, their product with the rows of the equations at interior points, and the factorisation of the small
/// system.
void change_set(benchmark::State& state, const std::vector<int>& vertices) {
    Method method{.kind = kLinearBem};
    method.tractions = static_cast<Tractions>(state.range(0));
    const Body body = make_body(cube());
    const LuFactorization lu(Eigen::MatrixXd(bordered_matrix()), "H");
    const Boundary boundary(cube());
    const TractionSpace space = linear_traction_space(boundary, VertexTriangles(cube()), method.tractions, vertices);
    const Eigen::Index unknowns = 3 * space.n_slots() + 3 * std::ssize(space.dropped_collocation);
    const Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(9 * std::ssize(space.interior_triangles), lu.size());
    std::shared_ptr<const Model> model;
    compare(
        state, 2.0,
        [&] {
            Control control;
            Deformer deformer(model);
            deformer.constrain({{}, vertices}, control);
        },
        [&] {
            Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(lu.size(), unknowns);
            lu.solve_in_place(columns);
            benchmark::DoNotOptimize((rows * columns).eval());
            Eigen::MatrixXd small = Eigen::MatrixXd::Random(unknowns + 6, unknowns + 6);
            LuFactorization(std::move(small), "capacitance system");
        },
        [&] { model = precomputed(body, method); });
    state.counters["unknowns"] = static_cast<double>(unknowns);
    state.counters["constrained"] = static_cast<double>(vertices.size());
}

void set_change_of_random_vertices_beside_its_lapack_calls(benchmark::State& state) {
    change_set(state, random_vertices(0.1, 1));
}
void set_change_of_patches_beside_its_lapack_calls(benchmark::State& state) { change_set(state, patches()); }

/// The same with all columns known: only the capacitance system is left.
void set_change_with_known_columns(benchmark::State& state) {
    Method method{.kind = kLinearBem};
    method.tractions = Tractions::restricted;
    const ConstrainedSet set{{}, random_vertices(0.1, 1)};
    Deformer deformer(precomputed(make_body(cube()), method));
    Control control;
    deformer.constrain(set, control);
    const Eigen::Index n = 3 * std::ssize(set.handles) + 6;
    compare(
        state, 0.0, [&] { deformer.constrain(set, control); },
        [&] {
            Eigen::MatrixXd small = Eigen::MatrixXd::Random(n, n);
            LuFactorization(std::move(small), "capacitance system");
        });
}

/// Bordered H of constant elements beside the LU of its system.
void constant_bem_precomputation_beside_its_lu(benchmark::State& state) {
    const Body body = make_body(cube());
    const Eigen::Index n = 3 * cube().n_triangles() + 6;
    Eigen::MatrixXd matrix;
    compare(
        state, 2.2, [&] { benchmark::DoNotOptimize(precomputed(body, make_method(kConstantBem))); },
        [&] { LuFactorization(std::move(matrix), "H"); }, [&] { matrix = Eigen::MatrixXd::Random(n, n); });
}

/// Symmetric Galerkin elements on demand, beside the LU of linear elements on the same cube.
void precomputation_of_galerkin_bem_beside_that_lu(benchmark::State& state) {
    const Body body = make_body(cube());
    Eigen::MatrixXd copy;
    compare(
        state, 1.2, [&] { benchmark::DoNotOptimize(precomputed(body, make_method(kGalerkinBem))); },
        [&] { LuFactorization(std::move(copy), "H"); }, [&] { copy = bordered_matrix(); });
}

/// One set on demand, from the surface to the displacements, by the update `direct`, which factorises once.
void single_solve_beside_the_lu_of_linear_bem(benchmark::State& state) {
    const Method method = make_method(all_methods()[static_cast<std::size_t>(state.range(0))], Tractions::discontinuous,
                                      Mode::on_demand, Update::direct);
    const Body body = make_body(cube());
    const ConstrainedSet set{
        vertices_where(cube(), [](const auto& x) { return x[0] < 1e-9; }),
        vertices_where(cube(), [](const auto& x) { return x[0] > 1 - 1e-9 && x[1] > 0.6 && x[2] > 0.6; })};
    const Eigen::VectorXd values = Eigen::Vector3d(0.1, 0.05, 0.0).replicate(std::ssize(set.handles), 1);
    Eigen::MatrixXd copy;
    compare(
        state, 0.0,
        [&] {
            Control control;
            Deformer deformer(precomputed(body, method));
            deformer.constrain(set, control);
            benchmark::DoNotOptimize(deformer.answer(values, {.residual = true}, control));
        },
        [&] { LuFactorization(std::move(copy), "H"); }, [&] { copy = bordered_matrix(); });
    state.counters["constrained"] = static_cast<double>(set.fixed.size() + set.handles.size());
}

void drag_frame_beside_a_copy_of_its_columns(benchmark::State& state) {
    const SurfaceMesh mesh = make_box(static_cast<int>(state.range(1)));
    const Method method = make_method(all_methods()[static_cast<std::size_t>(state.range(0))], Tractions::restricted);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    const auto pull = vertices_where(mesh, [](const auto& x) { return x[0] > 1 - 1e-9 && x[1] > 0.7 && x[2] > 0.7; });
    Deformer deformer(precomputed(make_body(mesh), method));
    Control control;
    deformer.constrain({fixed, pull}, control);
    const DragResponse drag = deformer.drag_response(Eigen::VectorXd::Zero(3 * std::ssize(pull)),
                                                     Eigen::MatrixXd::Identity(3, 3).replicate(std::ssize(pull), 1));
    Eigen::VectorXd u(drag.rest.size()), shift = Eigen::Vector3d(0.1, 0.2, 0.3);
    Eigen::MatrixXd copy(drag.X.rows(), 3);
    constexpr int kFrames = 100;
    compare(
        state, 4.0,
        [&] {
            for (int frame = 0; frame < kFrames; ++frame) {
                shift[0] += 1e-3;
                drag.displace(shift, u);
                benchmark::ClobberMemory();
            }
        },
        [&] {
            for (int frame = 0; frame < kFrames; ++frame) {
                copy = drag.X;
                benchmark::ClobberMemory();
            }
        });
    state.counters["vertices"] = mesh.n_vertices();
}

BENCHMARK(assembly_beside_its_lu)->UseManualTime()->Iterations(9)->Unit(benchmark::kMillisecond);
BENCHMARK(on_demand_precomputation_beside_its_lu)->UseManualTime()->Iterations(9)->Unit(benchmark::kMillisecond);
BENCHMARK(full_precomputation_beside_its_lapack_calls)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(set_change_of_random_vertices_beside_its_lapack_calls)
    ->ArgName("tractions")
    ->DenseRange(0, 2)
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(set_change_of_patches_beside_its_lapack_calls)
    ->ArgName("tractions")
    ->DenseRange(0, 2)
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(set_change_with_known_columns)->UseManualTime()->Iterations(9)->Unit(benchmark::kMillisecond);
BENCHMARK(constant_bem_precomputation_beside_its_lu)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(precomputation_of_galerkin_bem_beside_that_lu)->UseManualTime()->Iterations(9)->Unit(benchmark::kMillisecond);
BENCHMARK(single_solve_beside_the_lu_of_linear_bem)
    ->ArgName("method")
    ->DenseRange(0, 2)
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(drag_frame_beside_a_copy_of_its_columns)
    ->ArgNames({"method", "cells"})
    ->ArgsProduct({{0, 1, 2}, {4, 13}})
    ->Args({0, 29})  // 5048 vertices; a frame is the same for all methods
    ->UseManualTime()
    ->Iterations(30)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) { elastolab::test::run_benchmarks(argc, argv); }
