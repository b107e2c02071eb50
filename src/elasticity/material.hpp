#pragma once

namespace elastolab {

/// A linear-elastic, isotropic, homogeneous material.
/// young_modulus E > 0 [force / L^2];  poisson_ratio -1 < nu <= 1/2 (FEM: nu < 1/2). Checked where scenes are read.
struct Material {
    double young_modulus = 1.0e5;
    double poisson_ratio = 0.3;

    bool operator==(const Material&) const = default;
    /// mu = E / (2 (1 + nu)) [force / L^2]
    double shear_modulus() const { return young_modulus / (2.0 * (1.0 + poisson_ratio)); }
    /// lambda = E nu / ((1 + nu)(1 - 2 nu)) [force / L^2]; infinite at nu = 1/2
    double lame_lambda() const {
        return young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
    }
};

}  // namespace elastolab
