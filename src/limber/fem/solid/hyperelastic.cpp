// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

LameConstants<double> find_lame_constants(const ElasticMaterial& material) {
  const double nu = material.poisson_ratio;
  const double mu = material.youngs_modulus / (2.0 * (1.0 + nu));
  return {2.0 * mu * nu / (1.0 - 2.0 * nu), mu};
}

Vector6 to_components(const Matrix3& tensor) {
  Vector6 components;
  components << tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1),
      tensor(1, 2), tensor(0, 2);
  return components;
}

Matrix3 calc_stress_curvature(Elasticity law, const LameConstants<double>& lame,
                              const Matrix3& A, const Matrix3& B) {
  if (law == Elasticity::st_venant_kirchhoff) return Matrix3::Zero();
  const Matrix3 a = 0.5 * (A + A.transpose());
  const Matrix3 b = 0.5 * (B + B.transpose());
  return -4.0 * lame.mu * (a * b + b * a) -
         2.0 * lame.lambda *
             (a.cwiseProduct(b).sum() * Matrix3::Identity() + a.trace() * b +
              b.trace() * a);
}

}  // namespace limber::fem
