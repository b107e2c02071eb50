#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/cost.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "support/sanitized.hpp"

namespace elastolab::test {
namespace {

/// VmHWM and the like of this process, in bytes.
double memory_of_process(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind(key + ":", 0) == 0) return 1024.0 * std::stod(line.substr(key.size() + 1));
    return 0.0;
}

/// From here on, the peak of the resident memory is that of what follows. False where the system does not let us.
bool reset_peak() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    return memory_of_process("VmHWM") < 1.1 * memory_of_process("VmRSS");
}

/// These vertices in some order, as far as a share of them reaches.
std::vector<int> share_of(int n_vertices, double share, const std::function<void(std::vector<int>&)>& order) {
    std::vector<int> vertices(static_cast<std::size_t>(n_vertices));
    std::iota(vertices.begin(), vertices.end(), 0);
    order(vertices);
    vertices.resize(static_cast<std::size_t>(share * n_vertices));
    return vertices;
}

std::vector<int> random_vertices(const SurfaceMesh& mesh, double share, unsigned seed) {
    return share_of(mesh.n_vertices(), share,
                    [&](std::vector<int>& v) { std::shuffle(v.begin(), v.end(), std::mt19937(seed)); });
}

/// The vertices nearest to a corner: one contiguous patch.
std::vector<int> patch(const SurfaceMesh& mesh, double share, const Eigen::Vector3d& corner) {
    const auto nearer = [&](int a, int b) {
        return (mesh.vertices.col(a) - corner).norm() < (mesh.vertices.col(b) - corner).norm();
    };
    return share_of(mesh.n_vertices(), share, [&](std::vector<int>& v) { std::sort(v.begin(), v.end(), nearer); });
}

/// Moves these vertices together; all others must follow.
void expect_translation(Deformer& deformer, const std::vector<int>& vertices) {
    Control control;
    deformer.constrain({{}, vertices}, control);
    const Eigen::VectorXd u = deformer.displace(Eigen::VectorXd::Constant(3 * std::ssize(vertices), 0.1));
    EXPECT_LT((u.array() - 0.1).abs().maxCoeff(), 1e-9);
}

class MemoryOfTractions : public ::testing::TestWithParam<Tractions> {};

/// On demand, linear BEM keeps one matrix and what the constrained sets need; nothing else of the matrix's size. The
/// last set has nothing in common with the one before, which stays alive until the new one is ready.
TEST_P(MemoryOfTractions, StaysWithinAThirdMoreThanTheMatrix) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
    const SurfaceMesh mesh = make_box(10);
    // Beside the matrix: the columns of two sets, which fill their 40 MiB where a slot belongs to a triangle alone.
    const double of_sets = GetParam() == Tractions::discontinuous ? 115e6 : 45e6;
    const double n = 3.0 * mesh.n_vertices() + 6.0, bound = 1.3 * n * n * 8.0 + of_sets;
    for (const bool contiguous : {true, false}) {
        return_freed_memory();  // of tests before, which would be used again
        ASSERT_TRUE(reset_peak());
        const double before = memory_of_process("VmRSS");
        Deformer deformer(precomputed(make_body(mesh), make_method(kLinearBem, GetParam())));
        unsigned seed = 0;
        for (const double share : {0.1, 0.2, 0.4, 0.4}) {
            const Eigen::Vector3d corner = Eigen::Vector3d::Constant(seed++ < 3 ? 0.0 : 1.0);
            expect_translation(deformer, contiguous ? patch(mesh, share, corner) : random_vertices(mesh, share, seed));
            const double peak = memory_of_process("VmHWM") - before;
            print_measured(std::string(contiguous ? "patch" : "random set") + " of " + std::to_string(share) +
                               " of the vertices, peak memory over the bound",
                           peak / bound);
            EXPECT_LT(peak, bound) << share << (contiguous ? " patch" : " random");
        }
    }
}

/// What predict_memory says, against what the process then takes.
TEST_P(MemoryOfTractions, IsPredicted) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
    // Each in a process of its own: memory that others have freed would be used again, and not be counted.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const SurfaceMesh mesh = make_box(10);
    for (const Update update : {Update::reduced, Update::direct})
        for (const bool contiguous : {true, false}) {
            const auto measure = [&] {
                const std::vector<int> vertices =
                    contiguous ? patch(mesh, 0.3, Eigen::Vector3d::Zero()) : random_vertices(mesh, 0.3, 1);
                Deformer deformer(
                    precomputed(make_body(mesh), make_method(kLinearBem, GetParam(), Mode::on_demand, update)));
                const auto predicted = static_cast<double>(deformer.predict_memory({{}, vertices}));
                return_freed_memory();
                if (!reset_peak()) std::exit(2);
                const double before = memory_of_process("VmRSS");
                Control control;
                deformer.constrain({{}, vertices}, control);
                const double taken = memory_of_process("VmHWM") - before;
                std::fprintf(stderr, "predicted %.3g, taken %.3g bytes\n", predicted, taken);
                std::exit(predicted > 0.9 * taken && predicted < 1.6 * taken + 10e6 ? 0 : 1);
            };
            EXPECT_EXIT(measure(), ::testing::ExitedWithCode(0), "")
                << name(update) << (contiguous ? " patch" : " random");
        }
}

INSTANTIATE_TEST_SUITE_P(LinearBem, MemoryOfTractions, ::testing::ValuesIn(kAllTractions),
                         [](const auto& test) { return std::string(name(test.param)); });

/// Limits the address space to what is taken already and some bytes more, while it lives.
class AddressSpaceLimit {
public:
    explicit AddressSpaceLimit(std::uint64_t more) {
        getrlimit(RLIMIT_AS, &before_);
        rlimit limit = before_;
        limit.rlim_cur = static_cast<rlim_t>(memory_of_process("VmSize")) + more;
        setrlimit(RLIMIT_AS, &limit);
    }
    ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

private:
    rlimit before_{};
};

/// A held end and a handle at the other.
ConstrainedSet two_ends(const SurfaceMesh& mesh, double share) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff(), high = mesh.vertices.rowwise().maxCoeff();
    return {patch(mesh, 0.05, low), patch(mesh, share, high)};
}

TEST(Memory, OfFemIsPredictedFromTheSurfaceToTheFirstSetAndForLaterOnes) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
    SurfaceMesh lump = make_sphere(18);  // 1298 vertices
    lump.vertices.row(0) *= 1.6;
    lump.vertices.row(2) += 0.3 * lump.vertices.row(0).array().square().matrix();
    struct Case {
        MethodKind kind;
        SurfaceMesh mesh;
        double share;  // of the vertices, pulled
    };
    for (const Case& c : {Case{kFem, lump, 0.02}, Case{kFem, make_box(17), 0.4},
                          Case{kFem, make_box(4, {9, 9, 1}), 0.02}, Case{kQuadraticFem, make_sphere(9), 0.05},
                          Case{kNonlinearFem, make_sphere(8), 0.05}, Case{kNonlinearFem, make_box(7), 0.05}}) {
        SCOPED_TRACE(testing::Message() << c.kind->name << ", " << c.mesh.n_vertices() << " vertices");
        const Body body = make_body(c.mesh);
        const ConstrainedSet set = two_ends(c.mesh, c.share);
        const auto predicted = static_cast<double>(predict_cost(c.mesh, make_method(c.kind)).memory_bytes);
        constexpr double kSmall = 8e6;  // of the allocator, and of the threads
        ASSERT_TRUE(reset_peak());
        double before = memory_of_process("VmRSS");
        Control control;
        Deformer deformer(precomputed(body, make_method(c.kind)));
        const double held = memory_of_process("VmRSS");
        const auto of_set = static_cast<double>(deformer.predict_memory(set));
        deformer.constrain(set, control);
        // Of large deformations it is an answer that counts, for which factors at rest and on the way are there.
        const double motion = c.kind->linear ? 0.0 : 0.1;
        deformer.displace(Eigen::VectorXd::Constant(3 * std::ssize(set.handles), motion));
        const double peak = memory_of_process("VmHWM");
        std::printf("[ measured ] %d vertices: %.0f MB, predicted %.0f; the set %.0f, predicted %.0f\n",
                    c.mesh.n_vertices(), 1e-6 * (peak - before), 1e-6 * predicted, 1e-6 * (peak - held), 1e-6 * of_set);
        EXPECT_LT(predicted, 1.3 * (peak - before) + kSmall);
        EXPECT_GT(predicted, (peak - before) / 1.3 - kSmall);
        EXPECT_LT(of_set, 1.3 * (peak - held) + kSmall);
        EXPECT_GT(of_set, (peak - held) / 1.3 - kSmall);
    }
}

TEST(Memory, ThatASetWouldLackIsSaidBeforeItIsComputedAndThePreviousSetStays) {
    const SurfaceMesh mesh = make_box(6);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    const ConstrainedSet large{fixed, vertices_where(mesh, [](const auto& x) { return x[0] > 0.2; })};
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({fixed, {mesh.n_vertices() - 1}}, control);
        const Eigen::VectorXd before = deformer.displace(Eigen::Vector3d(0.1, 0.0, 0.0));
        try {
            const AddressSpaceLimit limit(deformer.predict_memory(large) / 2);
            deformer.constrain(large, control);
            FAIL() << "was begun, " << describe(method);
        } catch (const SolveError& error) {
            EXPECT_NE(std::string(error.what()).find("body: "), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("MB"), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("fewer"), std::string::npos) << error.what();
        }
        EXPECT_EQ(deformer.displace(Eigen::Vector3d(0.1, 0.0, 0.0)), before) << describe(method);
        EXPECT_NO_THROW(deformer.constrain(large, control)) << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
