// An iteration of nonlinear FEM beside CHOLMOD's numeric factorisation of the same tangent, side by side in one run.
//   iteration  element tangents, assembly, factorisation, solve, energy and forces of the next state
//   cholmod    cholmod_factorize of that tangent, its analysis made before
#include <benchmark/benchmark.h>
#include <cholmod.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <vector>

#include "base/blas.hpp"
#include "nonlinear/bodies.hpp"

namespace elastolab {
namespace {

/// Processor time of all threads: others may use the machine meanwhile.
double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A bent box of n x n x n cells, held at one side and turned at the other.
struct Bent {
    explicit Bent(int n, ElementDegree degree)
        : elements(test::elements_of_box({n, n, n}, {1, 1, 1}, degree)),
          ends(test::nodes_where(*elements, [](const auto& p) { return p[0] == 0.0 || p[0] == 1.0; })),
          tangent(std::make_shared<const FreeTangent>(elements, ends, control)),
          newton(tangent, material, 0.0),
          work(elements->make_work()),
          K(tangent->make_matrix()),
          u(3 * elements->n_nodes()) {
        for (int node = 0; node < elements->n_nodes(); ++node) {
            const Eigen::Vector3d x = elements->positions().col(node);
            u.segment<3>(3 * node) = test::rotation(Eigen::Vector3d::UnitZ(), 10 * x[0]) * x - x;
        }
    }
    void iterate() {
        elements->stiffness(u, material, false, work, control);
        tangent->assemble(work, 0.0, K, control);
        const std::optional<SparseCholesky> factor = factorised(*tangent, K, control);
        const Eigen::VectorXd forces = elements->forces(u, material, work, control);
        const Eigen::MatrixXd step = factor.value().solve(tangent->free_rows(forces));
        const Eigen::VectorXd next = u - 1e-6 * tangent->all_rows(step);
        benchmark::DoNotOptimize(elements->energy(next, material, work, control));
    }
    void assemble() {
        elements->stiffness(u, material, false, work, control);
        tangent->assemble(work, 0.0, K, control);
    }

    Control control;
    Material material{1.0, 0.3};
    std::shared_ptr<const FiniteElements> elements;
    std::vector<int> ends;
    std::shared_ptr<const FreeTangent> tangent;
    Newton newton;
    ElementWork work;
    SparseMatrix K;
    Eigen::VectorXd u;
};

/// CHOLMOD's own factorisation, with its best ordering.
class Cholmod {
public:
    explicit Cholmod(SparseMatrix& K) {
        cholmod_start(&common_);
        common_.supernodal = CHOLMOD_SUPERNODAL;
        view_.nrow = view_.ncol = static_cast<std::size_t>(K.rows());
        view_.nzmax = static_cast<std::size_t>(K.nonZeros());
        view_.p = K.outerIndexPtr();
        view_.i = K.innerIndexPtr();
        view_.x = K.valuePtr();
        view_.stype = -1;
        view_.itype = CHOLMOD_INT;
        view_.xtype = CHOLMOD_REAL;
        view_.dtype = CHOLMOD_DOUBLE;
        view_.sorted = view_.packed = 1;
        factor_ = cholmod_analyze(&view_, &common_);
    }
    ~Cholmod() {
        cholmod_free_factor(&factor_, &common_);
        cholmod_finish(&common_);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;
    void factorise() { cholmod_factorize(&view_, factor_, &common_); }

private:
    cholmod_common common_{};
    cholmod_sparse view_{};
    cholmod_factor* factor_ = nullptr;
};

template <class Work>
double least_seconds(const Work& run) {
    double least = 1e300;
    for (int i = 0; i < 5; ++i) {
        const double before = cpu_seconds();
        run();
        least = std::min(least, cpu_seconds() - before);
    }
    return least;
}

void iteration_beside_cholmod(benchmark::State& state) {
    const auto degree = state.range(0) == 4 ? ElementDegree::linear : ElementDegree::quadratic;
    Bent body(static_cast<int>(state.range(1)), degree);
    body.assemble();
    Cholmod cholmod(body.K);
    for (auto _ : state) {
        const double iteration = least_seconds([&] { body.iterate(); });
        const double assembly = least_seconds([&] { body.assemble(); });
        const double cholesky = least_seconds([&] { cholmod.factorise(); });
        state.counters["unknowns"] = static_cast<double>(body.tangent->size());
        state.counters["iteration_ms"] = 1e3 * iteration;
        state.counters["assembly_ms"] = 1e3 * assembly;
        state.counters["cholmod_ms"] = 1e3 * cholesky;
        state.counters["ratio"] = iteration / cholesky;
    }
}
BENCHMARK(iteration_beside_cholmod)->Args({4, 12})->Args({4, 18})->Args({10, 6})->Args({10, 10})->Iterations(1);

}  // namespace
}  // namespace elastolab

int main(int argc, char** argv) {
    elastolab::prepare_parallel_libraries(argv);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
