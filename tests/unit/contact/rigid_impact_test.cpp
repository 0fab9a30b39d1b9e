// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/analysis/linear_system.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

/// Impacts and rest of rigid bodies, against closed forms.
namespace limber::contact::rigid_impact_test {
namespace {

using dynamics::IntegratorKind;
using dynamics::kWorld;
using dynamics::RunRecord;
using dynamics::SimulationSettings;
using dynamics::SimulationStatistics;
using dynamics::SystemBuilder;
using dynamics::SystemModel;
using dynamics::SystemState;

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SurfaceMaterial kSteel{2.1e11, 0.3};
constexpr double kDensity = 7800.0;  // [kg/m^3]
constexpr double kRadius = 0.01;     // [m]
constexpr double kMass =
    4.0 / 3.0 * kPi * kRadius * kRadius * kRadius * kDensity;  // [kg]

struct Scene {
  SystemModel model;
  SystemState state;
};

dynamics::RigidInertia ball_inertia() {
  return {kMass, 0.4 * kMass * kRadius * kRadius * Matrix3::Identity()};
}

ContactSide ball_side() { return {Shape{Sphere{kRadius}, {}}, kSteel, kMass}; }

ContactSide floor_side(const Matrix3& R = Matrix3::Identity()) {
  return {Shape{HalfSpace{}, {R, Vector3::Zero()}}, kSteel, kInfinity};
}

// A ball that flies against the floor, z upwards.
Scene make_ball_and_floor(const ContactParameters& parameters, double gap,
                          const Vector3& velocity) {
  SystemBuilder builder;
  const auto ball = builder.add_rigid_body("ball", ball_inertia());
  builder.add_pair("floor/ball", kWorld, ball,
                   make_contact(floor_side(), ball_side(), parameters));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB = {0.1, 0.2, kRadius + gap};
  scene.state.bodies[0].v_WB_W = velocity;
  return scene;
}

// Two balls that fly against each other, obliquely in the world's axes.
Scene make_two_balls(const ContactParameters& parameters, double speed) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", ball_inertia());
  const auto b = builder.add_rigid_body("b", ball_inertia());
  builder.add_pair("a/b", a, b,
                   make_contact(ball_side(), ball_side(), parameters));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  const Vector3 way = Vector3(1.0, -2.0, 0.5).normalized();
  scene.state.bodies[1].p_WB = (2.0 * kRadius + 1e-3) * way;
  scene.state.bodies[0].v_WB_W = speed * way;
  return scene;
}

RunRecord run(Scene& scene, const SimulationSettings& settings,
              SimulationStatistics* costs = nullptr) {
  SimulationStatistics statistics;
  RunRecord record;
  simulate(scene.model, scene.state, settings, {}, {}, statistics, {}, {},
           record);
  if (costs != nullptr) *costs = statistics;
  return record;
}

// Hertz's impact of a mass on a stiffness k d^1.5 [@johnson1985, ch. 11].
struct ClosedForm {
  double depth, force, duration;
};
ClosedForm find_closed_form(double mass, double radius, double speed) {
  const double modulus =
      1.0 / (2.0 * (1.0 - kSteel.poisson_ratio * kSteel.poisson_ratio) /
             kSteel.youngs_modulus);
  const double k = 4.0 / 3.0 * modulus * std::sqrt(radius);
  const double depth = std::pow(1.25 * mass * speed * speed / k, 0.4);
  return {depth, k * std::pow(depth, 1.5), 2.9432 * depth / speed};
}

TEST(RigidImpact, OfABallAndAHalfSpaceIsHertzsImpact) {
  const ClosedForm exact = find_closed_form(kMass, kRadius, 1.0);
  Scene scene = make_ball_and_floor({}, 1e-4, {0.0, 0.0, -1.0});
  const RunRecord record =
      run(scene, {.end_time = 4e-4, .step = exact.duration / 100.0});
  ASSERT_EQ(record.contacts.size(), 1U);
  const dynamics::ContactRecord& contact = record.contacts[0];
  EXPECT_EQ(contact.touches, 1);
  EXPECT_NEAR(contact.time, 1e-4, 1e-3 * exact.duration);
  EXPECT_NEAR(contact.peak_force / exact.force, 1.0, 5e-3);
  EXPECT_NEAR(contact.peak_depth / exact.depth, 1.0, 5e-3);
  EXPECT_NEAR(contact.peak_depth_over_radius / (exact.depth / kRadius), 1.0,
              5e-3);
  EXPECT_NEAR(contact.duration / exact.duration, 1.0, 5e-3);
  EXPECT_NEAR(contact.impact_duration / exact.duration, 1.0, 1e-3);
  EXPECT_NEAR(contact.impulse / (2.0 * kMass), 1.0, 1e-3);
  ASSERT_TRUE(contact.restitution().has_value());
  EXPECT_NEAR(*contact.restitution(), 1.0, 1e-3);
}

// Below and above the speed at which the energy is enough for a tenth of the
// ball's radius. @param radius of curvature
void expect_warning_of_depth(const ContactParameters& parameters, double radius,
                             const std::string& words) {
  const ClosedForm unit = find_closed_form(kMass, radius, 1.0);
  const double k = unit.force / std::pow(unit.depth, 1.5);
  const double speed =
      std::sqrt(0.8 * k * std::pow(0.1 * kRadius, 2.5) / kMass);
  for (const double fraction : {0.9, 1.1}) {
    const double v = fraction * speed;
    const ClosedForm exact = find_closed_form(kMass, radius, v);
    Scene scene = make_ball_and_floor(parameters, 1e-4, {0.0, 0.0, -v});
    SimulationStatistics statistics;
    run(scene,
        {.end_time = 2.0 * exact.duration + 1e-4 / v,
         .step = exact.duration / 100.0},
        &statistics);
    const auto is_deep = [&words](const std::string& text) {
      return text.find(words) != std::string::npos;
    };
    EXPECT_EQ(std::any_of(statistics.warnings.begin(),
                          statistics.warnings.end(), is_deep),
              fraction > 1.0);
  }
}

TEST(RigidImpact, DeeperThanATenthOfTheRadiusIsWarnedOf) {
  expect_warning_of_depth({}, kRadius, "of the radius of curvature");
}

// A radius of the contact's own makes it stiffer, and leaves the ball round.
TEST(RigidImpact, OfAStifferBallIsWarnedOfAtTheSameDepth) {
  const double flat = 100.0 * kRadius;
  expect_warning_of_depth({.radius = flat}, flat, "of the radius of curvature");
}

// Few steps an impact, which are not damped; at any phase of the touch.
TEST(RigidImpact, GainsNoEnergyInStepsThatResolveItBadly) {
  const double lasts = find_closed_form(kMass, kRadius, 1.0).duration;
  for (const double steps : {4.1, 4.6, 5.3, 6.1, 7.0, 7.9, 9.0}) {
    for (const double gap : {1e-6, 1.7e-6, 3.1e-6}) {
      Scene scene =
          make_ball_and_floor({.restitution = 1.0}, gap, {0.0, 0.0, -1.0});
      const RunRecord record =
          run(scene, {.end_time = 2.0 * lasts, .step = lasts / steps});
      ASSERT_EQ(record.contacts.size(), 1U);
      EXPECT_LT(record.energy.stored.value, 1.005 * 0.5 * kMass) << steps;
    }
  }
}

TEST(RigidImpact, ThatBeginsWhereAStepEndsTouchesOnce) {
  for (const double gap : {1e-6, 5e-7, 2e-6}) {
    Scene scene =
        make_ball_and_floor({.restitution = 1.0}, gap, {0.0, 0.0, -1.0});
    const RunRecord record = run(scene, {.end_time = 1e-4, .step = 2.5e-7});
    ASSERT_EQ(record.contacts.size(), 1U);
    EXPECT_EQ(record.contacts[0].touches, 1);
  }
}

TEST(RigidImpact, OfTwoBallsIsHertzsImpactAndKeepsMomentum) {
  const ClosedForm exact = find_closed_form(0.5 * kMass, 0.5 * kRadius, 2.0);
  Scene scene = make_two_balls({}, 2.0);
  const Vector3 before = kMass * scene.state.bodies[0].v_WB_W;
  const RunRecord record =
      run(scene, {.end_time = 1e-3, .step = exact.duration / 100.0});
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_NEAR(record.contacts[0].peak_force / exact.force, 1.0, 5e-3);
  EXPECT_NEAR(record.contacts[0].duration / exact.duration, 1.0, 5e-3);
  const auto& bodies = scene.state.bodies;
  const Vector3 after = kMass * (bodies[0].v_WB_W + bodies[1].v_WB_W);
  EXPECT_LT((after - before).norm(), 1e-12 * before.norm());
  EXPECT_LT(bodies[0].v_WB_W.norm(), 2e-3);  // the other has all
}

TEST(RigidImpact, PartsAtItsRestitution) {
  for (const double e : {0.9, 0.7, 0.5, 0.3, 0.1}) {
    const ClosedForm exact = find_closed_form(kMass, kRadius, 1.0);
    Scene scene =
        make_ball_and_floor({.restitution = e}, 1e-4, {0.0, 0.0, -1.0});
    const RunRecord record =
        run(scene, {.end_time = 6e-4, .step = exact.duration / 200.0});
    ASSERT_EQ(record.contacts.size(), 1U) << e;
    ASSERT_TRUE(record.contacts[0].restitution().has_value()) << e;
    EXPECT_NEAR(*record.contacts[0].restitution(), e, 3e-3) << e;
    EXPECT_NEAR(record.contacts[0].impulse / (kMass * (1.0 + e)), 1.0, 3e-3)
        << e;
  }
}

// A ball of 1 mm on one of the same size flies 100 mm a step.
TEST(RigidImpact, IsNotMissedByAStepThatPassesThrough) {
  Scene scene = make_two_balls({}, 100.0);
  SimulationStatistics costs;
  const RunRecord record = run(scene, {.end_time = 0.01, .step = 1e-3}, &costs);
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_NEAR(record.contacts[0].time, 1e-5, 2e-7);
  // Elastic, between two of one mass.
  EXPECT_NEAR(record.contacts[0].impulse / (kMass * 100.0), 1.0, 0.01);
}

TEST(RigidImpact, NeverGivesEnergyAtAnyStep) {
  for (const double step : {1e-6, 1e-5, 1e-4, 1e-3}) {
    Scene scene = make_two_balls({.restitution = 0.8}, 3.0);
    const double before = calc_energy(scene.model, scene.state).total();
    run(scene, {.end_time = 0.01, .step = step});
    EXPECT_LT(calc_energy(scene.model, scene.state).total(), 1.005 * before)
        << step;
  }
}

TEST(RigidImpact, KeepsEnergyWithTheEnergyConservingScheme) {
  for (const double step : {1e-6, 1e-5, 1e-4}) {
    Scene scene = make_two_balls({}, 3.0);
    const double before = calc_energy(scene.model, scene.state).total();
    run(scene, {.integrator = IntegratorKind::energy_conserving,
                .end_time = 0.01,
                .step = step});
    EXPECT_NEAR(calc_energy(scene.model, scene.state).total() / before, 1.0,
                1e-9)
        << step;
  }
}

TEST(RigidImpact, TakesStepsOfItsOwnToATolerance) {
  const ClosedForm exact = find_closed_form(kMass, kRadius, 1.0);
  Scene scene = make_ball_and_floor({}, 0.05, {0.0, 0.0, -1.0});
  SimulationStatistics costs;
  const RunRecord record =
      run(scene, {.end_time = 0.1, .step = 0.01, .tolerance = 1e-6}, &costs);
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_NEAR(record.contacts[0].peak_force / exact.force, 1.0, 0.01);
  EXPECT_NEAR(*record.contacts[0].restitution(), 1.0, 3e-3);
  EXPECT_LT(costs.steps, 400);
}

// A ball on a slope: it rolls without slip at 5/7 of g sin(slope).
TEST(RigidImpact, LetsABallRollAtFiveSevenths) {
  const double slope = 10.0 * kPi / 180.0;
  Scene scene = make_ball_and_floor(
      {.friction = {.sliding = 0.3}, .restitution = 0.1}, 0.0, Vector3::Zero());
  scene.model.gravity_W =
      9.81 * Vector3(std::sin(slope), 0.0, -std::cos(slope));
  run(scene, {.end_time = 0.5, .step = 1e-3});
  const double v = 5.0 / 7.0 * 9.81 * std::sin(slope) * 0.5;
  const dynamics::BodyState& ball = scene.state.bodies[0];
  EXPECT_NEAR(ball.v_WB_W.x() / v, 1.0, 2e-3);
  EXPECT_NEAR((ball.quat_WB * ball.w_WB_B).y() * kRadius / v, 1.0, 2e-3);
}

// Bowling: it slides and rolls after 2 v / (7 mu g) at 5/7 v.
TEST(RigidImpact, LetsASlidingBallEndRollingAtFiveSeventhsOfItsSpeed) {
  Scene scene = make_ball_and_floor(
      {.friction = {.sliding = 0.3}, .restitution = 0.1}, 0.0, {1.0, 0.0, 0.0});
  scene.model.gravity_W = {0.0, 0.0, -9.81};
  run(scene, {.end_time = 0.3, .step = 1e-4});
  EXPECT_NEAR(scene.state.bodies[0].v_WB_W.x(), 5.0 / 7.0, 2e-3);
}

// So soft a ball that it sinks in by a third of its radius: friction acts well
// above its lowest point, and does work on the motion there.
TEST(RigidImpact, BalancesTheWorkOfFrictionHoweverFarASpinningBallSinksIn) {
  Scene scene = make_ball_and_floor(
      {.friction = {.sliding = 0.3}, .restitution = 0.7, .stiffness = 3e4},
      1e-5, {0.3, 0.0, -1.0});
  scene.state.bodies[0].w_WB_B = {0.0, -50.0, 20.0};
  const RunRecord record = run(scene, {.end_time = 0.02, .step = 1e-5});
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_TRUE(record.contacts[0].restitution().has_value());
  const double throughput = record.energy.stored.value;
  EXPECT_LT(std::abs(record.energy.drift.value), 5e-4 * throughput);
}

// Its corners touch at once, and are damped alike.
TEST(RigidImpact, LetsABoxThatLandsFlatNeitherTurnNorSlide) {
  SystemBuilder builder;
  const Matrix3 inertia = Vector3(1e-3, 2e-3, 2.5e-3).asDiagonal();
  const auto box = builder.add_rigid_body("box", {1.0, inertia});
  builder.add_pair(
      "floor/box", kWorld, box,
      make_contact(floor_side(),
                   {Shape{Box{{0.05, 0.04, 0.03}}, {}}, kSteel, 1.0, inertia},
                   {.friction = {.sliding = 0.3}, .restitution = 0.5}));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB.z() = 0.031;
  scene.state.bodies[0].v_WB_W.z() = -1.0;
  const RunRecord record = run(scene, {.end_time = 2e-3, .step = 2e-6});
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_NEAR(*record.contacts[0].restitution(), 0.5, 3e-3);
  const dynamics::BodyState& after = scene.state.bodies[0];
  EXPECT_LT(after.w_WB_B.norm(), 1e-9);
  EXPECT_LT(after.p_WB.head<2>().norm(), 1e-12);
}

// On its rim, 30 degrees off, without friction: only the normal impulse at the
// rim acts, and its point parts with e times its approach.
TEST(RigidImpact, LetsACylinderLeapOffItsRimAsRestitutionSays) {
  const double mass = 1.0;
  const double inertia = 1e-3;
  const Matrix3 inertias = inertia * Matrix3::Identity();
  SystemBuilder builder;
  const auto rod = builder.add_rigid_body("rod", {mass, inertias});
  builder.add_pair(
      "table/rod", kWorld, rod,
      make_contact({Shape{Box{{0.5, 0.5, 0.1}},
                          Pose{Matrix3::Identity(), {0.0, 0.0, -0.1}}},
                    kSteel, kInfinity},
                   {Shape{Cylinder{0.03, 0.05}, {}}, kSteel, mass, inertias},
                   {.restitution = 0.5}));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  dynamics::BodyState& body = scene.state.bodies[0];
  const double tilt = kPi / 6.0;
  body.quat_WB = Quaternion(Eigen::AngleAxisd(tilt, Vector3::UnitY()));
  const double lowest = 0.05 * std::cos(tilt) + 0.03 * std::sin(tilt);
  const double arm = 0.03 * std::cos(tilt) - 0.05 * std::sin(tilt);
  body.p_WB.z() = lowest + 1e-6;
  body.v_WB_W.z() = -1.0;
  const RunRecord record = run(scene, {.end_time = 4e-4, .step = 2e-7});
  ASSERT_EQ(record.contacts.size(), 1U);
  EXPECT_EQ(record.contacts[0].touches, 1);
  EXPECT_NEAR(*record.contacts[0].restitution(), 0.5, 3e-3);
  // J = (1 + e) v / (1/m + arm^2 / I)
  const double impulse = 1.5 / (1.0 / mass + arm * arm / inertia);
  EXPECT_NEAR(record.contacts[0].impulse / impulse, 1.0, 3e-3);
  EXPECT_NEAR(scene.state.bodies[0].v_WB_W.z(), impulse / mass - 1.0, 3e-3);
}

// A block of 1 kg on a slope of 10 degrees, held by mu = 0.3, with a force down
// the slope of 20 Hz.
Scene make_block_on_slope(double amplitude) {
  const Vector3 half(0.05, 0.04, 0.03);
  const double mass = 1.0;
  const double slope = 10.0 * kPi / 180.0;
  const Vector3 squares = half.cwiseProduct(half);
  const Matrix3 inertia =
      mass / 3.0 *
      Vector3(squares.y() + squares.z(), squares.x() + squares.z(),
              squares.x() + squares.y())
          .asDiagonal()
          .toDenseMatrix();
  SystemBuilder builder;
  const auto block = builder.add_rigid_body("block", {mass, inertia});
  builder.add_pair(
      "floor/block", kWorld, block,
      make_contact(floor_side(), {Shape{Box{half}, {}}, kSteel, mass, inertia},
                   {.friction = {.sliding = 0.3}, .restitution = 0.1}));
  builder.set_gravity(9.81 * Vector3(std::sin(slope), 0.0, -std::cos(slope)));
  if (amplitude > 0.0) {
    builder.add_load("shake", builder.attach_frame("middle", block, {}),
                     {amplitude, 0.0, 0.0}, Vector3::Zero(),
                     dynamics::LoadFrame::world,
                     dynamics::Sinusoid{.frequency = 20.0});
  }
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB.z() = half.z();
  return scene;
}

TEST(RigidImpact, HoldsABlockOnASlope) {
  Scene scene = make_block_on_slope(0.0);
  run(scene, {.end_time = 1.0, .step = 1e-3});
  const Vector3 after_one = scene.state.bodies[0].p_WB;
  EXPECT_LT(after_one.head<2>().norm(), 3e-6);
  run(scene, {.end_time = 10.0, .step = 1e-3});
  const Vector3 after_ten = scene.state.bodies[0].p_WB;
  EXPECT_LT((after_ten - after_one).norm(), 1e-9);
}

// By half of what would let it slip: 0.5 (mu cos - sin) m g. Regularised laws
// creep by millimetres.
TEST(RigidImpact, HoldsABlockOnASlopeThatIsShaken) {
  const double slope = 10.0 * kPi / 180.0;
  const double amplitude =
      0.5 * 9.81 * (0.3 * std::cos(slope) - std::sin(slope));
  Scene scene = make_block_on_slope(amplitude);
  run(scene, {.end_time = 1.0, .step = 1e-3});
  const Vector3 after_one = scene.state.bodies[0].p_WB;
  EXPECT_LT(after_one.head<2>().norm(), 3e-6);
  run(scene, {.end_time = 10.0, .step = 1e-3});  // 180 periods later
  const Vector3 after_ten = scene.state.bodies[0].p_WB;
  EXPECT_LT((after_ten - after_one).norm(), 1e-9);
}

// A contact that opens, slips or rolls has no linear model.
TEST(RigidImpact, HasALinearModelOnlyWhileBodiesAreApart) {
  for (const double gap : {1e-6, -1e-6}) {
    const Scene scene = make_ball_and_floor({}, gap, Vector3::Zero());
    std::string refusal;
    try {
      EXPECT_EQ(dynamics::linearise(scene.model, scene.state).free, 6);
    } catch (const InputError& error) {
      refusal = error.what();
    }
    if (gap > 0.0) {
      EXPECT_EQ(refusal, "");
    } else {
      EXPECT_THAT(refusal,
                  ::testing::HasSubstr("the world and 'ball' are in contact"));
    }
  }
}

}  // namespace
}  // namespace limber::contact::rigid_impact_test
