// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

LameConstants<double> find_lame_constants(const ElasticMaterial& material) {
  const double nu = material.poisson_ratio;
  const double mu = material.youngs_modulus / (2.0 * (1.0 + nu));
  return {2.0 * mu * nu / (1.0 - 2.0 * nu), mu};
}

}  // namespace limber::fem
