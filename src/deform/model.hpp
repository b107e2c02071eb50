#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/timer.hpp"
#include "deform/finding.hpp"
#include "deform/method.hpp"
#include "elasticity/material.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What is deformed: a checked surface (mesh/checks/check.hpp) of one or more solids, and what it is made of.
struct Body {
    std::string name;  ///< for messages, usually the file name
    std::shared_ptr<const SurfaceMesh> surface;
    Material material;
};

/// Facts about a precomputed model.
struct ModelFacts {
    int n_vertices = 0;
    int n_triangles = 0;
    int n_tetrahedra = 0;  ///< of methods with an inside
    int n_degrees_of_freedom = 0;
    StageTimes stages;                ///< seconds by stage of the precomputation
    std::uint64_t memory_bytes = 0;   ///< held by the model itself
    double condition_estimate = 0.0;  ///< 1-norm, of the factorised system
    Findings findings;                ///< made while precomputing
    Findings surface_findings;        ///< of the surface alone, whatever the material (src/findings)
};

/// Physical dimension of a quantity of elastostatics, E^young L^length: how it scales with Young's modulus and the unit
/// of length. Nodal stiffness (force over displacement) is {1, 1}, traction over displacement {1, -1}.
struct Dimension {
    int young = 0;
    int length = 0;
};

/// Dimensions of the blocks of a matrix that may have a border of six columns on the right and six rows below.
struct MatrixDimensions {
    Dimension nodes;
    bool has_border = false;
    Dimension columns = {}, rows = {}, corner = {};  ///< of the border
};

/// A named dense matrix for export; filled only when asked for. Khat is K bordered by six columns and rows: by the
/// rigid modes C of its nodes on both sides for FEM, by G^-1 C and C^T for BEM (C: the orthonormal basis that
/// elasticity/rigid_motion.hpp makes).
struct NamedMatrix {
    std::string name;  ///< "H", "G", "K", "Kinv" (D of the bordered inverse), "Khatinv" (the whole bordered inverse)
    Eigen::MatrixXd values;
    MatrixDimensions dimensions = {};
};

// Dimensions of the matrices that methods keep.
constexpr Dimension kNodalStiffness{1, 1}, kNodalCompliance{-1, -1};        ///< force over displacement; its inverse
constexpr Dimension kTractionStiffness{1, -1}, kTractionCompliance{-1, 1};  ///< traction over displacement; likewise

using SparseStiffness = Eigen::SparseMatrix<double>;

class SolidModel;

/// The response of a body to prescribed displacements, ready to be asked for any constrained set. Several solids in
/// one mesh are independent of each other. Immutable to its users; any thread may use it (columns that it computes on
/// demand are kept behind a lock).
class Model {
public:
    struct Part {
        std::shared_ptr<const SolidModel> solid;
        std::vector<int> vertices;  ///< vertex of the body, for each vertex of the solid
        /// Coordinates in which the solid is computed are scale * (x - origin), x those of the body (mesh/solids.hpp):
        /// of order one and near zero, whatever the unit of length and the place. `scale` is a power of two.
        Eigen::Vector3d origin = Eigen::Vector3d::Zero();
        double scale = 1.0;
    };

    Model(Body body, Method method, std::vector<Part> parts, ModelFacts facts);

    const Body& body() const { return body_; }
    const Method& method() const { return method_; }
    const ModelFacts& facts() const { return facts_; }
    const std::vector<Part>& parts() const { return parts_; }
    /// False while a constrained set, besides its answer, would prepare what further sets take over
    /// (Method::first_set_alone).
    bool serves_sets() const;

    /// The dense matrices that the mode keeps (none on demand), solid by solid when there are several.
    void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const;
    /// The sparse stiffness over all nodes, surface vertices first, solid by solid, of methods that have one.
    void visit_sparse_stiffness(
        const std::function<void(const std::string& name, const SparseStiffness&)>& visit) const;

private:
    Body body_;
    Method method_;
    std::vector<Part> parts_;
    ModelFacts facts_;
};

}  // namespace elastolab
