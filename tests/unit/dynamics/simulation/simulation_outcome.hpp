// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::test {

/// What a simulation left at its end, and at its output times.
struct Outcome {
  SystemState state;
  std::vector<EnergyBalance> energies;
  std::vector<SystemState> states;
  SimulationStatistics statistics;
};

inline Outcome run(const SystemModel& model, SystemState state,
                   const SimulationSettings& settings) {
  Outcome r;
  r.statistics = simulate(model, state, settings,
                          [&](const SystemState& s, const EnergyBalance& e) {
                            r.states.push_back(s);
                            r.energies.push_back(e);
                          });
  r.state = state;
  return r;
}

/// `count` equal intervals from 0 to `end` [s].
inline std::vector<double> sample(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

/// Sets random speeds of bodies [m/s], [rad/s] and of modes [kg^1/2 m/s], of
/// the given largest values.
inline void stir(SystemState& state, double speed, double spin, double modal) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (BodyState& b : state.bodies) {
    for (int a = 0; a < 3; ++a) {
      b.v_WB_W[a] = speed * uniform(random);
      b.w_WB_B[a] = spin * uniform(random);
    }
  }
  for (double& x : state.etadot) x = modal * uniform(random);
}

inline SystemModel rigid_body(const Matrix3& inertia, double mass = 2.0) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {mass, inertia});
  return builder.build();
}

}  // namespace limber::dynamics::test
