// Counts allocations: an assembly of the tangent makes none. Those of up to 4 KB are left out: the runtime of OpenMP
// makes some for each parallel region, whatever is in it.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "fem/nonlinear/bodies.hpp"
#include "fem/nonlinear/free_tangent.hpp"
#include "support/sanitized.hpp"

#if defined(__GLIBC__) && !defined(ELASTOLAB_TEST_SANITIZED)
#define ELASTOLAB_COUNTS_ALLOCATIONS
#endif

namespace {
constexpr std::size_t kOfRuntime = 4096;
std::atomic<long> allocations{0};
}  // namespace

#ifdef ELASTOLAB_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);
// NOLINTNEXTLINE: in place of the library's, for this program.
void* malloc(std::size_t size) noexcept {
    if (size > kOfRuntime) ++allocations;
    return __libc_malloc(size);
}
}
#endif

namespace elastolab {
namespace {

class Allocations : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(NonlinearFem, Allocations, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

TEST_P(Allocations, AreCounted) {
#ifndef ELASTOLAB_COUNTS_ALLOCATIONS
    GTEST_SKIP() << "another allocator";
#endif
    const long before = allocations;
    const Eigen::VectorXd some = Eigen::VectorXd::Zero(1000);
    EXPECT_GT(allocations, before) << some.size();
}

TEST_P(Allocations, AnAssemblyMakesNone) {
#ifndef ELASTOLAB_COUNTS_ALLOCATIONS
    GTEST_SKIP() << "another allocator";
#endif
    const test::HeldBar bar({12, 4, 4}, GetParam());
    Control control;
    const FreeTangent& tangent = bar.solver->newton().tangent();
    ElementWork work = bar.elements->make_work();
    SparseMatrix K = tangent.make_matrix();
    const Eigen::VectorXd u = bar.solve(bar.bent(40)).displacements.col(0);
    const auto assemble = [&] {
        bar.elements->stiffness(u, bar.material, false, work, control);
        tangent.assemble(work, 0.0, K, control);
        bar.elements->energy(u, bar.material, work, control);
    };
    assemble();  // the threads are there now
    const long before = allocations;
    for (int i = 0; i < 3; ++i) assemble();
    EXPECT_EQ(allocations, before);
    EXPECT_GT(K.coeffs().abs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace elastolab
