#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/picture/reaction_runner.hpp"
#include "app/settings.hpp"
#include "scene/live/embedded_runner.hpp"

namespace elastolab {

// What a method's answer says at vertices: the fields that colour a body, and how far two answers differ.

/// Whether the reference answers the same question, so that the two differ by their methods only.
bool comparable(const EmbeddedRunner& answer, const EmbeddedRunner* reference);

/// How far one answer is from the reference, over all vertices.
struct Difference {
    double max = 0.0, rms = 0.0;                    ///< [L]
    double relative_max = 0.0, relative_rms = 0.0;  ///< over the same norm of the reference's displacements
    int worst_vertex = -1;
};
/// Nothing where they are not comparable().
std::optional<Difference> difference_between(const EmbeddedRunner& answer, const EmbeddedRunner* reference);

/// Whether displacements are large: those of a theory that is not linear. That of the model that answered, as the
/// scene's may be newer.
bool has_large_displacements(const EmbeddedRunner& answer);

/// Tractions on the surface that an answer is computed on [force / L^2].
struct AnswerTractions {
    Eigen::Matrix3Xd at_vertices;   ///< from the reactions; no columns when they are not known
    Eigen::Matrix3Xd on_triangles;  ///< of the given loads; no columns without loads
};
/// reactions: of answer.surface().
AnswerTractions answer_tractions(const EmbeddedRunner& answer, const ReactionRunner& reactions);

/// The fields of one answer. Refers to its arguments.
class AnswerFields {
public:
    /// reference: what differences are to; null when there is none.
    AnswerFields(const EmbeddedRunner& answer, const EmbeddedRunner* reference, const AnswerTractions& tractions)
        : answer_(answer), reference_(reference), tractions_(tractions) {}

    /// One value for each vertex of the surface that is simulated; empty where the field is not known there.
    Eigen::VectorXd simulated(Field field) const;
    /// One value a shown vertex; empty for no field, and where it is not known. A difference to what is not comparable
    /// is 0.
    std::vector<float> shown(Field field) const;
    /// At every shown vertex, 3 x n and 6 x n [force / L^2]. The tractions must be known.
    Eigen::MatrixXd shown_tractions() const { return carried(tractions_.at_vertices); }
    Eigen::MatrixXd shown_stresses() const;

private:
    Eigen::MatrixXd carried(const Eigen::MatrixXd& rows) const;

    const EmbeddedRunner& answer_;
    const EmbeddedRunner* reference_;
    const AnswerTractions& tractions_;
};

/// As graphics cards take them.
std::vector<float> as_floats(const Eigen::VectorXd& numbers);

}  // namespace elastolab
