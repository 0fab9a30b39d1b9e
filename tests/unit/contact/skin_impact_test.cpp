// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/contact/contact_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Impacts of bodies whose surfaces are meshes.
namespace limber::contact::skin_impact_test {
namespace {

using dynamics::RunRecord;

constexpr SurfaceMaterial kSteel{2.1e11, 0.3};
constexpr double kRadius = 0.01;  // [m]
constexpr double kMass = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius *
                         kRadius * 7800.0;  // [kg]

Shape make_ball() {
  return {
      std::make_shared<const Skin>(test::make_ball_surface(kRadius, 3, true)),
      {}};
}

Shape make_cube() {
  return {std::make_shared<const Skin>(
              test::make_box_surface(Vector3::Constant(kRadius), 3, false)),
          {}};
}

struct Pair {
  dynamics::SystemModel model;
  dynamics::SystemState state;

  // B flies against A.
  Pair(const Shape& A, const Shape& B, const ContactParameters& parameters,
       const Vector3& way, double speed) {
    dynamics::SystemBuilder builder;
    const dynamics::RigidInertia inertia{
        kMass, 0.4 * kMass * kRadius * kRadius * Matrix3::Identity()};
    const auto a = builder.add_rigid_body("a", inertia);
    const auto b = builder.add_rigid_body("b", inertia);
    builder.add_pair(
        "a/b", a, b,
        std::make_shared<ContactPair>(
            ContactSide{A, kSteel, kMass, inertia.inertia},
            ContactSide{B, kSteel, kMass, inertia.inertia}, parameters));
    model = builder.build();
    state = dynamics::make_state(model);
    state.bodies[1].p_WB = way;
    state.bodies[1].v_WB_W = -speed * way.normalized();
  }

  dynamics::SimulationStatistics statistics = {};

  RunRecord run(double time, double step) {
    RunRecord record;
    simulate(model, state, {.end_time = time, .step = step}, {}, {}, statistics,
             {}, {}, record);
    return record;
  }

  [[nodiscard]] Vector3 find_momentum() const {
    return kMass * (state.bodies[0].v_WB_W + state.bodies[1].v_WB_W);
  }
  [[nodiscard]] Vector3 find_spin() const {
    Vector3 sum = Vector3::Zero();
    for (const auto& body : state.bodies) {
      sum += kMass * body.p_WB.cross(body.v_WB_W) +
             0.4 * kMass * kRadius * kRadius * (body.quat_WB * body.w_WB_B);
    }
    return sum;
  }
};

// Hertz's impact [@johnson1985, ch. 11], of faces that leave the balls by
// 1e-5 of their radius; the depth is 1e-3 of it.
TEST(SkinImpact, OfTwoMeshedBallsIsHertzs) {
  const double modulus = 2.1e11 / (2.0 * (1.0 - 0.09));
  const double k = 4.0 / 3.0 * modulus * std::sqrt(0.5 * kRadius);
  const double depth = std::pow(1.25 * 0.5 * kMass / k, 0.4);
  const double force = k * std::pow(depth, 1.5);
  const double duration = 2.9432 * depth;
  const Vector3 way = Vector3(0.3, -0.5, 0.7).normalized();
  Pair pair(make_ball(), make_ball(), {}, (2.0 * kRadius + 1e-5) * way, 1.0);
  const double before = calc_energy(pair.model, pair.state).total();
  const Vector3 momentum = pair.find_momentum();
  const RunRecord record = pair.run(8e-5, duration / 100.0);
  ASSERT_EQ(record.contacts.size(), 1U);
  const auto& contact = record.contacts[0];
  EXPECT_EQ(contact.touches, 1);
  EXPECT_NEAR(contact.peak_force / force, 1.0, 5e-3);
  EXPECT_NEAR(contact.peak_depth / depth, 1.0, 5e-3);
  EXPECT_NEAR(contact.duration / duration, 1.0, 5e-3);
  EXPECT_NEAR(*contact.restitution(), 1.0, 3e-3);
  EXPECT_LT((pair.find_momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_NEAR(calc_energy(pair.model, pair.state).total() / before, 1.0, 5e-3);
}

TEST(SkinImpact, OfAMeshedBallIsThatOfASphere) {
  const Shape sphere{Sphere{kRadius}, {}};
  const Vector3 start(1e-3, 2e-3, 2.0 * kRadius);
  const auto strike = [&](const Shape& ball) {
    Pair pair(make_cube(), ball, {.restitution = 0.6}, start, 0.5);
    pair.state.bodies[1].v_WB_W = Vector3(0.0, 0.0, -0.5);
    return pair.run(1.2e-4, 2e-7).contacts.at(0);
  };
  const auto meshed = strike(make_ball());
  const auto exact = strike(sphere);
  EXPECT_NEAR(meshed.peak_force / exact.peak_force, 1.0, 5e-3);
  EXPECT_NEAR(meshed.impulse / exact.impulse, 1.0, 2e-3);
  EXPECT_NEAR(meshed.duration / exact.duration, 1.0, 5e-3);
  EXPECT_NEAR(*meshed.restitution(), *exact.restitution(), 5e-3);
}

// Without a word it would be a contact that is missed.
TEST(SkinImpact, OfAnOpenSurfaceFromBehindIsTold) {
  const Shape sheet{
      std::make_shared<const Skin>(test::make_sheet_surface(
          3.0 * kRadius, 4, false, [](double, double) { return 0.0; })),
      {}};
  const auto strike = [&](double side, double step) {
    Pair pair(sheet, make_ball(), {}, Vector3(0.0, 0.0, 1.05 * side * kRadius),
              1.0);
    const RunRecord record = pair.run(2e-3, step);
    EXPECT_FALSE(record.contacts.empty()) << side;
    EXPECT_EQ(record.contacts.at(0).peak_force > 0.0, side > 0.0);
    const auto& warnings = pair.statistics.warnings;
    return std::count_if(
        warnings.begin(), warnings.end(), [](const std::string& warning) {
          return warning.find("do not face each other") != std::string::npos;
        });
  };
  EXPECT_EQ(strike(1.0, 1e-6), 0);
  EXPECT_EQ(strike(-1.0, 5e-4), 1);
}

// Corners, edges and faces, with friction.
TEST(SkinImpact, OfTumblingCubesGainsNoEnergyAndKeepsMomenta) {
  constexpr double kSpeed = 5.0;  // [m/s]
  for (int trial = 0; trial < 2; ++trial) {
    Pair pair(make_cube(), make_cube(),
              {.friction = {.sliding = 0.3}, .restitution = 0.7},
              Vector3(0.3e-3 * trial, 4e-3, 3.6e-2), kSpeed);
    pair.state.bodies[0].quat_WB =
        Quaternion(exp_rotation(0.3 * Vector3(trial, 1.0, -trial)));
    pair.state.bodies[1].quat_WB =
        Quaternion(exp_rotation(0.7 * Vector3(1.0, trial, 0.5)));
    pair.state.bodies[1].w_WB_B = Vector3(10.0, -5.0, 3.0);
    const double before = calc_energy(pair.model, pair.state).total();
    const Vector3 momentum = pair.find_momentum();
    const Vector3 spin = pair.find_spin();
    const RunRecord record = pair.run(5e-3, 1e-5);
    EXPECT_FALSE(record.contacts.empty()) << trial;
    EXPECT_LT(calc_energy(pair.model, pair.state).total(), 1.005 * before)
        << trial;
    EXPECT_LT((pair.find_momentum() - momentum).norm(),
              1e-12 * momentum.norm());
    // Of the order of the steps, which do not resolve the impact.
    EXPECT_LT((pair.find_spin() - spin).norm(), 1e-3 * kMass * kSpeed * kRadius)
        << trial;
  }
}

}  // namespace
}  // namespace limber::contact::skin_impact_test
