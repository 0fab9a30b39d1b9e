// SPDX-License-Identifier: BSD-3-Clause
#include "support/free_chain.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "support/chain.hpp"

namespace limber::testing {

FreeChain make_free_chain(double stiffness, double spin, double vibration) {
  Chain chain = make_chain({.bodies = 3,
                            .stiffness = stiffness,
                            .joint = joints::JointKind::revolute});
  FreeChain out{chain.builder.build(), chain.state};
  const Vector3 center = chain.state.bodies[1].p_WB;
  const Vector3 w = spin * Vector3(0.3, 1.0, 0.5).normalized();
  for (dynamics::BodyState& body : out.state.bodies) {
    body.w_WB_B = w;
    body.v_WB_W = w.cross(body.p_WB - center);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (double& rate : out.state.etadot) rate = vibration * uniform(random);
  double highest = 0.0;
  for (const dynamics::BodyModel& body : out.model.bodies) {
    highest = std::max(highest, std::sqrt(body.reduced->lambda.maxCoeff()));
  }
  out.shortest = 2.0 / highest;
  return out;
}

KeptDrift find_energy_conserving_drift(const FreeChain& chain, double h,
                                       long steps) {
  dynamics::SystemState state = chain.state;
  dynamics::EnergyConserving scheme(chain.model, {});
  const dynamics::EnergyBalance start = calc_energy(chain.model, state);
  double mass = 0.0;
  for (const dynamics::BodyModel& body : chain.model.bodies) mass += body.mass;
  KeptDrift drift;
  for (long i = 1; i <= steps; ++i) {
    scheme.step(state, h, static_cast<double>(i) * h);
    if (i % std::max(1L, steps / 100) != 0) continue;
    const dynamics::EnergyBalance now = calc_energy(chain.model, state);
    drift.energy =
        std::max(drift.energy, std::abs(now.total() / start.total() - 1.0));
    drift.linear =
        std::max(drift.linear,
                 (now.linear_momentum - start.linear_momentum).norm() / mass);
    drift.angular = std::max(
        drift.angular, (now.angular_momentum - start.angular_momentum).norm() /
                           start.angular_momentum.norm());
  }
  return drift;
}

}  // namespace limber::testing
