// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/monitors/energy_observer.hpp"
#include "unit/contact/body_on_plane.hpp"

/// Bodies with friction that come to rest, or are at rest from the start,
/// against closed forms and conservation.
namespace limber::contact::at_rest_test {
namespace {

using dynamics::IntegratorKind;
using test::BodyOnPlane;
using test::PairScene;

constexpr IntegratorKind kConserving = IntegratorKind::energy_conserving;
constexpr double kFriction = 0.3;
const Box kBlock{{0.05, 0.04, 0.03}};
const Cylinder kRoller{0.03, 0.04};

struct Case {
  double step = 1e-3;
  double side = 1.0;  // sign of the speed
  bool is_first = false;
  Matrix3 R_WF = Matrix3::Identity();
};

const Case kCases[] = {
    {},
    {.step = 2e-3},
    {.step = 4.1e-4},
    {.side = -1.0},
    {.is_first = true},
    {.R_WF = exp_rotation(Vector3(0.4, -1.1, 0.7))},
};

BodyOnPlane make_body(const Case& of, const ShapeKind& shape) {
  return {
      .shape = shape,
      .moments = {8.3e-4, 1.13e-3, 1.37e-3},
      .material = {2e11, 0.3},
      .parameters = {.friction = {.sliding = kFriction}, .restitution = 0.3},
      .R_WF = of.R_WF,
      .is_first = of.is_first};
}

double find_potential(const PairScene& scene) {
  return -scene.model.bodies[0].mass *
         scene.model.gravity_W.dot(scene.state.bodies[0].p_WB);
}

// Runs, and expects rest, and an energy that friction and damping took.
void expect_rest(PairScene& scene, double time, double step) {
  const double before = scene.find_energy().total() + find_potential(scene);
  scene.go(time, step, kConserving);
  EXPECT_LT(scene.body().v_WB_W.norm(), 1e-6);
  EXPECT_LT(scene.body().w_WB_B.norm(), 1e-4);
  EXPECT_LE(scene.find_energy().total() + find_potential(scene), before + 1e-9);
  EXPECT_LT(std::abs(scene.record.energy.drift.value),
            1e-6 * scene.record.energy.throughput);
}

TEST(EnergyConserving, ABoxThatSlidesStopsAfterItsWayAndRests) {
  for (const Case& of : kCases) {
    BodyOnPlane box = make_body(of, kBlock);
    box.p_F = {0.0, 0.0, 0.03};
    box.v_F = {of.side, 0.0, 0.0};
    PairScene scene = box.make();
    expect_rest(scene, 0.8, of.step);
    const Vector3 p_F = of.R_WF.transpose() * scene.body().p_WB;
    const double way = 0.5 / (kFriction * BodyOnPlane::kGravity);
    EXPECT_NEAR(of.side * p_F.x(), way, 2e-3 * way);
    EXPECT_NEAR(p_F.y(), 0.0, 1e-6);
  }
}

TEST(EnergyConserving, ABoxThatFallsFlatComesToRest) {
  for (const Case& of : kCases) {
    BodyOnPlane box = make_body(of, kBlock);
    box.p_F = {0.0, 0.0, 0.035};
    PairScene scene = box.make();
    expect_rest(scene, 0.3, of.step);
  }
}

TEST(EnergyConserving, ABoxOnASlopeBelowFrictionStaysThere) {
  for (const Case& of : kCases) {
    BodyOnPlane box = make_body(of, kBlock);
    box.slope = of.side * 0.2;  // tan 0.2 < 0.3
    box.p_F = {0.0, 0.0, 0.03};
    PairScene scene = box.make();
    expect_rest(scene, 0.3, of.step);
    EXPECT_LT((of.R_WF.transpose() * scene.body().p_WB - box.p_F).norm(), 1e-6);
  }
}

TEST(EnergyConserving, ACylinderThatFallsOnItsEndComesToRest) {
  for (const Case& of : kCases) {
    BodyOnPlane cylinder = make_body(of, kRoller);
    cylinder.p_F = {0.0, 0.0, 0.042};
    PairScene scene = cylinder.make();
    expect_rest(scene, 0.3, of.step);
  }
}

// A thin steel plate, whose contact vibrates a hundred times in a step.
constexpr double kPlateMass = 0.3;  // [kg]

BodyOnPlane make_plate(const Case& of) {
  return {
      .shape = Box{{0.15, 0.1, 0.001}},
      .mass = kPlateMass,
      .moments = {1e-3, 2.25e-3, 3.25e-3},
      .material = {70e9, 0.3},
      .parameters = {.friction = {.sliding = kFriction}, .restitution = 0.3},
      .p_F = {0.0, 0.0, 0.001},
      .R_WF = of.R_WF,
      .is_first = of.is_first};
}

// The force of a weight that is put on a spring: at most twice the weight.
void expect_no_impact(const PairScene& scene) {
  const double weight = kPlateMass * BodyOnPlane::kGravity;
  EXPECT_TRUE(scene.statistics.warnings.empty())
      << scene.statistics.warnings.front();
  ASSERT_FALSE(scene.record.contacts.empty());
  for (const dynamics::ContactRecord& contact : scene.record.contacts) {
    EXPECT_LE(contact.peak_force, 2.01 * weight);
  }
  const dynamics::ContactRecord& last = scene.record.contacts.back();
  EXPECT_FALSE(last.has_parted);
}

TEST(AThinPlate, ThatLiesOnAPlaneCarriesNoMoreThanTwiceItsWeight) {
  for (const Case& of : kCases) {
    PairScene scene = make_plate(of).make();
    scene.go(0.1, of.step);
    expect_no_impact(scene);
    EXPECT_NEAR(scene.record.contacts.back().impulse,
                kPlateMass * BodyOnPlane::kGravity * 0.1,
                kPlateMass * BodyOnPlane::kGravity * of.step);
    EXPECT_LT(scene.body().v_WB_W.norm(), 1e-6);
  }
}

TEST(AThinPlate, ThatSlidesCarriesNoMoreThanTwiceItsWeight) {
  for (const Case& of : kCases) {
    BodyOnPlane plate = make_plate(of);
    plate.v_F = {of.side, 0.0, 0.0};
    PairScene scene = plate.make();
    scene.go(0.5, of.step);
    expect_no_impact(scene);
    const double way = 0.5 / (kFriction * BodyOnPlane::kGravity);
    EXPECT_NEAR(of.side * (of.R_WF.transpose() * scene.body().p_WB).x(), way,
                5e-3 * way);
  }
}

// A speed of 1e-4 m/s that nothing explains is all the energy there is of a
// plate that floats, and little beside a fall within a step of one that rests.
TEST(AThinPlate, IsAuditedAgainstAFallWithinAStepWhereItTouches) {
  const Case of;
  for (const double gap : {1e-9, -1e-9}) {
    BodyOnPlane plate = make_plate(of);
    plate.p_F.z() += gap;
    PairScene scene = plate.make();
    dynamics::EnergyObserver observer(
        scene.model, IntegratorKind::generalized_alpha, of.step);
    dynamics::SystemTerms terms = dynamics::make_terms(scene.model);
    calc_terms(scene.model, scene.state, Side::right, terms);
    observer.start(scene.state, terms);
    scene.state.t = of.step;
    scene.body().v_WB_W.z() = 1e-4;
    calc_terms(scene.model, scene.state, Side::right, terms);
    observer.add(scene.state, terms, dynamics::make_flows(scene.model));
    const dynamics::EnergyRecord record = observer.find_record(
        VectorX::Zero(dynamics::EnergyRows(scene.model).count));
    const double fall = BodyOnPlane::kGravity * of.step;
    const double fraction = find_unbalanced_fraction(record.worst);
    if (gap > 0.0) {
      EXPECT_GT(fraction, 0.9);
    } else {
      EXPECT_NEAR(fraction, 1e-8 / (fall * fall), 1e-9);
    }
  }
}

}  // namespace
}  // namespace limber::contact::at_rest_test
