#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "deform/element_degree.hpp"
#include "deform/machine_speed.hpp"

namespace elastolab {

class Control;
class SolidModel;
struct Method;
struct SurfaceMesh;

/// What is computed ahead.
///   on_demand    one factorisation; columns of the compliance when they are needed, kept
///   full         K and its bordered inverse in memory, of the surface vertices (FEM: condensed) or triangles
///   full_volume  the dense matrix over all nodes, inside ones too, and its inverse, as in the paper
enum class Mode { on_demand, full, full_volume };

/// Tractions of collocation on constrained parts (docs/formulation.md section 4).
///   discontinuous  linear on each constrained triangle by itself
///   restricted     a hat function per constrained vertex, cut to the constrained triangles
///   continuous     a whole hat function per constrained vertex, as in the paper
enum class Tractions { discontinuous, restricted, continuous };

/// How displacements follow from prescribed ones.
///   direct   Eqn. 7, K00 factorised afresh for every constrained set
///   eqn9     Eqn. 9 as the paper writes it
///   reduced  its collapsed form (9'): a system as small as the constrained set
enum class Update { direct, eqn9, reduced };

inline constexpr std::array kAllModes = {Mode::on_demand, Mode::full, Mode::full_volume};
inline constexpr std::array kAllTractions = {Tractions::discontinuous, Tractions::restricted, Tractions::continuous};
inline constexpr std::array kAllUpdates = {Update::direct, Update::eqn9, Update::reduced};
inline constexpr std::array kAllElements = {ElementDegree::quadratic, ElementDegree::linear};

/// What a precomputation would take, before it is begun. Its work includes a first constrained set of a tenth of the
/// vertices. Memory is what the model's arrays add up to; what a constrained set takes beyond:
/// Deformer::predict_memory.
struct Cost {
    std::int64_t degrees_of_freedom = 0;
    std::uint64_t memory_bytes = 0;  ///< at its peak, beyond what the program holds already
    Work work = {};

    double seconds() const { return work.seconds(); }
};

/// MethodTraits::reported_error of methods whose estimate is of the size of the error: half the error that must be
/// told.
inline constexpr double kReportedError = 0.05;

/// Everything that code above the methods may know about one: a row of the table that src/methods collects. Every rule
/// about methods is read from here, so that a new one is a folder with such a row.
struct MethodTraits {
    std::string_view name;   ///< in scene files, command lines and tables
    std::string_view label;  ///< for people
    /// Index into the colours of bodies and of curves in plots; differs from method to method.
    int colour = 0;
    /// What the factorised matrix is called in messages.
    std::string_view matrix;
    /// What to choose when memory does not suffice on demand, for a sentence that begins "Choose".
    std::string_view cheaper;
    /// What helps where the error estimate finds the mesh too coarse, one or two sentences.
    std::string_view against_coarseness = {};

    std::span<const Mode> modes;
    std::span<const Update> updates;
    /// Displacements are linear in the prescribed values. False: they are equilibria of large deformations, each found
    /// by iteration from another (Approach in deform/equilibrium.hpp), and there may be several for the same values.
    bool linear = true;
    bool chooses_tractions = false;      ///< Method::tractions means something
    bool chooses_elements = false;       ///< Method::elements means something
    bool chooses_rims = false;           ///< Method::rims means something
    bool has_inside = false;             ///< nodes inside: the surface must be one that tetrahedra can fill
    bool full_serves_sets = true;        ///< the mode full makes constrained sets faster than on demand
    bool sparse = false;                 ///< the matrix factorised on demand is sparse
    bool shows_averages = false;         ///< nodes are triangles; a vertex is shown at the mean of those around it
    bool takes_incompressible = true;    ///< Poisson's ratio 1/2 itself
    double largest_poisson_ratio = 0.5;  ///< refused beyond
    bool K_takes_incompressible = true;  ///< so do K and the updates that need it (direct and eqn9 in the mode full)
    bool locks = false;                  ///< errors grow without bound as Poisson's ratio nears 1/2
    double integral_tolerance = 0.0;     ///< Method::integral_tolerance where it is not chosen
    bool balances_forces = true;         ///< reactions add up to zero; false: collocation, bad for slender bodies
    bool integrates_boundary = false;    ///< slivers and thin walls cost accuracy (src/findings)
    /// Estimated relative error of the worst vertex above which the user should know (of reactions, twice that); none
    /// where there is no estimate.
    std::optional<double> reported_error = {};

    /// Precomputes one solid of unit Young's modulus; `before`: a model of the same solid, by whatever method, from
    /// which all that still serves is taken over, or null. `name` is that of the body, for messages.
    /// Throws MeshError, SolveError, Cancelled.
    std::shared_ptr<const SolidModel> (*precompute)(const SurfaceMesh& surface, const std::string& name,
                                                    double poisson_ratio, const Method& method,
                                                    const SolidModel* before, Control& control) = nullptr;
    Cost (*predict)(const SurfaceMesh& surface, const Method& method) = nullptr;
};

/// Which method: how a body is turned into a linear map between displacements and loads. A row of the table; compared
/// by address.
using MethodKind = const MethodTraits*;

/// A method with all its choices; the defaults are those of the program.
struct Method {
    MethodKind kind = nullptr;  ///< never null where a Method is used
    Mode mode = Mode::on_demand;
    Tractions tractions = Tractions::discontinuous;
    Update update = Update::reduced;
    ElementDegree elements = ElementDegree::quadratic;  ///< nonlinear FEM: ten nodes or four
    /// FEM: by how much tetrahedra grow away from the surface (TetOptions::growth). Nothing: by their default_growth().
    std::optional<double> growth = {};
    /// Galerkin BEM: rows of thin triangles that are added along the rims of the constrained patches and along
    /// re-entrant edges, at most kMostRims. With any, every constrained set is then solved afresh, whatever the update
    /// is.
    int rims = 0;
    /// Galerkin BEM, on demand by the update `reduced`: a first constrained set with handles is solved by itself where
    /// that is much sooner, and what further sets take over is made later (Model::serves_sets).
    bool first_set_alone = false;
    /// BEM: number of vertices from which matrices are hierarchical, on demand. By linear BEM a cube of 3458 vertices
    /// with a fixed face and a patch took 29 s with a dense factor, one of 5402 takes 13 s with them; only a further
    /// handle of a few vertices, whose columns are few, is cheaper with the factor.
    int hierarchical_from = 3000;
    /// BEM: relative error allowed to a boundary integral; decides which rule is used where. 0: that of the method
    /// (MethodTraits::integral_tolerance).
    double integral_tolerance = 0.0;
    /// BEM: bytes of response columns kept at most; sets that need more are served without keeping any. Nothing: an
    /// eighth of the matrix and 40 MiB on demand, one matrix and 40 MiB in the mode `full`.
    std::optional<std::uint64_t> column_memory = {};
};

/// Of Method::rims: what is left of the error is elsewhere then.
inline constexpr int kMostRims = 3;

/// Relative error allowed to a boundary integral.
inline double integral_tolerance(const Method& method) {
    return method.integral_tolerance > 0.0 ? method.integral_tolerance : method.kind->integral_tolerance;
}

bool has(MethodKind kind, Mode mode);
bool has(MethodKind kind, Update update);

/// Why a method cannot be used with these choices at this Poisson's ratio, with a way forward; empty when it can.
std::string refusal(const Method& method, double poisson_ratio);

/// Whether a system is factorised before there is a constrained set: not on demand with the update direct or with finer
/// rims, where each set has a system of its own.
inline bool factorises_ahead(const Method& method) {
    return method.mode != Mode::on_demand || (method.update != Update::direct && method.rims == 0);
}

/// The names used in scene files, command lines and tables; parse_* return nothing for an unknown name.
inline std::string_view name(MethodKind kind) { return kind->name; }
std::string_view name(Mode mode);
std::string_view name(Tractions tractions);
std::string_view name(Update update);
std::optional<Mode> parse_mode(std::string_view text);
std::optional<Tractions> parse_tractions(std::string_view text);
std::optional<Update> parse_update(std::string_view text);
std::string_view name(ElementDegree elements);
std::optional<ElementDegree> parse_elements(std::string_view text);

}  // namespace elastolab
