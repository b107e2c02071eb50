// Run by mpirun. Whichever allocation of whichever process fails, all processes end the order together, and follow the
// next one.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <mpi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "fem/constraints.hpp"
#include "petsc/session.hpp"
#include "petsc/share.hpp"
#include "petsc/stiffness.hpp"

namespace {

/// Which process's allocation fails, as many of them from now on. Shared by all processes, on one machine.
struct Fault {
    std::atomic<int> process{-1};
    std::atomic<long> countdown{0};
};
Fault* fault = nullptr;
int own_process = -1;

bool strikes() { return fault != nullptr && fault->process == own_process && --fault->countdown == 0; }

/// The same memory on all processes, through a file that is gone when all have opened it.
Fault* shared_fault() {
    std::array<char, 32> name{"/tmp/elastolab-fault-XXXXXX"};
    const Fault none;
    if (own_process == 0) {
        const int made = mkstemp(name.data());
        if (write(made, &none, sizeof none) != sizeof none) std::abort();
        close(made);
    }
    MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    const int file = open(name.data(), O_RDWR);
    void* memory = mmap(nullptr, sizeof none, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    MPI_Barrier(MPI_COMM_WORLD);
    if (own_process == 0) unlink(name.data());
    if (memory == MAP_FAILED) std::abort();
    return static_cast<Fault*>(memory);
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
// NOLINTNEXTLINE: what the linker's --wrap=malloc has the program's own code call, Eigen's in particular.
void* __wrap_malloc(std::size_t size) { return strikes() ? nullptr : __real_malloc(size); }
}

// NOLINTBEGIN: in place of the library's, for this program.
void* operator new(std::size_t size) {
    void* memory = strikes() ? nullptr : __real_malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // gcc sees one of the two inlined
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// NOLINTEND

namespace elastolab {
namespace {

class Faults : public testing::TestWithParam<Engine> {
protected:
    void SetUp() override {
        Session::current().engine = GetParam();
        force_.setZero(cube_.positions.size(), 1);
        force_.bottomRows<1>().setOnes();
    }
    void TearDown() override { fault->process = -1; }

    /// All orders: of a held body and of a grounded one.
    Eigen::MatrixXd solve() {
        Control control;
        PetscStiffness K(cube_.positions, cube_.elements, cube_.poisson_ratio, control);
        K.eliminate(std::vector{0, 1, 2, kNodesOfEdge, kNodesOfEdge + 1}, control);
        Eigen::MatrixXd u = K.solve(force_, kPetscTolerance, control);
        K.ground(choose_support(cube_.positions, cube_.n_all), control);
        u += K.multiply_sizes(K.multiply(u, control), control);
        return u;
    }
    /// The words with which these orders fail where the n-th allocation of a process does; empty: there are fewer.
    std::string words_after(int process, long n) {
        fault->countdown = n;
        fault->process = process;
        std::string words;
        try {
            solve();
        } catch (const SolveError& error) {
            words = error.what();
        } catch (const std::bad_alloc&) {
            words = "first process, between two orders";
        }
        fault->process = -1;
        const bool struck = fault->countdown <= 0;
        EXPECT_EQ(words.empty(), !struck) << "process " << process << ", allocation " << n;
        return words;
    }

    static constexpr int kNodesOfEdge = 4;
    const Share cube_ = share_of_grid(0, 1, kNodesOfEdge - 1, ElementDegree::linear, 0.3);
    Eigen::MatrixXd force_;
};

INSTANTIATE_TEST_SUITE_P(Petsc, Faults, testing::Values(Engine::mumps, Engine::gamg),
                         [](const auto& engine) { return engine.param == Engine::mumps ? "Mumps" : "Gamg"; });

TEST_P(Faults, OfMemoryOnOneProcessEndTheOrderOnAll) {
    const Eigen::MatrixXd expected = solve();
    for (int process = 0; process < Session::current().n_processes(); ++process) {
        long n = 1, n_of_orders = 0;
        for (std::string words = words_after(process, n); !words.empty(); words = words_after(process, ++n))
            if (words.find("memory") != std::string::npos) ++n_of_orders;
        EXPECT_GT(n_of_orders, 20) << "process " << process << " failed " << n - 1 << " times";
    }
    EXPECT_LT((solve() - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace elastolab

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    elastolab::Session session;
    own_process = session.process();
    fault = shared_fault();
    if (session.first()) return RUN_ALL_TESTS();
    elastolab::Control control;
    session.serve(control);
    return 0;
}
