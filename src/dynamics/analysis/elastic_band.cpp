// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/elastic_band.hpp"

#include <algorithm>
#include <cmath>

#include "limber/dynamics/analysis/principal_basis.hpp"
#include "limber/dynamics/newton/force_balance.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
constexpr Index kMostCoordinates = 1500;
constexpr double kLeastStrain = 0.01;  // of a mode's potential energy
constexpr double kNarrowest = 2.0;     // high / low

/// Of the bodies' own modes; of none low > high.
struct OwnModes {
  double low = kInfinity;
  double high = 0.0;
  int bodies = 0;
};

OwnModes find_own_modes(const SystemModel& model) {
  OwnModes own;
  for (const BodyModel& body : model.bodies) {
    if (body.modes == 0) continue;
    ++own.bodies;
    for (const double lambda : flexbody::rest_stiffness(body.elasticity)) {
      if (!(lambda > 0.0)) continue;
      own.low = std::min(own.low, std::sqrt(lambda));
      own.high = std::max(own.high, std::sqrt(lambda));
    }
  }
  return own;
}

/// Twice the strain energy of each column of Q.
VectorX find_strain(const SmallMotion& motion, const MatrixX& Q) {
  VectorX strain = (motion.lambda.asDiagonal() * Q.cwiseAbs2()).colwise().sum();
  for (const SmallMotion::ModalBlock& block : motion.coupled) {
    const auto rows = Q.middleRows(block.first, block.K.rows());
    strain += (rows.cwiseProduct(block.K * rows)).colwise().sum().transpose();
  }
  return strain;
}

double find_lowest(const SystemModel& model, const SystemState& state,
                   const OwnModes& own) {
  const SmallMotion motion = find_small_motion(model, stop(state));
  const PrincipalBasis basis = find_principal_basis(model, motion);
  const VectorX strain = find_strain(motion, basis.Q);
  const VectorX S = motion.project_stiffness(basis.Q).diagonal();
  double lowest = own.low;
  for (Index i = basis.free; i < S.size(); ++i) {
    if (!(S[i] > 0.0) || strain[i] < kLeastStrain * S[i]) continue;
    lowest = std::min(lowest, std::sqrt(S[i]));
  }
  return lowest;
}

}  // namespace

std::optional<flexbody::FrequencyBand> find_elastic_band(
    const SystemModel& model, const SystemState& state) {
  constexpr double kBelow = 10.0;
  const OwnModes own = find_own_modes(model);
  if (!(own.high > 0.0)) return {};
  const Index coordinates = 6 * std::ssize(model.bodies) + model.modal_count;
  const double low = coordinates > kMostCoordinates
                         ? own.low / (kBelow * own.bodies)
                         : find_lowest(model, state, own);
  return flexbody::FrequencyBand{low, std::max(own.high, kNarrowest * low)};
}

}  // namespace limber::dynamics
