// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_moduli.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/meshes.hpp"
#include "unit/contact/pair_scene.hpp"

/// Bodies without a material, or with a stiffness, radius or damping of their
/// contact: against springs, Hertz's impact and the conserved quantities.
namespace limber::contact::patch_moduli_test {
namespace {

using Scene = test::PairScene;
using dynamics::IntegratorKind;
using dynamics::kWorld;
using dynamics::SystemBuilder;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
constexpr double kTime = 0.01;  // of an impact without a material [s]
const Vector3 kHalf(0.05, 0.04, 0.03);

ContactSide make_box(double mass) {
  const Vector3 q = kHalf.cwiseProduct(kHalf);
  const Matrix3 inertia =
      mass / 3.0 *
      Vector3(q.y() + q.z(), q.x() + q.z(), q.x() + q.y()).asDiagonal();
  return {Shape{Box{kHalf}, {}}, {}, mass, inertia};
}

ContactSide make_ball(double mass, double radius) {
  return {Shape{Sphere{radius}, {}},
          {},
          mass,
          0.4 * mass * radius * radius * Matrix3::Identity()};
}

ContactSide make_plane() { return {Shape{HalfSpace{}, {}}, {}, kInfinity}; }

// Its top is at z = 0.
ContactSide make_table() {
  return {
      Shape{Box{{0.5, 0.5, 0.1}}, Pose{Matrix3::Identity(), {0.0, 0.0, -0.1}}},
      {},
      kInfinity};
}

// A body above what is fixed, in its axes.
Scene make_fall(const ContactSide& fixed, const ContactSide& side,
                const ContactParameters& parameters, double height,
                double speed, bool is_swapped = false) {
  SystemBuilder builder;
  const auto body = builder.add_rigid_body("body", {side.mass, side.inertia_B});
  if (is_swapped) {
    builder.add_pair("body/fixed", body, kWorld,
                     std::make_shared<PatchPair>(side, fixed, parameters));
  } else {
    builder.add_pair("fixed/body", kWorld, body,
                     std::make_shared<PatchPair>(fixed, side, parameters));
  }
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.body().p_WB.z() = height;
  scene.body().v_WB_W.z() = -speed;
  return scene;
}

double find_duration(Scene scene, double lasts) {
  scene.go(3.0 * lasts, 2e-3 * lasts);
  EXPECT_EQ(scene.record.contacts.size(), 1U);
  return scene.record.contacts.empty() ? 0.0
                                       : scene.record.contacts[0].duration;
}

// Hertz's closed form at a tenth of the radius, 2.9433 d / v, to d / R / 5; the
// fifth root of slower ones.
TEST(PatchModuli, WithoutAMaterialGiveABallAHundredthOfASecond) {
  for (const double mass : {1.0, 1000.0}) {
    for (const double radius : {0.02, 0.2}) {
      const double speed = 2.9433 * 0.1 * radius / kTime;
      for (const double slower : {1.0, 32.0}) {
        const double lasts = kTime * std::pow(slower, 0.2);
        Scene scene = make_fall(make_table(), make_ball(mass, radius), {},
                                radius * (1.0 + 1e-4), speed / slower);
        EXPECT_NEAR(find_duration(scene, lasts) / lasts, 1.0,
                    slower > 1.0 ? 2e-3 : 0.02)
            << mass << ' ' << radius << ' ' << slower;
      }
    }
  }
}

// A linear spring of 2 E* sqrt(S / pi), E* of the ball above.
TEST(PatchModuli, WithoutAMaterialHoldAFaceAsASpring) {
  const double radius = kHalf.minCoeff();
  const double mass = 2.0;
  const double modulus = 15.0 * 2.9433 * 2.9433 * mass /
                         (16.0 * std::sqrt(0.1) * kTime * kTime * radius);
  const double k = 2.0 * modulus * std::sqrt(4.0 * kHalf.x() * kHalf.y() / kPi);
  const double lasts = kPi * std::sqrt(mass / k);
  EXPECT_GT(lasts, 0.2 * kTime);
  EXPECT_LT(lasts, kTime);
  Scene scene =
      make_fall(make_plane(), make_box(mass), {}, kHalf.z() + 1e-6, 0.2);
  EXPECT_NEAR(find_duration(scene, lasts) / lasts, 1.0, 1e-3);
}

TEST(PatchModuli, OfAMeshAreThoseOfItsShape) {
  const Pose X{exp_rotation(Vector3(0.3, -1.0, 2.0)), {0.1, 0.2, 0.3}};
  const ContactSide box = make_box(2.0);
  ContactSide mesh =
      make_box_mesh(kHalf).place(X).make_side(1.0, box.mass, box.inertia_B);
  mesh.material.reset();
  EXPECT_NEAR(find_patch_moduli(make_plane(), mesh, {}).normal /
                  find_patch_moduli(make_plane(), box, {}).normal,
              1.0, 1e-12);
  EXPECT_NEAR(find_touch_radius(make_plane(), make_angle().make_side(
                                                  1.0, 1.0, box.inertia_B)),
              0.03, 1e-12);
}

// f = k d^1.5 of a ball on a flat, to d / R / 2, whatever the radius in its
// parameters.
TEST(PatchModuli, OfAStiffnessAreHertzsOnABall) {
  const double k = 3e6;
  const double radius = 0.02;
  const double depth = 1e-4;
  for (const auto& own : {std::optional<double>{}, std::optional{0.7}}) {
    Scene scene =
        make_fall(make_table(), make_ball(1.0, radius),
                  {.radius = own, .stiffness = k}, radius - depth, 0.0);
    EXPECT_NEAR(scene.find_energy().total() / (0.4 * k * std::pow(depth, 2.5)),
                1.0, 0.5 * depth / radius);
  }
}

// E* = 3 k / (4 sqrt(R)), R half of the shortest edge or that asked for; the
// rim is softer, by the depth over the width.
TEST(PatchModuli, OfAStiffnessAreThoseOfItsRadiusOnAFace) {
  const double k = 3e6;
  const double depth = 1e-5;
  for (const auto& own : {std::optional<double>{}, std::optional{0.7}}) {
    Scene scene =
        make_fall(make_plane(), make_box(1.0), {.radius = own, .stiffness = k},
                  kHalf.z() - depth, 0.0);
    const double modulus = 0.75 * k / std::sqrt(own.value_or(kHalf.minCoeff()));
    const double spring =
        2.0 * modulus * std::sqrt(4.0 * kHalf.x() * kHalf.y() / kPi);
    EXPECT_NEAR(scene.find_energy().total() / (0.5 * spring * depth * depth),
                1.0, depth / kHalf.y());
  }
}

// On a flat as on a plane: k grows by the root of the radius.
TEST(PatchModuli, OfARadiusAreOfBallsAlone) {
  ContactSide ball = make_ball(1.0, 0.02);
  ball.material = SurfaceMaterial{1e9, 0.3};
  const PairModuli own = find_patch_moduli(make_table(), ball, {});
  const PairModuli wide =
      find_patch_moduli(make_table(), ball, {.radius = 0.08});
  EXPECT_NEAR(wide.normal / own.normal, 2.0, 1e-12);
  EXPECT_NEAR(wide.tangential_ratio(), own.tangential_ratio(), 1e-12);
  try {
    (void)find_patch_moduli(make_plane(), make_box(1.0), {.radius = 0.08});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("'radius' does not apply to a half space and a box"));
  }
  EXPECT_THROW(
      (void)find_patch_moduli(make_plane(), make_box(1.0), {.stiffness = -1.0}),
      InputError);
}

// Of [@hunt1975]: (1 + e) b v = ln((1 + b v) / (1 - e b v)).
TEST(PatchModuli, LeaveAConstantDampingItsRestitution) {
  const double b = 0.8;
  const double v = 0.5;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double e = 0.5 * (low + high);
    const double x = b * v;
    ((1.0 + e) * x > std::log((1.0 + x) / (1.0 - e * x)) ? low : high) = e;
  }
  for (const auto& fixed : {make_plane(), make_table()}) {
    Scene scene =
        make_fall(fixed, make_box(1.0), {.stiffness = 3e6, .damping = b},
                  kHalf.z() + 1e-6, v);
    scene.go(0.01, 2e-6);
    ASSERT_EQ(scene.record.contacts.size(), 1U);
    EXPECT_NEAR(*scene.record.contacts[0].restitution(), low, 1e-3);
  }
}

TEST(PatchModuli, KeepRestitutionWithAndWithoutAStiffness) {
  for (const auto& k : {std::optional<double>{}, std::optional{3e6}}) {
    for (const double e : {1.0, 0.7, 0.3}) {
      Scene scene =
          make_fall(make_plane(), make_box(1.0),
                    {.restitution = e, .stiffness = k}, kHalf.z() + 1e-6, 0.3);
      scene.go(0.05, 1e-5);
      ASSERT_EQ(scene.record.contacts.size(), 1U);
      EXPECT_NEAR(*scene.record.contacts[0].restitution(), e, 1e-3);
    }
  }
}

// A tilted box that strikes with its corner, turning: nothing is gained, and
// names, an order of magnitude of mass and the step are no matter.
TEST(PatchModuli, GainNothingFromATumblingBoxWithoutAMaterial) {
  for (const ContactParameters& law :
       {ContactParameters{.friction = {.sliding = 0.4}, .restitution = 0.6},
        ContactParameters{.friction = {.sliding = 0.4}, .damping = 0.5}}) {
    std::vector<Vector3> ends;
    for (const double mass : {1.0, 1000.0}) {
      for (const bool is_swapped : {false, true}) {
        Scene scene =
            make_fall(make_plane(), make_box(mass), law, 0.08, 0.7, is_swapped);
        scene.body().quat_WB = Quaternion(exp_rotation(Vector3(0.6, 0.4, 0.1)));
        scene.body().w_WB_B = {1.0, -2.0, 3.0};
        const double before = scene.find_energy().total();
        std::size_t touches = 0;
        for (int i = 1; i <= 10; ++i) {
          scene.go(0.03 * i, 1e-3);
          touches += scene.record.contacts.size();
          EXPECT_LT(scene.find_energy().total(), before * (1.0 + 1e-6));
        }
        EXPECT_GE(touches, 1U);
        ends.push_back(scene.body().v_WB_W);
      }
    }
    for (const Vector3& v : ends) EXPECT_LT((v - ends[0]).norm(), 1e-7);
  }
}

TEST(PatchModuli, KeepTheEnergyOfABoxWithoutAMaterial) {
  Scene scene = make_fall(make_plane(), make_box(1.0), {}, 0.08, 0.7);
  scene.body().quat_WB = Quaternion(exp_rotation(Vector3(0.6, 0.4, 0.1)));
  scene.body().w_WB_B = {1.0, -2.0, 3.0};
  const double before = scene.find_energy().total();
  scene.go(0.3, 1e-3, IntegratorKind::energy_conserving);
  EXPECT_GE(scene.record.contacts.size(), 1U);
  EXPECT_NEAR(scene.find_energy().total() / before, 1.0, 1e-9);
}

}  // namespace
}  // namespace limber::contact::patch_moduli_test
