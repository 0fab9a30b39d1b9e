// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/step_observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/bushing.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::step_observer_test {
namespace {

constexpr int kSteps = 201;

/// Masses of 1 and 2 kg on a spring, which a blow has set in motion.
struct StruckMasses {
  explicit StruckMasses(double stiffness) {
    SystemBuilder builder;
    const testing::Mass left = testing::add_mass(builder, "left", 1.0);
    const testing::Mass right = testing::add_mass(builder, "right", 2.0);
    builder.add_coupler("spring",
                        joints::Bushing({.translational_stiffness =
                                             stiffness * Matrix3::Identity()}),
                        left.frame, right.frame);
    model = builder.build();
    state = make_state(model);
    state.bodies[1].v_WB_W.x() = 1.0;
    settings.step = 0.2 / std::sqrt(1.5 * stiffness);
    settings.end_time = kSteps * settings.step;
    for (int i = 0; i <= kSteps; ++i) {
      settings.output_times.push_back(i * settings.step);
    }
  }
  SystemModel model;
  SystemState state;
  SimulationSettings settings;
};

// Against the energies of the states at the ends of all steps. Growth by less
// than 1 % is not evaluated exactly.
TEST(StepObserver, RecordsTheMostEnergyInCouplersOfARun) {
  for (const double stiffness : {1e2, 1e6, 1e10}) {
    for (const auto integrator :
         {IntegratorKind::generalized_alpha, IntegratorKind::implicit_euler}) {
      StruckMasses masses(stiffness);
      masses.settings.integrator = integrator;
      double most = 0.0;
      SimulationStatistics statistics;
      RunRecord record;
      simulate(
          masses.model, masses.state, masses.settings,
          [&](const SystemState& /*state*/, const EnergyBalance& now) {
            most = std::max(most, now.coupler);
          },
          {}, statistics, {}, {}, record);
      ASSERT_GT(most, 0.1);
      EXPECT_NEAR(record.energy.coupler.value, most, 0.0101 * most);
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::step_observer_test
