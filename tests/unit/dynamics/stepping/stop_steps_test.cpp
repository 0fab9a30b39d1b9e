// SPDX-License-Identifier: BSD-3-Clause
// Restitution of end stops whose contact is much shorter than a step.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sliding_masses.hpp"

namespace limber::dynamics::stop_steps_test {
namespace {

using joints::EndStop;
using testing::add_mass;
using testing::add_rail;
using testing::add_shaft;
using testing::Mass;
using testing::run_from;
using testing::RunOutcome;

constexpr double kSpeed = 1.0;  // [m/s]

EndStop make_stop(double restitution, double stiffness, double upper = 0.05) {
  return EndStop({.upper = upper,
                  .stiffness = stiffness,
                  .damping = joints::find_stop_damping(restitution, kSpeed)});
}

SimulationSettings make_settings(IntegratorKind integrator, double end) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.end_time = end;
  settings.step = 1e-3;
  settings.output_times = {0.0, end};
  return settings;
}

class AStop : public ::testing::TestWithParam<IntegratorKind> {};

TEST_P(AStop, GivesBackItsRestitutionInStepsLongerThanItsContact) {
  for (const double restitution : {0.1, 0.5, 0.9}) {
    for (const double stiffness : {1e5, 1e7, 1e9}) {
      SystemBuilder builder;
      const Mass mass = add_mass(builder, "body", 2.0);
      add_rail(builder, mass, "rail", {{0, make_stop(restitution, stiffness)}});
      const SystemModel model = builder.build();
      SystemState state = make_state(model);
      state.bodies[0].v_WB_W.x() = kSpeed;
      const RunOutcome r =
          run_from(model, state, make_settings(GetParam(), 0.08));
      EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), -restitution * kSpeed, 0.01)
          << restitution << ' ' << stiffness;
    }
  }
}

TEST_P(AStop, GivesBackItsRestitutionToBothOfTwoFreeBodies) {
  SystemBuilder builder;
  const Mass left = add_mass(builder, "left", 2.0);
  const Mass right = add_mass(builder, "right", 3.0);
  builder.add_coupler(
      "slide",
      joints::make_joint(
          joints::JointKind::prismatic, Vector3::UnitX(), Vector3::UnitY(),
          {.translational_stiffness = 1e7, .rotational_stiffness = 1e7},
          {{0, make_stop(0.3, 1e8)}}),
      left.frame, right.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].v_WB_W.x() = kSpeed;
  const RunOutcome r = run_from(model, state, make_settings(GetParam(), 0.08));
  const double after =
      r.state.bodies[1].v_WB_W.x() - r.state.bodies[0].v_WB_W.x();
  EXPECT_NEAR(after, -0.3 * kSpeed, 0.01);
  EXPECT_NEAR(
      2.0 * r.state.bodies[0].v_WB_W.x() + 3.0 * r.state.bodies[1].v_WB_W.x(),
      3.0 * kSpeed, 1e-9);
}

TEST_P(AStop, OfAShaftGivesBackItsRestitution) {
  SystemBuilder builder;
  const Mass wheel = add_mass(builder, "wheel", 2.0);
  add_shaft(builder, wheel, "shaft", {{0, make_stop(0.4, 1e8)}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B.z() = kSpeed;
  const RunOutcome r = run_from(model, state, make_settings(GetParam(), 0.08));
  EXPECT_NEAR(r.state.bodies[0].w_WB_B.z(), -0.4 * kSpeed, 0.01);
}

// A body with 1 mm of play between two stops, which it crosses within a step.
TEST_P(AStop, AndAnotherGiveBackTheirRestitutionToABodyBetweenThem) {
  const auto rattle = [](double step) {
    SystemBuilder builder;
    const Mass mass = add_mass(builder, "body", 2.0);
    add_rail(
        builder, mass, "rail",
        {{0, EndStop({.lower = -5e-4,
                      .upper = 5e-4,
                      .stiffness = 1e7,
                      .damping = joints::find_stop_damping(0.7, kSpeed)})}});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W.x() = kSpeed;
    SimulationSettings settings = make_settings(GetParam(), 0.0123);
    settings.step = step;
    return run_from(model, state, settings).state.bodies[0].v_WB_W.x();
  };
  EXPECT_NEAR(rattle(0.01), rattle(1e-6), 0.01);
}

// Two shafts in gear that reach their stops together, at the end of a step.
TEST_P(AStop, OfEachOfTwoGearedShaftsGivesBackItsRestitution) {
  SystemBuilder builder;
  std::vector<CouplerIndex> shafts;
  for (const char* name : {"left", "right"}) {
    const Mass wheel = add_mass(builder, name, 2.0);
    shafts.push_back(add_shaft(builder, wheel, std::string(name) + " shaft",
                               {{0, make_stop(0.5, 1e7)}}));
  }
  builder.add_joint_sum(
      "gear", JointSum{{{shafts[0], 0, 1.0}, {shafts[1], 0, -1.0}}, 0.0},
      {joints::ScalarSpring(
          {.curve = joints::SpringCurve({.stiffness = 1e5})})});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  for (BodyState& body : state.bodies) body.w_WB_B.z() = kSpeed;
  const RunOutcome r = run_from(model, state, make_settings(GetParam(), 0.08));
  for (const BodyState& body : r.state.bodies) {
    EXPECT_NEAR(body.w_WB_B.z(), -0.5 * kSpeed, 0.01);
  }
}

TEST(AStopOfARun, GivesBackItsRestitutionInStepsToATolerance) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "body", 2.0);
  add_rail(builder, mass, "rail", {{0, make_stop(0.1, 1e8)}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = kSpeed;
  SimulationSettings settings =
      make_settings(IntegratorKind::generalized_alpha, 0.08);
  settings.tolerance = 1e-4;  // many times the depth
  const RunOutcome r = run_from(model, state, settings);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), -0.1 * kSpeed, 0.01);
}

TEST_P(AStop, TakesFewStepsForABodyThatComesToRestOnIt) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "body", 2.0);
  add_rail(builder, mass, "rail", {{0, make_stop(0.3, 1e7, 0.02)}});
  builder.set_gravity({9.81, 0.0, 0.0});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model), make_settings(GetParam(), 1.0));
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 0.02, 1e-3);
  EXPECT_LT(r.statistics.steps, 6000);
}

INSTANTIATE_TEST_SUITE_P(OfSecondOrder, AStop,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::energy_conserving),
                         [](const auto& param) {
                           std::string name = to_string(param.param);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace limber::dynamics::stop_steps_test
