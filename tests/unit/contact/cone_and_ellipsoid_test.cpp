// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/pair_scene.hpp"

/// Runs of cones and ellipsoids: bounces, balls as ellipsoids, energy and
/// momentum.
namespace limber::contact::cone_and_ellipsoid_test {
namespace {

using dynamics::IntegratorKind;
using test::PairScene;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMass = 0.5;  // [kg]
constexpr SurfaceMaterial kSteel{2e11, 0.3};
constexpr SurfaceMaterial kSoft{1e8, 0.3};
const Vector3 kMoments(3e-4, 4e-4, 5e-4);  // [kg m^2]

ContactSide make_side(const Shape& shape, const SurfaceMaterial& material) {
  if (std::holds_alternative<HalfSpace>(shape.kind)) {
    return {shape, material, kInfinity};
  }
  return {shape, material, kMass, kMoments.asDiagonal()};
}

/// A body above a floor, or another one that is free.
PairScene make_scene(const Shape& body, const Shape& other,
                     const ContactParameters& parameters, double gravity = 0.0,
                     const SurfaceMaterial& material = kSoft) {
  dynamics::SystemBuilder builder;
  const Matrix3 inertia = kMoments.asDiagonal();
  const auto A = builder.add_rigid_body("A", {kMass, inertia});
  const auto B = std::holds_alternative<HalfSpace>(other.kind)
                     ? dynamics::kWorld
                     : builder.add_rigid_body("B", {kMass, inertia});
  builder.add_pair("A/B", A, B,
                   make_contact(make_side(body, material),
                                make_side(other, material), parameters));
  builder.set_gravity({0.0, 0.0, -gravity});
  PairScene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  return scene;
}

/// A shape that stands on its lowest point, straight below its centre.
struct Standing {
  std::string name;
  Shape shape;
  double height = 0.0;  // of its centre [m]
};

std::vector<Standing> list_standing() {
  const Matrix3 over = exp_rotation(Vector3(0.0, std::acos(-1.0), 0.0));
  const Matrix3 aside = exp_rotation(Vector3(0.5 * std::acos(-1.0), 0.0, 0.0));
  const Ellipsoid egg{Vector3(0.03, 0.04, 0.05)};
  return {{"tip", {Cone{0.08, 0.03}, {over, Vector3::Zero()}}, 0.03},
          {"disc", {Cone{0.04, 0.03}, {}}, 0.03},
          {"end", {egg, {}}, 0.05},
          {"side", {egg, {aside, Vector3::Zero()}}, 0.04}};
}

// The second one, too, at 0.8 of the speed.
TEST(ConeAndEllipsoid, BounceAsTheirRestitutionSays) {
  for (const Standing& body : list_standing()) {
    SCOPED_TRACE(body.name);
    PairScene scene = make_scene(body.shape, {HalfSpace{}, {}},
                                 {.restitution = 0.8}, 9.81, kSteel);
    scene.body().p_WB.z() = body.height + 0.02;
    scene.go(0.25, 2e-5);
    ASSERT_GE(scene.record.contacts.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const dynamics::ContactRecord& bounce = scene.record.contacts[i];
      ASSERT_TRUE(bounce.restitution().has_value());
      EXPECT_NEAR(*bounce.restitution(), 0.8, 4e-3) << i;
      EXPECT_NEAR(bounce.touch_speed,
                  std::pow(0.8, double(i)) * std::sqrt(0.04 * 9.81), 5e-3);
    }
  }
}

// Falls on a plane and rolls, strikes a box's edge, a capsule and a cone.
TEST(ConeAndEllipsoid, OfABallIsThatOfAnEllipsoidOfEqualRadii) {
  const Sphere ball{0.03};
  const Ellipsoid same{Vector3::Constant(0.03)};
  const std::vector<Shape> others{{HalfSpace{}, {}},
                                  {Box{Vector3(0.03, 0.02, 0.04)}, {}},
                                  {Capsule{0.02, 0.05}, {}},
                                  {Sphere{0.04}, {}},
                                  {Cone{0.04, 0.05}, {}}};
  for (const Shape& other : others) {
    const auto run = [&](const ShapeKind& kind) {
      PairScene scene =
          make_scene({kind, {}}, other,
                     {.friction = {.sliding = 0.3}, .restitution = 0.7});
      scene.body().p_WB = Vector3(0.015, 0.01, 0.12);
      scene.body().v_WB_W = Vector3(0.3, 0.1, -2.0);
      scene.body().w_WB_B = Vector3(3.0, -2.0, 5.0);
      scene.go(0.08, 1e-4);
      EXPECT_FALSE(scene.record.contacts.empty());
      return scene.body();
    };
    const dynamics::BodyState one = run(ball);
    const dynamics::BodyState two = run(same);
    EXPECT_LT((one.v_WB_W - two.v_WB_W).norm(), 1e-6) << other.kind.index();
    EXPECT_LT((one.w_WB_B - two.w_WB_B).norm(), 1e-4) << other.kind.index();
  }
}

TEST(ConeAndEllipsoid, NeitherGainEnergyNorLoseMomentum) {
  const std::vector<Shape> shapes{
      {Cone{0.03, 0.04}, {}},     {Ellipsoid{Vector3(0.02, 0.03, 0.05)}, {}},
      {Sphere{0.04}, {}},         {Capsule{0.02, 0.05}, {}},
      {Cylinder{0.03, 0.04}, {}}, {Box{Vector3(0.03, 0.02, 0.04)}, {}}};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = i; j < shapes.size(); ++j) {
      for (const double e : {1.0, 0.5}) {
        SCOPED_TRACE(std::to_string(i) + " on " + std::to_string(j));
        PairScene scene =
            make_scene(shapes[i], shapes[j],
                       {.friction = {.sliding = 0.3}, .restitution = e});
        scene.body().p_WB = Vector3(0.01, 0.005, 0.14);
        scene.body().quat_WB = Quaternion(exp_rotation(Vector3(0.4, 0.9, 0.2)));
        scene.body().v_WB_W = Vector3(0.0, 0.0, -2.0);
        scene.body().w_WB_B = Vector3(3.0, -2.0, 5.0);
        scene.go(0.06, 1e-3, IntegratorKind::energy_conserving);
        ASSERT_FALSE(scene.record.contacts.empty());
        for (const dynamics::ContactRecord& contact : scene.record.contacts) {
          const dynamics::ImpactEnergy& energy = contact.energy;
          // With friction of points to the second order in the step.
          const bool is_point = i == 1 && (j == 1 || j == 2 || j == 3);
          EXPECT_LE(energy.error, (is_point ? 1e-3 : 1e-6) *
                                      std::max(energy.in, energy.returned));
        }
        const Vector3 sum =
            scene.state.bodies[0].v_WB_W + scene.state.bodies[1].v_WB_W;
        EXPECT_LT((sum - Vector3(0.0, 0.0, -2.0)).norm(), 2e-12);
      }
    }
  }
}

}  // namespace
}  // namespace limber::contact::cone_and_ellipsoid_test
