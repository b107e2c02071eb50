#include "fem/free_border.hpp"

#include <utility>

#include "base/lapack.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

FreeBorder::FreeBorder(const Positions& positions, Eigen::MatrixXd R)
    : on_surface_(std::move(R)), motions_(positions.size(), on_surface_.cols()) {
    if (on_surface_.cols() == 0) return;
    const Eigen::MatrixXd all = rigid_modes(positions);
    motions_ = all * solve_minimum_norm(all.topRows(on_surface_.rows()), on_surface_).X;
    motions_.topRows(on_surface_.rows()) = on_surface_;
}

Eigen::MatrixXd FreeBorder::balance(Eigen::MatrixXd& forces) const {
    Eigen::MatrixXd lacking = motions_.transpose() * forces;
    forces.topRows(on_surface_.rows()).noalias() -= on_surface_ * lacking;
    return lacking;
}

void FreeBorder::remove_motion(Eigen::MatrixXd& displacements) const {
    const Eigen::MatrixXd motion = on_surface_.transpose() * displacements.topRows(on_surface_.rows());
    displacements.noalias() -= motions_.topRows(displacements.rows()) * motion;
}

Eigen::MatrixXd FreeBorder::compliance_columns(Eigen::MatrixXd forces, const Solve& solve) const {
    const Eigen::MatrixXd lacking = balance(forces);
    Eigen::MatrixXd u = solve(forces);
    remove_motion(u);
    Eigen::MatrixXd response(u.rows() + lacking.rows(), u.cols());
    response.topRows(u.rows()) = u;
    response.bottomRows(lacking.rows()) = lacking;
    return response;
}

ReducedSystem bordered_system(std::shared_ptr<const ComplianceColumns> compliance_columns,
                              const Eigen::MatrixXd& motions, std::vector<int> nodes) {
    ReducedSystem reduced;
    reduced.compliance_columns = std::move(compliance_columns);
    reduced.rigid = Eigen::MatrixXd::Zero(motions.rows() + motions.cols(), motions.cols());
    reduced.rigid.topRows(motions.rows()) = motions;
    reduced.n_loads = 3 * std::ssize(nodes);
    reduced.nodes = std::move(nodes);
    return reduced;
}

}  // namespace elastolab
