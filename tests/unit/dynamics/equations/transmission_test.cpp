// SPDX-License-Identifier: BSD-3-Clause
// Tendons, gears and driven joints against closed forms.
#include "limber/dynamics/equations/transmission.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::transmission_test {
namespace {

using joints::ConstantSignal;
using joints::Drive;
using joints::DriveMode;
using joints::RampSignal;
using joints::ScalarSpring;
using joints::SpringCurve;
using testing::add_mass;
using testing::add_rail;
using testing::add_shaft;
using testing::Mass;
using testing::run_from;
using testing::RunOutcome;

constexpr double kTurn = 2.0 * std::numbers::pi;

Drive make_tension(double tension) {
  return Drive({.mode = DriveMode::effort,
                .signal = {.base = ConstantSignal{tension}},
                .pulls_only = true});
}

ScalarSpring make_spring(double stiffness, double damping, double rest) {
  return ScalarSpring(
      {.curve = SpringCurve({.stiffness = stiffness, .extensions = {}}),
       .damping = damping,
       .rest = rest});
}

TEST(Tendon, ThroughAMovingPulleyPullsItTwice) {
  // Ground, pulley, ground: the pulley carries twice the tension.
  SystemBuilder builder;
  const Mass pulley = add_mass(builder, "pulley", 4.0);
  add_rail(builder, pulley, "rail");
  const Vector3 start(-10.0, 0, 0);
  builder.add_path(
      "tendon",
      {builder.attach_world("a", {Matrix3::Identity(), start}), pulley.frame,
       builder.attach_world("b", {Matrix3::Identity(), start})},
      {make_tension(6.0)});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 1.0, .step = 1e-2, .output_times = {1.0}});
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), -0.5 * 12.0 / 4.0, 1e-9);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), -3.0, 1e-9);
  // The motor has put in tension times the length that it took up.
  EXPECT_NEAR(r.energies.back().work, 6.0 * 2.0 * 1.5, 1e-8);
}

TEST(Tendon, ThatIsStiffTiesTwoMassesOverAPost) {
  // Two masses on a rail, 1 kg pulled by 3 N, tied to 2 kg by an inextensible
  // line: both go at 1 m/s^2.
  SystemBuilder builder;
  const Mass front = add_mass(builder, "front", 1.0);
  const Mass back = add_mass(builder, "back", 2.0);
  add_rail(builder, front, "rail_front");
  add_rail(builder, back, "rail_back");
  builder.add_path("line", {back.frame, front.frame},
                   {make_spring(1e9, 0.0, 1.0)});
  builder.add_load("pull", front.frame, {3, 0, 0}, Vector3::Zero(),
                   LoadFrame::world, Constant{});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 1.0;
  const RunOutcome r = run_from(
      model, state, {.end_time = 2.0, .step = 1e-2, .output_times = {}});
  EXPECT_NEAR(r.state.bodies[1].p_WB.x(), 2.0, 1e-6);
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 3.0, 1e-6);
  // Newton's iterations do not increase with stiffness.
  EXPECT_LT(static_cast<double>(r.statistics.newton_iterations) /
                static_cast<double>(r.statistics.steps),
            4.0);
}

TEST(Tendon, WhosePointsMeetFailsWithItsName) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 1.0);
  builder.add_path("line", {builder.attach_world("hook", {}), mass.frame},
                   {make_spring(10.0, 0.0, 1.0)});
  const SystemModel model = builder.build();
  try {
    run_from(model, make_state(model),
             {.end_time = 1.0, .step = 1e-2, .output_times = {}});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("'line'"), std::string::npos);
  }
}

TEST(Tendon, OverOnePointIsRefused) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 1.0);
  EXPECT_THROW(builder.add_path("line", {mass.frame}, {}), InputError);
  EXPECT_THROW(builder.add_path("line", {mass.frame, mass.frame}, {}),
               InputError);
}

TEST(Gear, SharesAMomentByItsRatio) {
  // q_a = 3 q_b; moment T on a: (I + I / 9) q_a'' = T.
  SystemBuilder builder;
  const Mass a = add_mass(builder, "a", 1.0);
  const Mass b = add_mass(builder, "b", 1.0);
  const CouplerIndex shaft_a = add_shaft(builder, a, "shaft_a");
  const CouplerIndex shaft_b = add_shaft(builder, b, "shaft_b");
  builder.add_joint_sum("gear",
                        {.terms = {{shaft_a, 0, 1.0}, {shaft_b, 0, -3.0}}},
                        {make_spring(1e9, 0.0, 0.0)});
  builder.add_load("motor", a.frame, Vector3::Zero(), {0, 0, 5.0},
                   LoadFrame::world, Constant{});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 4.0, .step = 1e-2, .output_times = {4.0}});
  const double rate = 5.0 / (1.0 + 1.0 / 9.0) * 4.0;
  EXPECT_NEAR(r.state.bodies[0].w_WB_B.z(), rate, 1e-6);
  EXPECT_NEAR(r.state.bodies[1].w_WB_B.z(), rate / 3.0, 1e-6);
  // Several turns have gone by: the coupler has counted them.
  EXPECT_GT(r.state.memory[0].near[0], 5.0 * kTurn);
  EXPECT_NEAR(r.state.memory[0].near[0], 3.0 * r.state.memory[1].near[0], 1e-6);
  EXPECT_NEAR(r.energies.back().total(), r.energies.back().work, 1e-6);
}

TEST(DrivenHinge, GoesThroughAHundredTurnsWithoutAJump) {
  // A position drive along a ramp of 100 turns in 10 s, after which it holds.
  SystemBuilder builder;
  const Mass rotor = add_mass(builder, "rotor", 1.0);
  const Drive drive(
      {.mode = DriveMode::position,
       .signal = {.base = RampSignal{.to = 100.0 * kTurn,
                                     .duration = 10.0,
                                     .shape = joints::RampShape::smooth}},
       .stiffness = 1e4,
       .damping = 200.0});
  const CouplerIndex shaft = add_shaft(builder, rotor, "shaft", {{0, drive}});
  const SystemModel model = builder.build();
  std::vector<double> times;
  for (int i = 0; i <= 2200; ++i) times.push_back(5e-3 * i);
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 11.0, .step = 1e-3, .output_times = times});
  ASSERT_EQ(r.states.size(), times.size());
  double largest_step = 0.0;
  for (std::size_t i = 1; i < r.states.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return r.states[k].memory[static_cast<std::size_t>(shaft)].near[0];
    };
    largest_step = std::max(largest_step, std::abs(at(i) - at(i - 1)));
  }
  // The steepest slope of the ramp is 1.875 of its mean.
  EXPECT_LT(largest_step, 1.9 * 100.0 * kTurn / 10.0 * 5e-3);
  EXPECT_NEAR(r.state.memory[static_cast<std::size_t>(shaft)].near[0],
              100.0 * kTurn, 1e-9);
  EXPECT_NEAR(r.state.bodies[0].w_WB_B.z(), 0.0, 1e-9);
}

TEST(DrivenHinge, WindsATorsionSpringThroughManyTurns) {
  // A moment of 4 N m against 0.1 N m/rad: rest at 40 rad.
  SystemBuilder builder;
  const Mass rotor = add_mass(builder, "rotor", 1.0);
  add_shaft(builder, rotor, "shaft", {{0, make_spring(0.1, 0.5, 0.0)}});
  builder.add_load("motor", rotor.frame, Vector3::Zero(), {0, 0, 4.0},
                   LoadFrame::body, Constant{});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 200.0, .step = 2e-2, .output_times = {200.0}});
  EXPECT_NEAR(r.state.memory[0].near[0], 40.0, 1e-6);
  EXPECT_NEAR(r.energies.back().coupler, 0.5 * 0.1 * 1600.0, 1e-4);
}

TEST(DrivenSlider, OfAVelocityDriveApproachesItsSpeedExponentially) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "cart", 2.0);
  const Drive drive({.mode = DriveMode::velocity,
                     .signal = {.base = ConstantSignal{0.5}},
                     .damping = 8.0});
  add_rail(builder, mass, "rail", {{0, drive}});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 0.7, .step = 1e-4, .output_times = {0.7}});
  const double decay = std::exp(-4.0 * 0.7);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), 0.5 * (1.0 - decay), 1e-7);
  // Supplied: 8 (0.5 - v) 0.5 dt; dissipated: 8 (0.5 - v)^2 dt.
  EXPECT_NEAR(r.energies.back().work, 8.0 * 0.25 / 4.0 * (1.0 - decay), 1e-6);
  EXPECT_NEAR(r.energies.back().dissipated,
              8.0 * 0.25 / 8.0 * (1.0 - decay * decay), 1e-6);
}

TEST(Friction, StopsASliderWhereItsWorkEqualsTheMotion) {
  // m v^2 / 2 = Fc x: 2 kg at 1 m/s against 5 N stop after 0.2 m.
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "cart", 2.0);
  add_rail(builder, mass, "rail",
           {{0, joints::Friction({.coulomb = 5.0, .speed = 1e-3})}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 1.0;
  const RunOutcome r = run_from(
      model, state, {.end_time = 0.6, .step = 1e-4, .output_times = {0.6}});
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 0.2, 2e-5);
  EXPECT_LT(std::abs(r.state.bodies[0].v_WB_W.x()), 1e-6);
  EXPECT_NEAR(r.energies.back().dissipated, 1.0, 1e-4);
}

}  // namespace
}  // namespace limber::dynamics::transmission_test
