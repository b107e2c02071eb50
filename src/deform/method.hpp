#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace elastolab {

/// How a body is turned into a linear map between displacements and loads.
enum class MethodKind { fem, constant_bem, linear_bem };

/// What is computed ahead.
///   on_demand    one factorisation; columns of the compliance when they are needed, kept
///   full         K and its bordered inverse in memory, of the surface vertices (FEM: condensed) or triangles
///   full_volume  FEM only: the dense matrix over all nodes and its inverse, as in the paper
enum class Mode { on_demand, full, full_volume };

/// Tractions of linear BEM on constrained parts (docs/formulation.md section 4).
///   discontinuous  linear on each constrained triangle by itself
///   restricted     a hat function per constrained vertex, cut to the constrained triangles
///   continuous     a whole hat function per constrained vertex, as in the paper
enum class Tractions { discontinuous, restricted, continuous };

/// How displacements follow from prescribed ones.
///   direct   Eqn. 7, K00 factorised afresh for every constrained set
///   eqn9     Eqn. 9 as the paper writes it
///   reduced  its collapsed form (9'): a system as small as the constrained set
enum class Update { direct, eqn9, reduced };

/// A method with all its choices; the defaults are those of the program.
struct Method {
    MethodKind kind = MethodKind::linear_bem;
    Mode mode = Mode::on_demand;
    Tractions tractions = Tractions::discontinuous;
    Update update = Update::reduced;
    /// BEM: relative error allowed to a boundary integral; decides where Gauss rules replace closed forms.
    double integral_tolerance = 1e-10;
    /// BEM: keep the material-free integrals (1.1 times the memory of the matrix itself), so that another Poisson's
    /// ratio integrates nothing.
    bool keep_integrals = false;
    /// BEM: bytes of response columns kept at most; sets that need more are served without keeping any. Nothing: an
    /// eighth of the matrix and 40 MiB on demand, one matrix and 40 MiB in the mode `full`.
    std::optional<std::uint64_t> column_memory = {};
};

/// Whether boundary elements factorise a system before there is a constrained set: not on demand by the update direct,
/// by which each set has a system of its own.
inline bool factorises_ahead(const Method& method) {
    return method.mode != Mode::on_demand || method.update != Update::direct;
}

/// The names used in scene files, command lines and tables; parse_* return nothing for an unknown name.
std::string_view name(MethodKind kind);
std::string_view name(Mode mode);
std::string_view name(Tractions tractions);
std::string_view name(Update update);
std::optional<MethodKind> parse_method_kind(std::string_view text);
std::optional<Mode> parse_mode(std::string_view text);
std::optional<Tractions> parse_tractions(std::string_view text);
std::optional<Update> parse_update(std::string_view text);

}  // namespace elastolab
