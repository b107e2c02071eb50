#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/picture/section_shape.hpp"
#include "deform/deformer.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/embedded_runner.hpp"

namespace elastolab {

/// What is inside a body that is cut open, for one method's answer: evaluated on a worker, a share of the points at a
/// time, for the present motion and for further motions of the handle pulled last, so that a frame of its drag is a sum
/// over a few columns. Owned by one thread.
class SectionRunner {
public:
    /// `wake` is called by the worker when update() will find something.
    explicit SectionRunner(std::function<void()> wake) : job_(std::move(wake)) {}

    /// Takes over what the worker finished and begins what is due. Once per frame while the body is cut open.
    void update(const EmbeddedRunner& answer, const std::shared_ptr<const SectionShape>& shape);
    /// The body is closed again.
    void rest();

    /// Whether there are values for some of the points at least; those of the others are filled in.
    bool ready() const { return latest_ != nullptr; }
    Eigen::Matrix3Xd displacements() const;         ///< 3 x n_inside [L]; ready
    Eigen::Matrix<double, 6, -1> stresses() const;  ///< 6 x n_inside, in the order of InteriorValues; ready
    /// Grows whenever these change.
    std::uint64_t revision() const { return revision_; }
    /// Why there are none, for the user; empty when there are or will be.
    const std::string& failure() const { return failure_; }

    /// What it costs.
    struct Cost {
        Eigen::Index points = 0, evaluated = 0;
        double worker_seconds = 0.0;  ///< for the points so far
    };
    Cost cost() const;
    bool running() const { return job_.running(); }
    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    /// Motions of the handles as columns, and the coefficients of a motion.
    struct Basis {
        Eigen::MatrixXd columns, inverse;  ///< 3*n_handles x m and m x 3*n_handles
        bool linear = true;                ///< false: one column, the motion itself, and no other is known from it
    };
    /// Values at the points of a shape for the m columns of a basis.
    struct Columns {
        std::shared_ptr<const SectionShape> shape;
        std::shared_ptr<const Deformer> deformer;
        std::shared_ptr<const Basis> basis;
        std::shared_ptr<const InteriorField> field;  ///< null: not made yet
        Eigen::MatrixXd displacements, stresses;     ///< 3m and 6m x n_inside; those not known yet are filled in
        std::vector<char> known;
        Eigen::Index n_known = 0;
        double seconds = 0.0;
    };
    static std::shared_ptr<const Basis> make_basis(const EmbeddedRunner& answer, std::size_t group);
    static std::shared_ptr<const Columns> evaluate(Columns columns, Control& control);
    static bool spans(const Basis& basis, const Eigen::VectorXd& values);
    std::size_t pulled_group(const EmbeddedRunner& answer) const;
    void poll();

    std::shared_ptr<const Columns> latest_;
    // Of the last values, for another cut of the same solutions.
    std::shared_ptr<const InteriorField> kept_field_;
    std::shared_ptr<const Basis> kept_basis_;
    std::weak_ptr<const Deformer> kept_deformer_;
    std::weak_ptr<const Deformer> deformer_;   ///< that the worker was asked for last
    std::weak_ptr<const SectionShape> shape_;  ///< likewise
    Eigen::VectorXd asked_, shown_;            ///< values that were asked for, and those shown
    Eigen::VectorXd coefficients_;
    std::string failure_;
    std::uint64_t revision_ = 0;
    BackgroundJob<std::shared_ptr<const Columns>> job_;
};

}  // namespace elastolab
