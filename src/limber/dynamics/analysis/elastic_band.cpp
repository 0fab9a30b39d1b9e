// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/elastic_band.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/group_motion.hpp"
#include "limber/dynamics/analysis/principal_basis.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

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

OwnModes find_own_modes(const SystemModel& model,
                        const std::vector<BodyIndex>& group) {
  OwnModes own;
  for (const BodyIndex b : group) {
    const BodyModel& body = model.bodies[index(b)];
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

Index count_coordinates(const SystemModel& model,
                        const std::vector<BodyIndex>& group) {
  Index count = 6 * std::ssize(group);
  for (const BodyIndex b : group) count += model.bodies[index(b)].modes;
  return count;
}

double find_lowest(const SystemModel& model, const SmallMotion& motion,
                   const OwnModes& own) {
  const PrincipalBasis basis = find_principal_basis(model, motion);
  const MatrixX held = basis.Q.rightCols(basis.squares.size());
  const VectorX strain = motion.project_strain(held);
  const VectorX S = motion.project_squares(held);
  double lowest = own.low;
  for (Index i = 0; i < S.size(); ++i) {
    if (!(S[i] > 0.0) || strain[i] < kLeastStrain * S[i]) continue;
    lowest = std::min(lowest, std::sqrt(S[i]));
  }
  return lowest;
}

}  // namespace

std::vector<std::optional<flexbody::FrequencyBand>> find_elastic_bands(
    const SystemModel& model, const SystemState& state) {
  constexpr double kBelow = 10.0;
  std::vector<std::optional<flexbody::FrequencyBand>> bands(
      model.bodies.size());
  std::optional<SmallMotion> motion;
  for (const auto& group : find_linked_groups(model)) {
    const OwnModes own = find_own_modes(model, group);
    if (!(own.high > 0.0)) continue;
    double low = own.low / (kBelow * own.bodies);
    if (count_coordinates(model, group) <= kMostCoordinates) {
      if (!motion) motion = find_small_motion(model, stop(state));
      low = find_lowest(model, take_group(model, *motion, group).motion, own);
    }
    const flexbody::FrequencyBand band{low,
                                       std::max(own.high, kNarrowest * low)};
    for (const BodyIndex b : group) bands[index(b)] = band;
  }
  return bands;
}

}  // namespace limber::dynamics
