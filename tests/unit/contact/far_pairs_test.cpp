// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "limber/contact/make_contact.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/monitors/contact_start_observer.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Pairs that are far apart cost next to nothing, and touch on time all the
/// same: against closed forms of when they meet.
namespace limber::contact::far_pairs_test {
namespace {

using dynamics::BodyIndex;
using dynamics::kWorld;

constexpr double kFixed = std::numeric_limits<double>::infinity();
constexpr SurfaceMaterial kSteel{2.1e11, 0.3};

// Two touch as far before as both go in this part of a step
// (ContactStartObserver).
constexpr double kEarly = 3e-4;

/// A contact that counts what it is asked for.
class CountingPair final : public joints::PairInteraction,
                           public joints::Touching {
 public:
  CountingPair(ContactSide A, ContactSide B)
      : pair_(std::move(A), std::move(B), {}) {}

  mutable long evaluations = 0;
  mutable long looks = 0;

  std::string_view kind() const override { return "counting"; }
  void describe_parameters(Manifest& /*out*/) const override {}
  std::size_t most_points() const override { return pair_.most_points(); }
  bool couples_points() const override { return pair_.couples_points(); }
  std::size_t memory_size() const override { return pair_.memory_size(); }
  void check(int a, int b) const override { pair_.check(a, b); }
  void evaluate(const joints::PairBodies& bodies, const EvaluationTime& now,
                std::span<const double> memory,
                joints::PairResponse& out) const override {
    ++evaluations;
    pair_.evaluate(bodies, now, memory, out);
  }
  void commit(const joints::PairBodies& bodies, double t,
              std::span<double> memory,
              joints::PairResponse& scratch) const override {
    ++evaluations;
    pair_.commit(bodies, t, memory, scratch);
  }
  const joints::Touching* touching() const override { return this; }
  joints::PairTouch find_touch(const joints::PairBodies& bodies,
                               joints::PairResponse& scratch) const override {
    ++looks;
    return pair_.find_touch(bodies, scratch);
  }
  double find_clearance(const joints::PairBodies& bodies) const override {
    ++looks;
    return pair_.find_clearance(bodies);
  }
  double find_speed_bound(const joints::PairBodies& bodies) const override {
    ++looks;
    return pair_.find_speed_bound(bodies);
  }
  joints::TouchReach find_reach_A() const override {
    return pair_.find_reach_A();
  }
  joints::TouchReach find_reach_B() const override {
    return pair_.find_reach_B();
  }
  double find_size() const override { return pair_.find_size(); }
  void set_mobility(const joints::PairMobility& mobility,
                    std::span<double> memory) const override {
    pair_.set_mobility(mobility, memory);
  }
  void end_touch(std::span<double> memory) const override {
    pair_.end_touch(memory);
  }
  double begin_touch(const joints::PairBodies& bodies, double t,
                     std::span<double> memory,
                     joints::PairResponse& scratch) const override {
    return pair_.begin_touch(bodies, t, memory, scratch);
  }
  joints::TouchReading read(const joints::PairBodies& bodies,
                            const EvaluationTime& now,
                            std::span<const double> memory,
                            joints::PairResponse& scratch) const override {
    return pair_.read(bodies, now, memory, scratch);
  }

 private:
  PatchPair pair_;
};

ContactSide make_ball(double radius, double mass,
                      const Vector3& place = {0.0, 0.0, 0.0}) {
  return {Shape{Sphere{radius}, Pose{Matrix3::Identity(), place}}, kSteel,
          mass};
}

BodyIndex add_body(dynamics::SystemBuilder& builder, const std::string& name) {
  return builder.add_rigid_body(name, {1.0, 0.1 * Matrix3::Identity()});
}

/// Time of the first touch of a run, or NaN.
double find_touch_time(const dynamics::SystemModel& model,
                       dynamics::SystemState& state, double end, double step) {
  dynamics::SimulationSettings settings;
  settings.end_time = end;
  settings.step = step;
  dynamics::RunRecord record;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(model, state, settings, {}, {}, statistics, {}, {},
                     record);
  return record.contacts.empty() ? std::nan("") : record.contacts[0].time;
}

TEST(FarPairs, AreNeitherEvaluatedNorLookedAtInMostSteps) {
  dynamics::SystemBuilder builder;
  const BodyIndex a = add_body(builder, "a");
  const BodyIndex b = add_body(builder, "b");
  const auto law =
      std::make_shared<CountingPair>(make_ball(0.1, 1.0), make_ball(0.1, 1.0));
  builder.add_pair("a/b", a, b, law);
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[1].p_WB = {10.0, 0.0, 0.0};
  state.bodies[0].v_WB_W = {1.0, 0.0, 0.0};
  find_touch_time(model, state, 9.0, 1e-3);
  EXPECT_LT(law->evaluations, 100);  // of 9000 steps
  EXPECT_LT(law->looks, 200);
}

TEST(FarPairs, TouchOnTimeAtAnySpeedAndStep) {
  for (const double speed : {0.1, 10.0, 1e3, 1e5}) {
    for (const double step : {0.3, 0.011, 0.0007}) {  // of the flight
      dynamics::SystemBuilder builder;
      const BodyIndex a = add_body(builder, "a");
      const BodyIndex b = add_body(builder, "b");
      builder.add_pair("a/b", a, b,
                       make_contact(make_ball(0.01, 1.0), make_ball(0.01, 1.0),
                                    ContactParameters{}));
      const dynamics::SystemModel model = builder.build();
      dynamics::SystemState state = dynamics::make_state(model);
      state.bodies[1].p_WB = {50.0, 0.0, 0.0};
      state.bodies[0].v_WB_W = {0.7 * speed, 0.0, 0.0};
      state.bodies[1].v_WB_W = {-0.3 * speed, 0.0, 0.0};
      const double flight = (50.0 - 0.02) / speed;
      EXPECT_NEAR(
          find_touch_time(model, state, (1.0 + 1e-6) * flight, step * flight),
          flight, kEarly * step * flight)
          << speed << " m/s, steps of " << step;
    }
  }
}

// Of bodies at rest it is the round-off of their places, in any unit of length.
TEST(FarPairs, CountARoundOffOfTheirPlacesAsTouching) {
  const auto find_fraction = [](double size) {
    dynamics::SystemBuilder builder;
    const BodyIndex a = add_body(builder, "a");
    const BodyIndex b = add_body(builder, "b");
    builder.add_pair("a/b", a, b,
                     make_contact(make_ball(size, 1.0), make_ball(size, 1.0),
                                  ContactParameters{}));
    const dynamics::SystemModel model = builder.build();
    dynamics::SystemState state = dynamics::make_state(model);
    state.bodies[1].p_WB = {1.999 * size, 0.0, 0.0};
    dynamics::ContactStartObserver touches(model);
    std::vector<dynamics::Event> events;
    touches.start(state, events);
    EXPECT_TRUE(touches.is_touching(0));
    return touches.find_tolerance(0, state, 1.0) / size;
  };
  const double one = find_fraction(1.0);
  EXPECT_GT(one, 1e-16);
  EXPECT_LT(one, 1e-12);
  for (const double size : {1e-6, 1e-3, 1e6}) {
    EXPECT_NEAR(find_fraction(size), one, 1e-6 * one) << size;
  }
}

// From rest: the speed grows from step to step.
TEST(FarPairs, TouchOnTimeAfterAFall) {
  for (const double step : {0.2, 0.013, 0.001}) {
    dynamics::SystemBuilder builder;
    builder.set_gravity({0.0, 0.0, -10.0});
    const BodyIndex ball = add_body(builder, "ball");
    builder.add_pair(
        "floor/ball", kWorld, ball,
        make_contact(ContactSide{Shape{HalfSpace{}, {}}, kSteel, kFixed},
                     make_ball(0.1, 1.0), ContactParameters{}));
    const dynamics::SystemModel model = builder.build();
    dynamics::SystemState state = dynamics::make_state(model);
    state.bodies[0].p_WB = {0.0, 0.0, 5.1};
    EXPECT_NEAR(find_touch_time(model, state, 1.0001, step), 1.0, kEarly * step)
        << step;
  }
}

// A ball on an arm of 1 m that turns strikes another one at rest.
TEST(FarPairs, TouchOnTimeWhereOneTurns) {
  for (const double rate : {1.0, 50.0}) {
    for (const double step : {0.05, 0.004}) {  // of a turn's radian
      dynamics::SystemBuilder builder;
      const BodyIndex arm = add_body(builder, "arm");
      builder.add_pair(
          "arm/ball", arm, kWorld,
          make_contact(make_ball(0.02, 1.0, {1.0, 0.0, 0.0}),
                       make_ball(0.02, kFixed), ContactParameters{}));
      dynamics::SystemModel model = builder.build();
      dynamics::SystemState state = dynamics::make_state(model);
      // The other is at 2 rad on the circle about the arm's middle.
      state.bodies[0].p_WB = {-std::cos(2.0), -std::sin(2.0), 0.0};
      state.bodies[0].w_WB_B = {0.0, 0.0, rate};
      const double angle = 2.0 - 2.0 * std::asin(0.5 * 0.04);
      EXPECT_NEAR(rate * find_touch_time(model, state, 2.0 / rate, step / rate),
                  angle, 1e-4 * step / 0.004)
          << rate << " rad/s, steps of " << step;
    }
  }
}

std::shared_ptr<const flexbody::ReducedBody> make_breathing_body(
    double frequency) {
  auto body = std::make_shared<flexbody::ReducedBody>();
  body->name = "bell";
  body->mass = 1.0;
  body->integrals.S0 = 0.1 * Matrix3::Identity();
  body->integrals.S1.assign(1, Matrix3::Zero());
  body->integrals.S2.assign(1, Matrix3::Zero());
  body->integrals.S2[0](2, 2) = 1.0;
  body->integrals.P = Matrix3X::Zero(3, 1);
  body->lambda = VectorX::Constant(1, frequency * frequency);
  body->rows.x_B = Vector3(0.0, 0.0, 0.1);
  body->rows.Phi_B = Vector3::UnitZ();
  body->rows.tags = {1};
  return body;
}

// A surface at rest, whose one mode lifts it by eta: sin(omega t) reaches 0.6.
TEST(FarPairs, TouchOnTimeWhereOneDeforms) {
  constexpr double kOmega = 20.0;
  for (const double step : {0.02, 0.001}) {
    flexbody::ContactSurface surface = test::make_ball_surface(0.1, 2, true);
    test::set_modes(surface,
                    {[](const Vector3&) { return Vector3(0.0, 0.0, 1.0); }});
    dynamics::SystemBuilder builder;
    const BodyIndex bell = builder.add_flexible_body(
        "bell", make_breathing_body(kOmega), dynamics::Fidelity::coupled, {});
    builder.add_pair(
        "bell/ball", bell, kWorld,
        make_contact(
            ContactSide{Shape{std::make_shared<const MeshSurface>(surface), {}},
                        kSteel, 1.0},
            make_ball(0.05, kFixed), ContactParameters{}));
    const dynamics::SystemModel model = builder.build();
    dynamics::SystemState state = dynamics::make_state(model);
    state.bodies[0].p_WB = {0.0, 0.0, -0.75};  // 0.6 m between both
    state.etadot[0] = kOmega;                  // eta = sin(omega t)
    const double expected = std::asin(0.6) / kOmega;
    EXPECT_NEAR(find_touch_time(model, state, 0.1, step), expected, 0.02 * step)
        << step;
  }
}

}  // namespace
}  // namespace limber::contact::far_pairs_test
