// Preloaded into a program: on one process, the allocations of one size fail. ELASTOLAB_FAULT is "PROCESS SIZE".
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::size_t failing_size() {
    const char* fault = std::getenv("ELASTOLAB_FAULT");
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    int process = 0;
    std::size_t size = 0;
    const bool here = fault != nullptr && rank != nullptr && std::sscanf(fault, "%d %zu", &process, &size) == 2 &&
                      std::atoi(rank) == process;
    return here ? size : SIZE_MAX;
}

}  // namespace

void* operator new(std::size_t size) {
    static const std::size_t failing = failing_size();
    void* memory = size == failing ? nullptr : std::malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
