#pragma once

namespace elastolab {

/// What this CPU can run, of the sets that kernels are compiled for: AVX2 with FMA; AVX-512 F, DQ, CD, BW and VL.
enum class InstructionSet { plain, avx2, avx512 };

inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
    return InstructionSet::plain;
}

}  // namespace elastolab
