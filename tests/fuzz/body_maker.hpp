#pragma once

#include <cstdint>

#include "fuzz/mutator.hpp"

namespace elastolab::fuzz {

/// Input `number` of the run of `seed`: a scene and its mesh, both well-formed files. The body is one that meshers and
/// integrals find hard: plates and needles down to 1e-8 of their length, fans, shears, twisted bars, triangles twice,
/// holes, soups, bodies within bodies, of sizes from 1e-40 to 1e40. It is pulled, turned, pressed or loaded, held or
/// not, by any method.
Input make_body(std::uint64_t seed, std::uint64_t number);

}  // namespace elastolab::fuzz
