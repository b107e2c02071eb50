#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "deform/deformer.hpp"

namespace elastolab {

/// Displacements for values that change little by little, as they do while a person drags: as long as they differ from
/// those at the start by an affine motion of one handle, or by the sizes of loads, a frame costs one pass over the
/// columns of that motion (three for a translation) or those loads (one each). Any other change starts anew. No answer
/// depends on the way to it, but for rounding.
///
/// Of a method that is not linear, prepare() finds an equilibrium, and the columns are those of the tangent there: what
/// displace() gives for other values is right to second order in the change, and is not to be asked for without has().
class DragSolver {
public:
    /// handle_ends[i]: where the vertices of handle i, which may have none on a proxy, end in the list of all handles'
    /// vertices (deformer->set()).
    DragSolver(std::shared_ptr<const Deformer> deformer, std::vector<int> handle_ends);

    /// Solves ahead for these values, and for further motion of the kind that led to them from the start (translations
    /// or affine motions of one handle, loads); if that was not of one handle, for translations of the last one, and
    /// affine motions where the method is not linear. displace() then needs no solve for these. tolerance: relative
    /// residual, where the method iterates (Deformer::iterates). approach: for methods that are not linear. Throws
    /// SolveError, Cancelled; what was at hand then stays.
    void prepare(const Eigen::VectorXd& values, double tolerance, Control& control, const Approach& approach = {});
    /// Solves anew for what is at hand, from there, to kSolveTolerance. Throws SolveError, Cancelled.
    void converge(Control& control);
    /// Of what is at hand.
    double tolerance() const { return tolerance_; }
    /// Whether displace(values) needs no solve but one pass over the columns at hand.
    bool has(const Eigen::VectorXd& values) const;
    /// Whether that is as exact as tolerance() says: always, of a linear method; of others only at the equilibrium.
    bool is_exact(const Eigen::VectorXd& values) const;
    /// The equilibrium at hand; null before the first and for linear methods.
    const std::shared_ptr<const Equilibrium>& equilibrium() const { return response_.equilibrium; }
    /// Displacements where the columns at hand begin.
    const Eigen::VectorXd& at_start() const { return response_.rest; }

    /// u <- the displacements for `values` (as Deformer::displace takes them); what is not at hand is solved for to
    /// kSolveTolerance. Throws SolveError.
    void displace(const Eigen::VectorXd& values, Eigen::VectorXd& u);

private:
    static constexpr int kNone = -1, kSeveral = -2;

    bool has_start(const Eigen::VectorXd& values) const;
    int changed_handle(const Eigen::VectorXd& change) const;
    /// With vertices; negative: there is none.
    int last_handle() const;
    Eigen::Matrix3Xd part_of(int handle, const Eigen::VectorXd& change) const;
    /// The number that changed_handle() has for the loads, which stand behind the handles.
    int loads() const { return static_cast<int>(handle_ends_.size()); }
    Eigen::Index n_loads() const { return std::ssize(deformer_->set().loads); }
    void grab_loads(const Eigen::VectorXd& values, double tolerance, Control& control, const Approach& approach = {});
    int begin_of(int handle) const { return handle == 0 ? 0 : handle_ends_[static_cast<std::size_t>(handle) - 1]; }
    int size_of(int handle) const { return handle_ends_[static_cast<std::size_t>(handle)] - begin_of(handle); }
    void start(const Eigen::VectorXd& values, double tolerance, Control& control, const Approach& approach = {});
    void grab(const Eigen::VectorXd& values, int handle, bool affine, double tolerance, Control& control,
              const Approach& approach = {});
    double tolerance_of(int handle, const Eigen::Matrix3Xd& change) const;
    std::optional<Eigen::VectorXd> parameters_of(int handle, const Eigen::Matrix3Xd& change) const;

    std::shared_ptr<const Deformer> deformer_;
    std::vector<int> handle_ends_;
    Eigen::VectorXd start_values_;
    double tolerance_ = kSolveTolerance;
    int handle_ = kNone;      ///< whose columns response_ holds; loads(): those of the loads
    Eigen::MatrixXd shapes_;  ///< 1 or 4 x vertices of the handle: 1, and the scaled rest position about its mean
    Eigen::MatrixXd fit_;     ///< vertices x 1 or 4, pseudo-inverse of shapes_
    DragResponse response_;   ///< rest: for start_values_; one column for each shape and axis
};

}  // namespace elastolab
