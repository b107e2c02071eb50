#include "scene/document.hpp"

namespace elastolab {

bool operator==(const Document& a, const Document& b) {
    return a.mesh == b.mesh && a.material.young_modulus == b.material.young_modulus &&
           a.material.poisson_ratio == b.material.poisson_ratio && a.method == b.method && a.fixed == b.fixed &&
           a.handles == b.handles;
}

}  // namespace elastolab
