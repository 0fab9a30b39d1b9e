// SPDX-License-Identifier: BSD-3-Clause
// Events against closed forms of bodies on rails.
#include "limber/dynamics/monitors/event.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/sliding_masses.hpp"

namespace limber::dynamics::event_test {
namespace {

using joints::EndStop;
using testing::add_mass;
using testing::add_rail;
using testing::Mass;
using testing::run_from;
using testing::RunOutcome;

class EventIn : public ::testing::TestWithParam<IntegratorKind> {
 protected:
  static SimulationSettings settings(double end, double step) {
    SimulationSettings s;
    s.integrator = GetParam();
    s.end_time = end;
    s.step = step;
    s.output_times = {0.0, end};
    return s;
  }
};

// A body of 2 kg at 3 m/s, 0.5 m from a stop that gives back 60 % of 3 m/s.
struct Bouncer {
  SystemModel model;
  SystemState state;
};
Bouncer make_bouncer(double restitution) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  const EndStop stop({.upper = 0.5,
                      .stiffness = 2e4,
                      .damping = joints::find_stop_damping(restitution, 3.0)});
  add_rail(builder, mass, "rail", {{0, stop}});
  Bouncer out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].v_WB_W.x() = 3.0;
  return out;
}

TEST_P(EventIn, AStopIsReachedWhenFreeMotionHasCrossedTheGap) {
  const Bouncer b = make_bouncer(1.0);
  const RunOutcome r = run_from(b.model, b.state, settings(0.17, 1.3e-4));
  ASSERT_GE(r.statistics.events.size(), 1U);
  EXPECT_EQ(r.statistics.events[0].source, "rail");
  EXPECT_EQ(r.statistics.events[0].what, "stop reached");
  EXPECT_NEAR(r.statistics.events[0].time, 0.5 / 3.0, 1e-12);
  EXPECT_NEAR(r.statistics.events[0].rate, 3.0, 1e-9);
}

TEST_P(EventIn, AnElasticStopIsLeftAfterHalfAPeriodAtTheSpeedOfArrival) {
  const Bouncer b = make_bouncer(1.0);
  const double half = M_PI * std::sqrt(2.0 / 2e4);
  const RunOutcome r =
      run_from(b.model, b.state, settings(0.5 / 3.0 + half + 0.01, 2e-5));
  ASSERT_EQ(r.statistics.events.size(), 2U);
  EXPECT_EQ(r.statistics.events[1].what, "stop left");
  EXPECT_NEAR(r.statistics.events[1].time, 0.5 / 3.0 + half, 1e-7);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), -3.0, 1e-6);
}

TEST_P(EventIn, AStopGivesBackTheShareOfSpeedThatItsDampingWasMadeFor) {
  const Bouncer b = make_bouncer(0.6);
  const RunOutcome r = run_from(b.model, b.state, settings(0.25, 1e-5));
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), -1.8, 2e-6);
  // What the ball lost, the stop has turned to heat.
  EXPECT_NEAR(r.energies.back().total() + r.energies.back().dissipated, 9.0,
              1e-5);
}

TEST_P(EventIn, ALatchClosesAtItsReachAndKeepsMomentum) {
  SystemBuilder builder;
  const Mass left = add_mass(builder, "left", 2.0);
  const Mass right = add_mass(builder, "right", 3.0);
  joints::Latch::Parameters latch{.reach = 0.1, .bushing = {}};
  latch.bushing.translational_stiffness = 5e3 * Matrix3::Identity();
  latch.bushing.translational_damping = 100.0 * Matrix3::Identity();
  latch.bushing.rotational_stiffness = 5e3 * Matrix3::Identity();
  builder.add_coupler("latch", joints::Latch(latch), left.frame, right.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 2.0;
  state.bodies[1].p_WB.x() = 0.5;
  const RunOutcome r = run_from(model, state, settings(1.0, 1e-4));
  ASSERT_EQ(r.statistics.events.size(), 1U);
  EXPECT_EQ(r.statistics.events[0].what, "latched");
  EXPECT_NEAR(r.statistics.events[0].time, 0.2, 1e-12);
  EXPECT_NEAR(r.statistics.events[0].rate, 2.0, 1e-12);
  // Together at the speed of the common centre; it stays where it caught.
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), 0.8, 1e-9);
  EXPECT_NEAR(r.state.bodies[1].v_WB_W.x(), 0.8, 1e-9);
  EXPECT_NEAR(r.state.bodies[1].p_WB.x() - r.state.bodies[0].p_WB.x(), 0.1,
              1e-9);
  EXPECT_NEAR(r.energies.back().linear_momentum.x(), 4.0, 1e-11);
  // 4 J less the 1.6 J of the common motion.
  EXPECT_NEAR(r.energies.back().dissipated, 2.4, 2e-4);
}

// A body that passes a latch at a distance y, in steps that are longer than the
// time that it is within reach; |p|^2 = (0.5 - 5 t)^2 + y^2.
RunOutcome pass_latch(double y, const SimulationSettings& settings) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "body", 2.0);
  joints::Latch::Parameters latch{.reach = 0.02, .bushing = {}};
  latch.bushing.translational_stiffness = 0.1 * Matrix3::Identity();
  builder.add_coupler("latch", joints::Latch(latch),
                      builder.attach_world("wall", {}), mass.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(0.5, y, 0.0);
  state.bodies[0].v_WB_W.x() = -5.0;
  return run_from(model, state, settings);
}

TEST_P(EventIn, ALatchClosesOnABodyThatIsPastItAfterTheStep) {
  for (const double y : {0.0, 0.01, -0.019}) {
    SCOPED_TRACE(y);
    const RunOutcome r = pass_latch(y, settings(0.12, 0.04));
    ASSERT_EQ(r.statistics.events.size(), 1U);
    EXPECT_EQ(r.statistics.events[0].what, "latched");
    EXPECT_NEAR(r.statistics.events[0].time,
                (0.5 - std::sqrt(0.02 * 0.02 - y * y)) / 5.0, 1e-9);
  }
}

TEST_P(EventIn, ALatchStaysOpenOutsideItsReach) {
  const RunOutcome r = pass_latch(0.0201, settings(0.12, 0.04));
  EXPECT_TRUE(r.statistics.events.empty());
}

// Thrown against a force that turns it round 5 mm behind a stop, within a step.
TEST_P(EventIn, AStopIsReachedByABodyThatWouldTurnRoundWithinTheStep) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "body", 2.0);
  add_rail(builder, mass, "rail",
           {{0, EndStop({.upper = 0.495, .stiffness = 1.0})}});
  builder.set_gravity({-10.0, 0.0, 0.0});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = std::sqrt(10.0);  // turns at 0.5 m, 0.316 s
  const RunOutcome r = run_from(model, state, settings(0.4, 0.1));
  ASSERT_GE(r.statistics.events.size(), 1U);
  EXPECT_EQ(r.statistics.events[0].what, "stop reached");
  const double rate = std::sqrt(10.0 - 2.0 * 10.0 * 0.495);
  EXPECT_NEAR(r.statistics.events[0].time, (std::sqrt(10.0) - rate) / 10.0,
              1e-6);
}

TEST_P(EventIn, ALatchWithinReachAtTheStartClosesThere) {
  SystemBuilder builder;
  const Mass left = add_mass(builder, "left", 2.0);
  joints::Latch::Parameters latch{.reach = 0.1, .bushing = {}};
  latch.bushing.translational_stiffness = 200.0 * Matrix3::Identity();
  builder.add_coupler("latch", joints::Latch(latch),
                      builder.attach_world("wall", {}), left.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 0.05;
  state.bodies[0].v_WB_W.y() = 1.0;
  // It swings about where it was caught, with omega = 10 rad/s.
  const RunOutcome r = run_from(model, state, settings(0.3, 1e-4));
  ASSERT_EQ(r.statistics.events.size(), 1U);
  EXPECT_EQ(r.statistics.events[0].time, 0.0);
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 0.05, 1e-12);
  EXPECT_NEAR(r.state.bodies[0].p_WB.y(), 0.1 * std::sin(3.0), 1e-6);
}

TEST_P(EventIn, ALatchThatLetsGoLosesWhatItStored) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  joints::Latch::Parameters latch{.reach = 0.1, .bushing = {}};
  latch.bushing.translational_stiffness = 200.0 * Matrix3::Identity();
  latch.release_force = 12.0;
  builder.add_coupler("latch", joints::Latch(latch),
                      builder.attach_world("wall", {}), mass.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 1.0;
  // x = 0.1 sin(10 t) reaches 12 N / 200 N/m = 0.06 m, there at 0.8 m/s.
  const double release = 0.1 * std::asin(0.6);
  const RunOutcome r = run_from(model, state, settings(0.5, 1e-4));
  ASSERT_EQ(r.statistics.events.size(), 2U);
  EXPECT_EQ(r.statistics.events[1].what, "released");
  EXPECT_NEAR(r.statistics.events[1].time, release, 1e-7);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), 0.8, 1e-6);
  EXPECT_NEAR(r.energies.back().dissipated, 0.5 * 200.0 * 0.06 * 0.06, 1e-6);
  EXPECT_EQ(r.state.memory[0].latch, joints::LatchStatus::released);
}

TEST_P(EventIn, ALatchIsReleasedAtItsTimeAndNeverClosesAgain) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  joints::Latch::Parameters latch{.reach = 0.1, .bushing = {}};
  latch.bushing.translational_stiffness = 200.0 * Matrix3::Identity();
  latch.release_time = 0.03217;
  builder.add_coupler("latch", joints::Latch(latch),
                      builder.attach_world("wall", {}), mass.frame);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 1.0;
  const RunOutcome r = run_from(model, state, settings(0.05, 1e-4));
  ASSERT_EQ(r.statistics.events.size(), 2U);
  EXPECT_NEAR(r.statistics.events[1].time, 0.03217, 1e-12);
  EXPECT_NEAR(r.state.bodies[0].v_WB_W.x(), std::cos(0.3217), 1e-6);
}

// Of equal masses that move alike, on latches with the same limits.
TEST_P(EventIn, LatchesThatLetGoAtOneTimeAllDo) {
  for (const bool by_force : {true, false}) {
    SystemBuilder builder;
    joints::Latch::Parameters latch{.reach = 0.1, .bushing = {}};
    latch.bushing.translational_stiffness = 200.0 * Matrix3::Identity();
    (by_force ? latch.release_force : latch.release_time) =
        by_force ? 12.0 : 0.03217;
    const auto wall = builder.attach_world("wall", {});
    for (const std::string name : {"first", "second", "third"}) {
      builder.add_coupler(name + "_latch", joints::Latch(latch), wall,
                          add_mass(builder, name, 2.0).frame);
    }
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    for (BodyState& body : state.bodies) body.v_WB_W.x() = 1.0;
    const RunOutcome r = run_from(model, state, settings(0.1, 1e-4));
    EXPECT_EQ(r.statistics.events.size(), 6U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(r.state.memory[i].latch, joints::LatchStatus::released);
      EXPECT_NEAR(r.state.bodies[i].v_WB_W.x(),
                  by_force ? 0.8 : std::cos(0.3217), 1e-6);
    }
  }
}

TEST_P(EventIn, ASlackLineGoesTautWhereTheFallHasUsedItUp) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  builder.add_path(
      "line", {builder.attach_world("hook", {}), mass.frame},
      {joints::ScalarSpring(
          {.curve = joints::SpringCurve({.stiffness = 800.0, .extensions = {}}),
           .damping = 5.0,
           .rest = 0.5,
           .tension_only = true})});
  builder.set_gravity({0, 0, -10.0});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(0, 0, -0.1);
  const RunOutcome r = run_from(model, state, settings(1.0, 1e-4));
  ASSERT_GE(r.statistics.events.size(), 2U);
  EXPECT_EQ(r.statistics.events[0].what, "taut");
  EXPECT_NEAR(r.statistics.events[0].time, std::sqrt(2.0 * 0.4 / 10.0), 1e-10);
  EXPECT_NEAR(r.statistics.events[0].rate, std::sqrt(2.0 * 10.0 * 0.4), 1e-9);
  EXPECT_EQ(r.statistics.events[1].what, "slack");
  const EnergyBalance& end = r.energies.back();
  EXPECT_NEAR(end.total() + end.dissipated - end.work, 0.0, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(All, EventIn,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::runge_kutta_4,
                                           IntegratorKind::central_differences,
                                           IntegratorKind::energy_conserving,
                                           IntegratorKind::splitting),
                         [](const auto& param) {
                           std::string name = to_string(param.param);
                           std::erase(name, '-');
                           return name;
                         });

// --- Orders -----------------------------------------------------------------

TEST(Events, DoNotSpoilTheSecondOrderOfGeneralizedAlpha) {
  const Bouncer b = make_bouncer(0.6);
  const auto position_after = [&](double step) {
    return run_from(b.model, b.state,
                    {.end_time = 0.25, .step = step, .output_times = {}})
        .state.bodies[0]
        .p_WB.x();
  };
  const double exact = position_after(2.5e-6);
  const double coarse = std::abs(position_after(4e-4) - exact);
  const double fine = std::abs(position_after(1e-4) - exact);
  EXPECT_GT(std::log2(coarse / fine) / 2.0, 1.7);
  EXPECT_GT(coarse, 1e-7);
}

TEST(Events, TellTheEdgesOfLoads) {
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  builder.add_load("kick", mass.frame, Vector3::UnitX(), Vector3::Zero(),
                   LoadFrame::world, Pulse{PulseShape::rectangular, 0.1, 0.2});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model),
               {.end_time = 1.0, .step = 1e-2, .output_times = {}});
  ASSERT_EQ(r.statistics.events.size(), 2U);
  EXPECT_EQ(r.statistics.events[0], (Event{0.1, "kick", "load edge", 0.0}));
  EXPECT_NEAR(r.statistics.events[1].time, 0.3, 1e-15);
}

TEST(Events, ManyBouncesAreAllSeen) {
  // Between two elastic stops 1 m apart at 3 m/s.
  SystemBuilder builder;
  const Mass mass = add_mass(builder, "ball", 2.0);
  add_rail(builder, mass, "rail",
           {{0, EndStop({.lower = -0.5, .upper = 0.5, .stiffness = 2e5})}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 3.0;
  const RunOutcome r = run_from(
      model, state, {.end_time = 10.0, .step = 1e-3, .output_times = {}});
  const double round = 1.0 / 3.0 + M_PI * std::sqrt(2.0 / 2e5);
  const auto bounces = static_cast<std::size_t>((10.0 - 0.5 / 3.0) / round) + 1;
  EXPECT_NEAR(static_cast<double>(r.statistics.events.size()),
              2.0 * static_cast<double>(bounces), 1.0);
  EXPECT_NEAR(std::abs(r.state.bodies[0].v_WB_W.x()), 3.0, 5e-2);
}

}  // namespace
}  // namespace limber::dynamics::event_test
