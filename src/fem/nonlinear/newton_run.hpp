#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "base/control.hpp"
#include "fem/nonlinear/newton.hpp"

namespace elastolab {

/// One run of Newton's method: where it is, and how it goes on. Parameters, units and errors: Newton::run.
class NewtonRun {
public:
    NewtonRun(const Newton& newton, Eigen::VectorXd u, const Eigen::VectorXd& factors, double tolerance,
              NewtonWork& work, Control& control, std::shared_ptr<const SparseCholesky> before);
    NewtonState run(int most_iterations, int most_steps, double most_stretch);

private:
    /// Where it is, and what is known there.
    struct Place {
        Eigen::VectorXd u, forces;
        BodyEnergy energy;
        double residual, size;
        bool stable;
    };
    Place place() const { return {state_.u, forces_, energy_, state_.residual, size_, state_.stable}; }
    void take(const Place& place);
    Eigen::VectorXd free_rows(const Eigen::VectorXd& all) const { return newton_.tangent().free_rows(all); }
    double progress() const;
    bool may_use_factor() const;
    /// Steps at the free nodes: by the factor there is, or nothing; by the one of this state, or nothing.
    std::optional<Eigen::VectorXd> near_step(const Eigen::VectorXd& gradient);
    std::optional<Eigen::VectorXd> own_step(const Eigen::VectorXd& gradient);
    /// A part of the step that inverts nothing and lowers the energy enough, 0 when there is none.
    double step_length(const Eigen::VectorXd& step, double slope, double gradient) const;
    /// Where the body leaves a state that is not stable, the energy falls on and on: so many times the step. rise: with
    /// it.
    double lengthened(const Eigen::VectorXd& step, double rise) const;
    /// False where no part of the step helps: nothing has changed.
    bool go(const Eigen::VectorXd& reduced, const Eigen::VectorXd& gradient);
    /// The whole step and a few more that put right what it strains; false where the energy is no lower then: it is
    /// where it was, without a factor if another one was made on the way. What a straight step of a bent bar stretches,
    /// the next one lets go.
    bool leap(const Eigen::VectorXd& step, double slope);
    /// False where an element would be inverted: nothing has changed.
    bool put(const Eigen::VectorXd& u);

    const Newton& newton_;
    double tolerance_, first_, size_;
    NewtonWork& work_;
    Control& control_;
    NewtonState state_;
    BodyEnergy energy_;
    Eigen::VectorXd forces_;
    bool stale_ = false;  ///< the factor is too far away by now
    double lift_ = 0.0;   ///< of the last factor that was lifted
    int leaps_from_ = 0;  ///< the iteration from which on a leap may be tried,
    int wait_ = 1;        ///< and how many are waited for it after one in vain
    int n_downhill_ = 0;  ///< the last steps that were only known to go downhill
};

}  // namespace elastolab
