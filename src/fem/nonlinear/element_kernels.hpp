#pragma once

// Plain arrays only: this header is also read by sources compiled for particular instruction sets.

namespace elastolab {

/// Elements that are evaluated together, one a lane.
constexpr int kPack = 8;

/// Rest geometry of kPack tetrahedra.
struct ElementPack {
    double gradients[4][3][kPack];  ///< of the barycentric coordinates [1/L]
    double volume[kPack];           ///< [L^3]; 0 for lanes that only fill the pack
};

/// What is asked of a pack; null pointers are left out. n: nodes of an element.
struct PackResult {
    double* energy = nullptr;        ///< kPack [force * L]; not finite where an element is inverted
    double* least_J = nullptr;       ///< kPack: smallest J = det F at a Gauss point
    double* forces = nullptr;        ///< n x 3 x kPack: d energy / d u
    double* stiffness = nullptr;     ///< n (n + 1) / 2 x 9 x kPack: d forces / d u, blocks (a, b), b <= a, one row of a
                                     ///< after the other; entries of a block column by column
    const double* change = nullptr;  ///< n x 3 x kPack: of u
    double* force_change = nullptr;  ///< n x 3 x kPack: the stiffness times `change`
};

/// Neo-Hookean tetrahedra of straight edges, of 4 nodes (one Gauss point) or 10 (four): energy and its derivatives at
/// displacements u, n x 3 x kPack [L]. mu, lambda: Lame's constants.
struct ElementKernels {
    const char* name;  ///< instruction set
    void (*linear)(const ElementPack&, const double* u, double mu, double lambda, const PackResult&);
    void (*quadratic)(const ElementPack&, const double* u, double mu, double lambda, const PackResult&);
};

/// The widest that this CPU can run.
const ElementKernels& best_element_kernels();
/// Without special instructions.
const ElementKernels& plain_element_kernels();

/// The four Gauss points of a tetrahedron, exact to second degree: one barycentric coordinate is kGaussNear, the others
/// are kGaussFar; equal weights.
constexpr double kGaussNear = 0.58541019662496845446, kGaussFar = 0.13819660112501051518;

}  // namespace elastolab
