// SPDX-License-Identifier: BSD-3-Clause
// Full turns of joints in steps that rotate them by more than half a turn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::turn_counter_test {
namespace {

using testing::add_mass;
using testing::add_shaft;
using ::testing::HasSubstr;
using testing::Mass;
using testing::run_from;
using testing::RunOutcome;

constexpr double kStep = 0.01;  // [s]

// A wheel of 1 kg m^2 that spins about its shaft from the start on.
class SpinningWheel : public ::testing::TestWithParam<IntegratorKind> {
 protected:
  static RunOutcome spin(IntegratorKind integrator, double rate, double end,
                         std::vector<joints::JointElement> elements = {}) {
    SystemBuilder builder;
    const Mass wheel = add_mass(builder, "wheel", 1.0);
    add_shaft(builder, wheel, "shaft", std::move(elements));
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B.z() = rate;
    SimulationSettings settings;
    settings.integrator = integrator;
    settings.end_time = end;
    settings.step = kStep;
    settings.output_times = {0.0, end};
    return run_from(model, state, settings);
  }
};

TEST_P(SpinningWheel, CountsItsTurnsAtAnyRate) {
  // 0.5 to 10 rad a step, also a whole turn and half a one.
  for (const double rate : {50.0, 100.0 * std::numbers::pi, 400.0,
                            200.0 * std::numbers::pi, 1000.0, -400.0}) {
    const RunOutcome r = spin(GetParam(), rate, 0.2);
    EXPECT_NEAR(r.state.memory[0].near[0], 0.2 * rate, 1e-6 * std::abs(rate))
        << rate;
  }
}

// Its rotation of a step is a Cayley transform, which stays below half a turn.
TEST_F(SpinningWheel, UnderEnergyConservingHasTheAngleOfItsSteps) {
  for (const double rate : {50.0, 400.0, 200.0 * std::numbers::pi}) {
    const RunOutcome r = spin(IntegratorKind::energy_conserving, rate, 0.2);
    EXPECT_NEAR(r.state.memory[0].near[0],
                20.0 * 2.0 * std::atan(0.5 * rate * kStep), 1e-6 * rate)
        << rate;
  }
}

TEST_F(SpinningWheel, TakesShorterStepsWhereASpringNeedsTheTurns) {
  const double k = 400.0;  // [N m/rad]
  const RunOutcome r =
      spin(IntegratorKind::generalized_alpha, 400.0, 0.03,
           {{0, joints::ScalarSpring(
                    {.curve = joints::SpringCurve({.stiffness = k})})}});
  EXPECT_GT(r.statistics.halved_steps, 0);
  const double omega = std::sqrt(k);
  EXPECT_NEAR(r.state.memory[0].near[0], 400.0 / omega * std::sin(omega * 0.03),
              0.01);
}

INSTANTIATE_TEST_SUITE_P(All, SpinningWheel,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::implicit_euler,
                                           IntegratorKind::runge_kutta_4),
                         [](const auto& param) {
                           std::string name = to_string(param.param);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace limber::dynamics::turn_counter_test
