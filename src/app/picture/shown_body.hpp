#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/picture/answer_fields.hpp"
#include "app/picture/filling_shape.hpp"
#include "app/picture/reaction_runner.hpp"
#include "app/picture/section_runner.hpp"
#include "app/picture/section_shape.hpp"
#include "app/picture/shown_reactions.hpp"
#include "app/settings.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

/// The body cut open by a plane through its rest shape, deformed.
struct ShownSection {
    std::shared_ptr<const SectionShape> shape;
    Positions positions;        ///< of all vertices of the shape
    std::vector<float> values;  ///< of the chosen field, NaN inside where it is known on the surface only; or empty
};

/// What fills the holes of the body, deformed with it.
struct ShownFilling {
    std::shared_ptr<const FillingShape> shape;
    Positions positions;        ///< of its vertices
    std::vector<float> values;  ///< there, of the chosen field; empty where the body has none
};

/// A value of the field that is coloured, and where it is seen [L].
struct SeenValue {
    double value;
    Eigen::Vector3d place;
};

/// What is seen of one method's answer; made anew only when the answer or the settings have changed.
class ShownBody {
public:
    explicit ShownBody(MethodKind kind) : kind_(kind) {}

    /// What is shown of one method's answer, and what else that needs.
    struct Sources {
        const LiveScene& scene;
        const EmbeddedRunner& answer;
        std::shared_ptr<const FillingShape> filling = {};  ///< where the body is simulated with its holes filled
        const EmbeddedRunner* reference = nullptr;         ///< what differences are to; null when there is none
        const ReactionRunner* reactions = nullptr;         ///< null when nothing is shown that needs them
        std::shared_ptr<const SectionShape> section = {};  ///< when it is to be cut open; of the filling's closed(),
                                                           ///< where there is one
        const SectionRunner* inside = nullptr;             ///< what is known there; null when it is not cut open
        bool probed = false;                               ///< tractions and stresses of every vertex are asked for
    };
    /// Brings everything up to date. Returns whether positions or values changed.
    bool update(const Sources& sources, const DisplaySettings& display);

    MethodKind kind() const { return kind_; }
    std::uint64_t revision() const { return revision_; }       ///< grows with every change; different for every body
    const Positions& positions() const { return positions_; }  ///< rest + scale * displacement
    /// One value a vertex for the chosen field; empty when there is none, or when it is not known yet.
    const std::vector<float>& values() const { return values_; }
    /// The largest that is seen: where the body is cut away nothing is.
    double largest_magnitude() const { return largest_magnitude_; }
    /// The same of this part of the values that are seen, the smallest ones.
    double largest_magnitude(double part) const;
    /// The largest and the smallest of the finite values that are seen, on the cut too; nothing where none is.
    const std::optional<SeenValue>& largest_seen() const { return largest_seen_; }
    const std::optional<SeenValue>& smallest_seen() const { return smallest_seen_; }
    /// Whether a vertex of the surface is seen no more, as the body is cut away there.
    bool is_cut_away(int vertex) const;
    /// For every vertex, 3 x n and 6 x n [force / L^2]; without columns when not asked for, or not known yet.
    const Eigen::MatrixXd& tractions() const { return probed_tractions_; }
    const Eigen::MatrixXd& stresses() const { return probed_stresses_; }
    bool is_coloured() const { return !values_.empty(); }
    double max_displacement() const { return max_displacement_; }
    const std::optional<Difference>& difference() const { return difference_; }
    /// Those of shown_reactions(); none where they are not asked for, or not known yet.
    const std::vector<ShownReaction>& reactions() const { return reactions_; }
    const std::optional<ShownSection>& section() const { return section_; }
    /// Where the body is simulated with its holes filled.
    const std::optional<ShownFilling>& filling() const { return filling_; }
    double section_seconds() const { return section_seconds_; }  ///< that its last update took

private:
    /// Everything that positions, values and reactions are made from: equal keys, equal picture.
    struct Key {
        const SurfaceMesh* mesh = nullptr;
        std::uint64_t version = 0, reference_version = 0;
        const EmbeddedRunner *answer = nullptr, *reference = nullptr;
        std::shared_ptr<const FillingShape> filling;
        Field field = Field::none;
        double scale = 1.0;
        const ReactionRunner* reactions = nullptr;
        std::uint64_t reaction_revision = 0, scene_revision = 0;
        std::shared_ptr<const SectionShape> section;
        std::uint64_t inside_revision = 0;
        bool probed = false;
        bool operator==(const Key&) const = default;
    };
    static Key key_of(const Sources& sources, const DisplaySettings& display);
    void update_positions(const Sources& sources, double scale);
    void update_filling(const Sources& sources, double scale);
    void update_reactions(const Sources& sources);
    void update_section(const Sources& sources, const DisplaySettings& display);
    void colour_section(const SectionRunner* inside, Field field);
    void update_values(const Sources& sources, Field field);
    void colour_filling(const EmbeddedRunner& answer, const AnswerFields& fields, Field field);
    void update_seen();
    void update_probed(const Sources& sources);

    MethodKind kind_;
    Key key_;
    std::uint64_t revision_ = 0;
    Positions positions_;
    std::vector<float> values_;
    /// Of the values that are seen, in no order; and the last answer of largest_magnitude(part), with its part.
    mutable std::vector<float> seen_magnitudes_;
    mutable std::optional<std::pair<double, double>> largest_of_part_;
    double largest_magnitude_ = 0.0, max_displacement_ = 0.0;
    std::optional<SeenValue> largest_seen_, smallest_seen_;
    std::optional<Difference> difference_;
    std::vector<ShownReaction> reactions_;
    std::optional<ShownSection> section_;
    std::optional<ShownFilling> filling_;
    double section_seconds_ = 0.0;
    AnswerTractions tractions_;
    Eigen::MatrixXd probed_tractions_, probed_stresses_;
};

}  // namespace elastolab
