// SPDX-License-Identifier: BSD-3-Clause
// Sampled controllers against closed forms: of sampled-data systems, of the
// continuous loop that fast samples approach, and of loads and drives that are
// known before.
#include "limber/dynamics/system/controller.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::controller_test {
namespace {

using testing::add_mass;
using testing::add_rail;
using testing::add_shaft;
using testing::Mass;

constexpr double kMass = 2.0;  // [kg]

std::shared_ptr<const Controller> make_law(
    FunctionController::Function function) {
  return std::make_shared<FunctionController>("test", std::move(function));
}

Measurement measure_x() {
  return {"x", "p_WB.x", [](const SystemModel&, const SystemState& state) {
            return state.bodies[0].p_WB.x();
          }};
}

Measurement measure_v() {
  return {"v", "v_WB.x", [](const SystemModel&, const SystemState& state) {
            return state.bodies[0].v_WB_W.x();
          }};
}

/// u = kx x + kv v.
std::shared_ptr<const Controller> make_feedback(double kx, double kv) {
  return make_law([kx, kv](const ControllerView& view, std::span<double>,
                           std::span<double> written) {
    written[0] = kx * view.measured[0] + kv * view.measured[1];
  });
}

/// A function of the sample's number alone.
std::shared_ptr<const Controller> make_script(
    const std::function<double(long)>& function) {
  return make_law([function](const ControllerView& view, std::span<double>,
                             std::span<double> written) {
    written[0] = function(view.sample);
  });
}

/// A mass that is free in space, pushed along x by input 0 [N].
SystemBuilder make_pushed_mass(double initial, InputHold hold) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "mass", kMass);
  const InputIndex push = builder.add_input("push", initial, hold);
  builder.add_load("push", mass.frame, Vector3::UnitX(), Vector3::Zero(),
                   LoadFrame::world, InputFunction{push, 1.0});
  return builder;
}

/// And held by a spring along x: omega = 10 rad/s.
SystemBuilder make_pushed_oscillator(const TimeFunction& function,
                                     InputHold hold) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "mass", kMass);
  joints::Bushing::Parameters spring;
  spring.translational_stiffness = 200.0 * Matrix3::Identity();
  builder.add_coupler("spring", joints::Bushing(spring),
                      builder.attach_world("wall", {}), mass.frame);
  builder.add_input("push", 0.0, hold);
  builder.add_load("push", mass.frame, 50.0 * Vector3::UnitX(), Vector3::Zero(),
                   LoadFrame::world, function);
  return builder;
}

SystemState run(const SystemModel& model, const SystemState& start,
                SimulationSettings settings) {
  SystemState state = start;
  simulate(model, state, settings, {});
  return state;
}

class ControlledByAllSchemes : public ::testing::TestWithParam<IntegratorKind> {
};

/// All but implicit Euler, which does not move a mass along a parabola.
class ControlledExactly : public ::testing::TestWithParam<IntegratorKind> {};

TEST_P(ControlledExactly, DeadbeatStopsAFreeMassInTwoSamples) {
  constexpr double T = 0.125;
  SystemBuilder builder = make_pushed_mass(0.0, InputHold::held);
  const ControllerIndex deadbeat = builder.add_controller(
      {.name = "deadbeat",
       .period = T,
       .writes = {0},
       .measures = {measure_x(), measure_v()},
       .law = make_feedback(-kMass / (T * T), -1.5 * kMass / T)});
  EXPECT_EQ(deadbeat, ControllerIndex(0));
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 0.3;
  state.bodies[0].v_WB_W.x() = -1.7;
  SimulationSettings settings{.integrator = GetParam(),
                              .end_time = 4.0 * T,
                              .step = T / 5.0,
                              .newton_tolerance = 1e-14};
  settings.output_times = {2.0 * T, 3.0 * T, 4.0 * T};
  double largest = 0.0;
  simulate(model, state, settings,
           [&](const SystemState& now, const EnergyBalance& /*energy*/) {
             largest = std::max({largest, std::abs(now.bodies[0].p_WB.x()),
                                 std::abs(now.bodies[0].v_WB_W.x())});
           });
  // The first force is 100 N: round-off of what it does, times the gain.
  EXPECT_LT(largest, 1e-12);
}

// z-transform: of held samples, the mass is a discrete double integrator.
TEST_P(ControlledExactly, AFreeMassIsTheSampledDataSystemExactly) {
  constexpr double T = 0.1;
  constexpr double kx = -30.0;
  constexpr double kv = -12.0;
  SystemBuilder builder = make_pushed_mass(0.0, InputHold::held);
  builder.add_controller({.name = "feedback",
                          .period = T,
                          .offset = 0.25,
                          .writes = {0},
                          .measures = {measure_x(), measure_v()},
                          .law = make_feedback(kx, kv)});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 1.0;
  state.bodies[0].v_WB_W.x() = 0.5;
  const SystemState end = run(model, state,
                              {.integrator = GetParam(),
                               .end_time = 0.25 + 60.5 * T,
                               .step = T / 3.0,
                               .newton_tolerance = 1e-14});
  double x = 1.0 + 0.5 * 0.25;
  double v = 0.5;
  const auto advance = [&](double h) {
    const double a = (kx * x + kv * v) / kMass;
    return std::array{x + h * v + 0.5 * h * h * a, v + h * a};
  };
  for (int k = 0; k < 60; ++k) {
    const auto [next_x, next_v] = advance(T);
    x = next_x;
    v = next_v;
  }
  const auto [last_x, last_v] = advance(0.5 * T);
  EXPECT_NEAR(end.bodies[0].p_WB.x(), last_x, 2e-13);
  EXPECT_NEAR(end.bodies[0].v_WB_W.x(), last_v, 2e-13);
  EXPECT_EQ(end.controllers[0].next, 61);
}

// x'' + w^2 x = u / m in closed form, from sample to sample.
TEST_P(ControlledByAllSchemes, KeepItsOrderWhereAnInputJumps) {
  constexpr double T = 0.05;
  constexpr double w = 10.0;
  const auto script = [](long k) { return std::cos(2.3 * double(k)); };
  SystemBuilder builder =
      make_pushed_oscillator(InputFunction{0, 1.0}, InputHold::held);
  builder.add_controller({.name = "script",
                          .period = T,
                          .writes = {0},
                          .law = make_script(script)});
  const SystemModel model = builder.build();
  double x = 0.02;
  double v = 0.0;
  for (long k = 0; k < 20; ++k) {
    const double rest = 50.0 * script(k) / 200.0;
    const double from = x - rest;
    x = rest + from * std::cos(w * T) + v / w * std::sin(w * T);
    v = -from * w * std::sin(w * T) + v * std::cos(w * T);
  }
  SystemState start = make_state(model);
  start.bodies[0].p_WB.x() = 0.02;
  const int order = traits_of(GetParam()).order;
  const double h = order > 2 ? T / 2.0 : order == 2 ? T / 8.0 : T / 128.0;
  std::array<double, 3> errors;
  for (int i = 0; i < 3; ++i) {
    const SystemState end = run(model, start,
                                {.integrator = GetParam(),
                                 .end_time = 20.0 * T,
                                 .step = h / (1 << i),
                                 .rho_inf = 0.8,
                                 .newton_tolerance = 1e-14});
    errors[std::size_t(i)] = std::hypot(end.bodies[0].p_WB.x() - x,
                                        (end.bodies[0].v_WB_W.x() - v) / w);
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), order - 0.15);
  EXPECT_GT(std::log2(errors[1] / errors[2]), order - 0.15);
  EXPECT_LT(errors[0], 0.05);
}

// Known before, the same loads are other functions of time.
TEST_P(ControlledByAllSchemes, HeldInputsAreStepSequencesToTheBit) {
  constexpr double T = 0.05;
  const std::vector<double> values = {0.3, -1.0, -1.0, 0.7, 2.0, 0.0};
  SystemBuilder builder =
      make_pushed_oscillator(InputFunction{0, 1.0}, InputHold::held);
  builder.add_controller(
      {.name = "script",
       .period = T,
       .writes = {0},
       .law = make_script([&](long k) { return values[std::size_t(k)]; })});
  StepSequence steps;
  for (std::size_t k = 0; k < values.size(); ++k) {
    steps.times.push_back(double(k) * T);
    steps.values.push_back(values[k]);
  }
  const SystemModel with_input = builder.build();
  const SystemModel with_steps =
      make_pushed_oscillator(steps, InputHold::held).build();
  const SimulationSettings settings{
      .integrator = GetParam(), .end_time = 5.5 * T, .step = T / 16.0};
  const SystemState a = run(with_input, make_state(with_input), settings);
  const SystemState b = run(with_steps, make_state(with_steps), settings);
  EXPECT_NEAR(a.bodies[0].p_WB.x(), b.bodies[0].p_WB.x(), 1e-15);
  EXPECT_NEAR(a.bodies[0].v_WB_W.x(), b.bodies[0].v_WB_W.x(), 1e-14);
  EXPECT_GT(std::abs(a.bodies[0].p_WB.x()), 0.01);
}

TEST_P(ControlledByAllSchemes, LinearInputsAreTablesAPeriodLater) {
  constexpr double T = 0.05;
  const std::vector<double> values = {0.3, -1.0, -1.0, 0.7, 2.0, 0.0};
  SystemBuilder builder =
      make_pushed_oscillator(InputFunction{0, 1.0}, InputHold::linear);
  builder.add_controller(
      {.name = "script",
       .period = T,
       .writes = {0},
       .law = make_script([&](long k) { return values[std::size_t(k)]; })});
  Table table{{0.0}, {0.0}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    table.times.push_back(double(k + 1) * T);
    table.values.push_back(values[k]);
  }
  const SystemModel with_input = builder.build();
  const SystemModel with_table =
      make_pushed_oscillator(table, InputHold::held).build();
  const SimulationSettings settings{
      .integrator = GetParam(), .end_time = 5.5 * T, .step = T / 16.0};
  const SystemState a = run(with_input, make_state(with_input), settings);
  const SystemState b = run(with_table, make_state(with_table), settings);
  EXPECT_NEAR(a.bodies[0].p_WB.x(), b.bodies[0].p_WB.x(), 1e-12);
  EXPECT_NEAR(a.bodies[0].v_WB_W.x(), b.bodies[0].v_WB_W.x(), 1e-11);
  EXPECT_GT(std::abs(a.bodies[0].p_WB.x()), 0.01);
}

std::string name_of(const ::testing::TestParamInfo<IntegratorKind>& test) {
  std::string name = to_string(test.param);
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ControlledByAllSchemes,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::runge_kutta_4,
                                           IntegratorKind::explicit_euler,
                                           IntegratorKind::central_differences,
                                           IntegratorKind::implicit_euler,
                                           IntegratorKind::energy_conserving,
                                           IntegratorKind::splitting),
                         name_of);
INSTANTIATE_TEST_SUITE_P(AllButImplicitEuler, ControlledExactly,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::runge_kutta_4,
                                           IntegratorKind::explicit_euler,
                                           IntegratorKind::central_differences,
                                           IntegratorKind::energy_conserving,
                                           IntegratorKind::splitting),
                         name_of);

/// A rotor on a shaft along z, whose drive's effort follows input 0 [N m].
struct Rotor {
  SystemModel model;
  double inertia;  ///< [kg m^2]
};

Measurement measure_angle(CouplerIndex shaft) {
  return {"angle", "coordinate of the shaft",
          [shaft](const SystemModel& model, const SystemState& state) {
            return evaluate_coordinate(model, state, shaft, 0).motion.z;
          }};
}

Measurement measure_rate(CouplerIndex shaft) {
  return {"rate", "rate of the shaft",
          [shaft](const SystemModel& model, const SystemState& state) {
            return evaluate_coordinate(model, state, shaft, 0).motion.rate;
          }};
}

Rotor make_rotor(double period, double k, double c, InputHold hold) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "rotor", kMass);
  const InputIndex effort = builder.add_input("effort", 0.0, hold);
  const CouplerIndex shaft = add_shaft(
      builder, mass, "shaft",
      {{0, joints::Drive({.mode = joints::DriveMode::effort,
                          .signal = {joints::InputSignal{effort, 1.0}}})}});
  builder.add_controller(
      {.name = "pd",
       .period = period,
       .writes = {effort},
       .measures = {measure_angle(shaft), measure_rate(shaft)},
       .law = make_feedback(-k, -c)});
  const SystemModel model = builder.build();
  return {model, model.bodies[0].J0(2, 2)};
}

// J a'' = -k a - c a' with w = 8 rad/s, zeta = 0.3.
TEST(PdControlledRotor, ApproachesTheContinuousLoopWithTheOrderOfItsHold) {
  const double J = make_rotor(0.1, 1.0, 1.0, InputHold::held).inertia;
  constexpr double w = 8.0;
  constexpr double zeta = 0.3;
  constexpr double end = 0.64;
  const double damped = w * std::sqrt(1.0 - zeta * zeta);
  const double exact =
      std::exp(-zeta * w * end) *
      (std::cos(damped * end) + zeta * w / damped * std::sin(damped * end));
  std::array<double, 3> errors;
  for (int i = 0; i < 3; ++i) {
    const double T = 0.01 / (1 << i);
    const Rotor rotor =
        make_rotor(T, J * w * w, 2.0 * J * zeta * w, InputHold::held);
    SystemState state = make_state(rotor.model);
    state.bodies[0].quat_WB =
        Quaternion(std::cos(0.5), 0.0, 0.0, std::sin(0.5));
    const SystemState end_state =
        run(rotor.model, state,
            {.integrator = IntegratorKind::runge_kutta_4,
             .end_time = end,
             .step = T});
    errors[std::size_t(i)] = 2.0 * std::atan2(end_state.bodies[0].quat_WB.z(),
                                              end_state.bodies[0].quat_WB.w()) -
                             exact;
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1.0, 0.05);
  EXPECT_LT(std::abs(errors[2]), 0.01);
}

}  // namespace
}  // namespace limber::dynamics::controller_test
