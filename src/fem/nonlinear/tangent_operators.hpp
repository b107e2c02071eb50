#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "deform/linear_operator.hpp"
#include "fem/nonlinear/newton.hpp"

namespace elastolab {

/// The true tangent at the free nodes, loads included, without its matrix.
class FreeTangentProduct : public LinearOperator {
public:
    FreeTangentProduct(const Newton& newton, const Eigen::VectorXd& u, const Eigen::VectorXd& factors, double shift,
                       ElementWork& work, Control& control)
        : newton_(newton),
          u_(u),
          factors_(factors),
          none_(newton.loads().none()),
          shift_(shift),
          work_(work),
          control_(control) {}
    Eigen::Index size() const override { return newton_.tangent().size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        control_.checkpoint();
        Eigen::MatrixXd all = newton_.tangent().all_rows(X);
        for (auto column : all.colwise())
            column = newton_.force_change(u_, factors_, Eigen::VectorXd(column), none_, work_, control_);
        return newton_.tangent().free_rows(all) + shift_ * X;
    }

private:
    const Newton& newton_;
    const Eigen::VectorXd &u_, &factors_;
    Eigen::VectorXd none_;
    double shift_;
    ElementWork& work_;
    Control& control_;
};

/// By a factor that is there.
class FactorSolve : public LinearOperator {
public:
    explicit FactorSolve(const SparseCholesky& factor) : factor_(factor) {}
    Eigen::Index size() const override { return factor_.size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override { return factor_.solve(X); }

private:
    const SparseCholesky& factor_;
};

}  // namespace elastolab
