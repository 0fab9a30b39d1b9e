// SPDX-License-Identifier: BSD-3-Clause
// Warnings and errors about energy that runs gain or lose.
#include "limber/dynamics/monitors/energy_verdict.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/start_warnings.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::energy_verdict_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Monitored {
  SimulationStatistics statistics;
  RunRecord record;
};
Monitored run_from(const SystemModel& model, const SystemState& start,
                   const SimulationSettings& settings) {
  Monitored run;
  SystemState state = start;
  simulate(model, state, settings, {}, {}, run.statistics, {}, {}, run.record);
  return run;
}

// A light mass and a heavy one on springs of their own.
struct Pair {
  SystemModel model;
  SystemState state;
};
Pair make_pair_of_oscillators(double light_frequency) {
  SystemBuilder builder;
  const AttachmentIndex wall = builder.attach_world("wall", {});
  const auto add = [&](const char* name, double mass, double omega) {
    const testing::Mass m = testing::add_mass(builder, name, mass);
    joints::Bushing::Parameters spring;
    spring.translational_stiffness = mass * omega * omega * Matrix3::Identity();
    builder.add_coupler(std::string(name) + "_spring", joints::Bushing(spring),
                        wall, m.frame);
  };
  add("light", 1.0, light_frequency);
  add("heavy", 10.0, 1.0);
  Pair out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].v_WB_W.x() = 1.0;
  out.state.bodies[1].v_WB_W.x() = 1.0;
  return out;
}

// The light one on the heavy one, which is on a wall.
Pair make_mass_on_mass(double light_frequency) {
  SystemBuilder builder;
  const auto spring = [](double mass, double omega) {
    joints::Bushing::Parameters p;
    p.translational_stiffness = mass * omega * omega * Matrix3::Identity();
    return joints::Bushing(p);
  };
  const testing::Mass light = testing::add_mass(builder, "light", 1.0);
  const testing::Mass heavy = testing::add_mass(builder, "heavy", 10.0);
  builder.add_coupler("wall_spring", spring(10.0, 1.0),
                      builder.attach_world("wall", {}), heavy.frame);
  builder.add_coupler("light_spring", spring(1.0, light_frequency), heavy.frame,
                      light.frame);
  Pair out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].v_WB_W.x() = 2.0;
  out.state.bodies[1].v_WB_W.x() = 1.0;
  return out;
}

SimulationSettings settings_of(IntegratorKind integrator, double step,
                               double end) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.step = step;
  settings.end_time = end;
  settings.output_times = {0.0, end};
  return settings;
}

// What the light mass moves beside the heavy one, m M / (m + M) v^2 / 2 of
// 7 J, at 60 times too fast for the steps.
TEST(EnergyVerdict, TellsSizeTimeAndPlaceOfALossBeyondAPercent) {
  const Pair scene = make_mass_on_mass(600.0);
  SimulationSettings settings =
      settings_of(IntegratorKind::generalized_alpha, 0.1, 10.0);
  settings.rho_inf = 0.0;
  const Monitored run = run_from(scene.model, scene.state, settings);
  // The heavy mass, at 60 steps a period, loses 2 %.
  EXPECT_NEAR(find_unbalanced_fraction(run.record.energy.worst),
              0.5 / 1.1 / 7.0, 0.02);
  EXPECT_LT(run.record.energy.drift.value, 0.0);
  EXPECT_THAT(run.statistics.warnings,
              Contains(AllOf(HasSubstr("lost by t = "), HasSubstr("light"))));
}

// A loss beside 5e8 J of a mass that passes 1 km away, and beside
// a common velocity.
TEST(EnergyVerdict, DoesNotDependOnOtherBodiesOrOnACommonVelocity) {
  SimulationSettings settings =
      settings_of(IntegratorKind::generalized_alpha, 0.1, 10.0);
  settings.rho_inf = 0.0;
  const auto find_fraction = [&](bool has_stranger, double boost) {
    SystemBuilder builder;
    const auto spring = [](double stiffness) {
      joints::Bushing::Parameters p;
      p.translational_stiffness = stiffness * Matrix3::Identity();
      return joints::Bushing(p);
    };
    const auto first = testing::add_mass(builder, "first", 10.0);
    const auto second = testing::add_mass(builder, "second", 10.0);
    const auto light = testing::add_mass(builder, "light", 1.0);
    builder.add_coupler("soft", spring(10.0), first.frame, second.frame);
    builder.add_coupler("stiff", spring(3.6e5), second.frame, light.frame);
    if (has_stranger) testing::add_mass(builder, "stranger", 1e5);
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W.x() = 1.0;
    state.bodies[2].v_WB_W.x() = 1.0;
    for (BodyState& body : state.bodies) body.v_WB_W.y() += boost;
    if (has_stranger) {
      state.bodies[3].p_WB.z() = 1000.0;
      state.bodies[3].v_WB_W.x() = 100.0;
    }
    const Monitored run = run_from(model, state, settings);
    EXPECT_THAT(run.statistics.warnings,
                ElementsAre(AllOf(HasSubstr("lost by t = "),
                                  Not(HasSubstr("stranger")))));
    return find_unbalanced_fraction(run.record.energy.worst);
  };
  const double alone = find_fraction(false, 0.0);
  EXPECT_GT(alone, 0.03);
  EXPECT_LT(alone, 0.3);
  EXPECT_NEAR(find_fraction(true, 0.0), alone, 1e-9);
  EXPECT_NEAR(find_fraction(false, 7500.0), alone, 1e-6);
  EXPECT_NEAR(find_fraction(true, 7500.0), alone, 1e-6);
}

// What is left to two bodies whose damper took their relative motion at the
// start: 1e-16 J beside a common motion of 0.01 J, 1e-9 J at the shortest step.
TEST(EnergyVerdict, TakesWhatNewtonsMethodLeavesForNothing) {
  for (const double boost : {0.0, 0.1, 7500.0}) {
    SystemBuilder builder;
    const testing::Mass a = testing::add_mass(builder, "a", 1.0);
    const testing::Mass b = testing::add_mass(builder, "b", 2.0);
    joints::Bushing::Parameters p;
    p.translational_stiffness = 1e3 * Matrix3::Identity();
    p.translational_damping = 5e5 * Matrix3::Identity();
    builder.add_coupler("j", joints::Bushing(p), a.frame, b.frame);
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    for (BodyState& body : state.bodies) body.v_WB_W.y() = boost;
    state.bodies[1].v_WB_W.x() = 0.1;
    for (const double step : {0.01, 2.5e-3, 6e-4}) {
      const Monitored run =
          run_from(model, state,
                   settings_of(IntegratorKind::generalized_alpha, step, 0.3));
      EXPECT_THAT(run.statistics.warnings,
                  ElementsAre(HasSubstr("an impulse set")))
          << boost << ", " << step;
    }
  }
}

// Each group beside its own energy: the light mass loses all it has.
TEST(EnergyVerdict, RefusesAGroupThatLosesItsEnergyBesideAnother) {
  const Pair scene = make_pair_of_oscillators(600.0);
  SimulationSettings settings =
      settings_of(IntegratorKind::generalized_alpha, 0.1, 10.0);
  settings.rho_inf = 0.0;
  try {
    static_cast<void>(run_from(scene.model, scene.state, settings));
    ADD_FAILURE() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("does not balance"),
                                    HasSubstr("the throughput of 0.5 J"),
                                    HasSubstr("light")));
  }
}

TEST(EnergyVerdict, SaysNothingWhereStepsResolveTheMotion) {
  const Pair scene = make_pair_of_oscillators(6.0);
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::runge_kutta_4,
        IntegratorKind::central_differences, IntegratorKind::splitting,
        IntegratorKind::energy_conserving}) {
    const Monitored run =
        run_from(scene.model, scene.state, settings_of(kind, 5e-3, 10.0));
    EXPECT_THAT(run.statistics.warnings, IsEmpty());
    EXPECT_LT(find_unbalanced_fraction(run.record.energy.worst), 0.01);
    EXPECT_NEAR(run.record.energy.throughput, 5.5, 0.01);
  }
}

// x' = v, v' = -w^2 x by implicit Euler: the energy falls by 1 + (w h)^2 a
// step.
TEST(EnergyVerdict, WarnsOfWhatImplicitEulerDampsAndLetsItRun) {
  const Pair scene = make_pair_of_oscillators(1.0);
  const Monitored run =
      run_from(scene.model, scene.state,
               settings_of(IntegratorKind::implicit_euler, 0.1, 10.0));
  const double left = std::pow(1.0 + 0.01, -100.0);
  EXPECT_NEAR(find_unbalanced_fraction(run.record.energy.worst), 1.0 - left,
              0.02);
  EXPECT_THAT(run.statistics.warnings,
              ElementsAre(HasSubstr("implicit-euler damps")));
}

TEST(EnergyVerdict, DoesNotAdviseTheSchemeInUse) {
  EnergyRecord record;
  record.worst.drift = {-0.1, 1.0};
  record.worst.throughput = 1.0;
  const auto advise = [&](IntegratorKind integrator) {
    std::vector<std::string> warnings;
    warn_of_energy(integrator, record, warnings);
    EXPECT_EQ(warnings.size(), 1U);
    return warnings.front();
  };
  EXPECT_THAT(advise(IntegratorKind::generalized_alpha),
              HasSubstr("energy-conserving"));
  EXPECT_THAT(advise(IntegratorKind::energy_conserving),
              ::testing::Not(HasSubstr("energy-conserving")));
}

TEST(EnergyVerdict, EndsARunThatLosesMoreThanHalf) {
  const Pair scene = make_pair_of_oscillators(600.0);
  SystemState state = scene.state;
  state.bodies[1].v_WB_W.setZero();
  SimulationSettings settings =
      settings_of(IntegratorKind::generalized_alpha, 0.1, 10.0);
  settings.rho_inf = 0.0;
  SimulationStatistics statistics;
  int outputs = 0;
  try {
    simulate(
        scene.model, state, settings,
        [&](const SystemState&, const EnergyBalance&) { ++outputs; }, {},
        statistics);
    ADD_FAILURE() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("does not balance"));
    EXPECT_THAT(error.what(), HasSubstr("light"));
    EXPECT_THAT(error.what(), HasSubstr("t = "));
  }
  EXPECT_EQ(outputs, 2);
}

// What splitting makes and takes in turn: what counts is the extreme, not the
// end.
TEST(EnergyVerdict, CountsTheLargestDriftAtAnyStep) {
  const Pair scene = make_pair_of_oscillators(6.0);
  SystemState state = scene.state;
  SimulationStatistics statistics;
  RunRecord record;
  std::vector<EnergyBalance> ends;
  simulate(
      scene.model, state, settings_of(IntegratorKind::splitting, 0.15, 9.9),
      [&](const SystemState&, const EnergyBalance& e) { ends.push_back(e); },
      {}, statistics, {}, {}, record);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_GE(std::abs(record.energy.drift.value),
            std::abs(ends[1].total() - ends[0].total()));
  EXPECT_GT(record.energy.drift.time, 0.0);
  EXPECT_LT(record.energy.drift.time, 9.9);
}

// Two bodies held together by 1e9 N/m, far from the origin, where nothing
// moves but round-off.
TEST(EnergyVerdict, TakesRoundOffForNothing) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::runge_kutta_4,
        IntegratorKind::implicit_euler, IntegratorKind::energy_conserving}) {
    SystemBuilder builder;
    const testing::Mass a = testing::add_mass(builder, "a", 1.0);
    const testing::Mass b = testing::add_mass(builder, "b", 2.0);
    joints::Bushing::Parameters p;
    p.translational_stiffness = 1e9 * Matrix3::Identity();
    p.rotational_stiffness = 1e6 * Matrix3::Identity();
    builder.add_coupler("weld", joints::Bushing(p), a.frame, b.frame);
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    for (BodyState& body : state.bodies) {
      body.p_WB = {1.0 / 3.0, 100.0 / 3.0, 7.1};
      body.quat_WB =
          Quaternion(Eigen::AngleAxisd(0.3, Vector3(1, 2, 3).normalized()));
    }
    const Monitored run = run_from(model, state, settings_of(kind, 1e-5, 0.02));
    EXPECT_THAT(run.statistics.warnings, IsEmpty());
  }
}

TEST(StartWarnings, TellWhatAStopStoresBeyondWhichAJointStarts) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "slider", 2.0);
  testing::add_rail(
      builder, mass, "rail",
      {{0, joints::EndStop({.lower = -0.2, .upper = 0.2, .stiffness = 2e4})}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 0.56;  // 0.36 beyond: 2e4 * 0.36^2 / 2 = 1296 J
  const Monitored run = run_from(
      model, state, settings_of(IntegratorKind::generalized_alpha, 1e-4, 0.05));
  EXPECT_THAT(run.statistics.warnings,
              Contains(AllOf(HasSubstr("'rail'"), HasSubstr("0.36 beyond"),
                             HasSubstr("1.3e+03 J"))));
  ASSERT_FALSE(run.statistics.events.empty());
  EXPECT_EQ(run.statistics.events[0].what, "starts beyond a stop");
  EXPECT_EQ(run.statistics.events[0].time, 0.0);
}

// Of a body of any size, which starts by a fraction of it beyond a stop at
// zero.
TEST(StartWarnings, CompareAnExcessWithTheSizeOfWhatMoves) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "slider", 2.0);
  testing::add_rail(
      builder, mass, "rail",
      {{0, joints::EndStop({.lower = -1e9, .upper = 0.0, .stiffness = 2e4})}});
  SystemModel model = builder.build();
  SystemState state = make_state(model);
  for (const double size : {1e-6, 1e-3, 1.0, 1e3}) {
    model.bodies[0].J0 = 2.0 * size * size * Matrix3::Identity();
    for (const auto& [fraction, warns] : {std::pair{1e-8, 1U}, {1e-10, 0U}}) {
      state.bodies[0].p_WB.x() = fraction * size;
      SimulationStatistics statistics;
      add_start_warnings(model, state, statistics);
      EXPECT_EQ(statistics.warnings.size(), warns) << size << " " << fraction;
    }
  }
}

// A spring of a drive that pulls 10 N/m x 1 m at the start and may give 5 N:
// at its limit while x > 0.5.
TEST(EffortLimitObserver, TellsWhenAndWhereADriveReachesItsLargestEffort) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "slider", 1.0);
  joints::Drive::Parameters p;
  p.mode = joints::DriveMode::position;
  p.stiffness = 10.0;
  p.max_effort = 5.0;
  testing::add_rail(builder, mass, "rail", {{0, joints::Drive(p)}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = std::sqrt(10.0);  // would swing to 1 m
  const Monitored run = run_from(
      model, state, settings_of(IntegratorKind::generalized_alpha, 1e-3, 1.4));
  const double omega = std::sqrt(10.0);
  const double reached = std::asin(0.5) / omega;  // x = sin(omega t)
  ASSERT_EQ(run.statistics.events.size(), 2U);
  EXPECT_EQ(run.statistics.events[0].what, "effort limit reached");
  EXPECT_EQ(run.statistics.events[0].source, "rail");
  EXPECT_NEAR(run.statistics.events[0].time, reached, 1e-5);
  EXPECT_EQ(run.statistics.events[1].what, "effort limit left");
  // There 5 N take v = omega sqrt(1 - 0.25) away and give it back.
  const double held = 2.0 * omega * std::sqrt(0.75) / 5.0;
  EXPECT_NEAR(run.statistics.events[1].time, reached + held, 1e-4);
  EXPECT_THAT(run.statistics.warnings,
              ElementsAre(AllOf(HasSubstr("'rail'"), HasSubstr("effort of 5"),
                                HasSubstr("coordinate is 0."))));
}

// A shaft turns 1 kg at 0.2 m with 100 rad/s: some 2000 N on 1e5 N/m give 22
// mm, a tenth of its arm; on 1e9 N/m nothing to speak of.
TEST(DeflectionObserver, TellsOfAJointThatGivesWayWithTheStiffnessThatWouldDo) {
  for (const double stiffness : {1e5, 1e9}) {
    SystemBuilder builder;
    const Matrix3 J = 0.01 * Matrix3::Identity();
    const BodyIndex body = builder.add_rigid_body("crank", {1.0, J});
    const Pose at{Matrix3::Identity(), {-0.2, 0.0, 0.0}};
    const AttachmentIndex pin = builder.attach_frame("pin", body, at);
    builder.attach_frame("end", body, {Matrix3::Identity(), Vector3::Zero()});
    builder.add_coupler(
        "hinge",
        joints::make_joint(joints::JointKind::revolute, Vector3::UnitZ(), {},
                           {.translational_stiffness = stiffness,
                            .rotational_stiffness = stiffness}),
        builder.attach_world("ground", {}), pin);
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    // k d = m w^2 (0.2 m + d)
    const double give = 0.2 * 1e4 / (stiffness - 1e4);
    state.bodies[0].p_WB.x() = 0.2 + give;
    state.bodies[0].w_WB_B.z() = 100.0;
    state.bodies[0].v_WB_W.y() = 100.0 * (0.2 + give);
    const std::vector<std::string> warnings =
        run_from(model, state,
                 settings_of(IntegratorKind::generalized_alpha, 1e-4, 0.1))
            .statistics.warnings;
    if (stiffness > 1e6) {
      EXPECT_THAT(warnings, IsEmpty());
      continue;
    }
    EXPECT_THAT(warnings,
                ElementsAre(AllOf(HasSubstr("joint 'hinge' deflects by 0.0222"),
                                  HasSubstr("body 'crank' (0.2 m)"),
                                  HasSubstr("e+07 N/m in place of 1e+05"))));
  }
}

}  // namespace
}  // namespace limber::dynamics::energy_verdict_test
