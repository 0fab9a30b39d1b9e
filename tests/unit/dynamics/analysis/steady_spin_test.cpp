// SPDX-License-Identifier: BSD-3-Clause
// Steady rotations against closed forms.
#include "limber/dynamics/analysis/steady_spin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::steady_spin_test {
namespace {

using ::testing::HasSubstr;

constexpr double kMass = 2.0;         // [kg]
constexpr double kLength = 0.8;       // [m]
constexpr double kStiffness = 400.0;  // [N/m]

// Two equal masses on a spring.
struct Dumbbell {
  SystemBuilder builder;
  BodyIndex a = builder.add_rigid_body("a", {kMass, Matrix3::Identity()});
  BodyIndex b = builder.add_rigid_body("b", {kMass, Matrix3::Identity()});
  AttachmentIndex on_a = builder.attach_frame("on a", a, {});

  Dumbbell() {
    builder.add_coupler(
        "spring",
        joints::PointSpring({.stiffness = kStiffness, .free_length = kLength}),
        on_a, builder.attach_frame("on b", b, {}));
  }
  [[nodiscard]] SystemState start(const Vector3& w,
                                  const Vector3& drift) const {
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    for (std::size_t i = 0; i < 2; ++i) {
      BodyState& body = state.bodies[i];
      body.p_WB = Vector3(0.3, -0.2, 0.1);
      body.p_WB.x() += (i == 0 ? -0.5 : 0.5) * kLength;
      body.v_WB_W = drift + w.cross(body.p_WB - Vector3(0.3, -0.2, 0.1));
      body.w_WB_B = w;
    }
    return state;
  }
  [[nodiscard]] SystemState solve(
      const Vector3& w, const Vector3& drift = Vector3::Zero()) const {
    return find_steady_spin(builder.build(), start(w, drift));
  }
};

std::string refuse(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// k (s - L) = m Omega^2 s / 2.
TEST(SteadySpin, OfTwoMassesStretchesTheirSpringByTheCentrifugalForce) {
  for (const double Omega : {0.5, 5.0, 15.0}) {
    for (const Vector3& drift : {Vector3(0, 0, 0), Vector3(1.0, -2.0, 0.5)}) {
      const SystemState found =
          Dumbbell().solve(Omega * Vector3::UnitZ(), drift);
      const Vector3 s = found.bodies[1].p_WB - found.bodies[0].p_WB;
      const double expected =
          kLength * kStiffness / (kStiffness - 0.5 * kMass * Omega * Omega);
      EXPECT_NEAR(s.norm(), expected, 1e-11) << Omega;
      const Vector3 v = found.bodies[1].v_WB_W - found.bodies[0].v_WB_W;
      EXPECT_LT((v - Omega * Vector3::UnitZ().cross(s)).norm(), 1e-12);
      EXPECT_LT(
          (0.5 * (found.bodies[0].v_WB_W + found.bodies[1].v_WB_W) - drift)
              .norm(),
          1e-11);
    }
  }
}

TEST(SteadySpin, EndsWithAnErrorBeyondTheCriticalSpeed) {
  EXPECT_THROW((void)Dumbbell().solve(25.0 * Vector3::UnitZ()), NumericalError);
}

TEST(SteadySpin, RefusesVelocitiesOfNoRotation) {
  const Dumbbell two;
  SystemState start = two.start(Vector3::UnitZ(), Vector3::Zero());
  start.bodies[1].v_WB_W.x() += 0.1;
  EXPECT_THAT(
      refuse([&] { (void)find_steady_spin(two.builder.build(), start); }),
      HasSubstr("body 'b' does not rotate with the others"));
  start = two.start(Vector3::Zero(), Vector3::UnitX());
  EXPECT_THAT(
      refuse([&] { (void)find_steady_spin(two.builder.build(), start); }),
      HasSubstr("moves without rotation"));
}

TEST(SteadySpin, RefusesWhatStaysInTheWorld) {
  Dumbbell heavy;
  heavy.builder.set_gravity({0.0, -9.81, 0.0});
  EXPECT_THAT(refuse([&] { (void)heavy.solve(Vector3::UnitZ()); }),
              HasSubstr("gravity across the axis"));
  Dumbbell pushed;
  pushed.builder.add_load("push", pushed.on_a, Vector3::UnitX(),
                          Vector3::Zero(), LoadFrame::world, Constant{});
  EXPECT_THAT(refuse([&] { (void)pushed.solve(Vector3::UnitZ()); }),
              HasSubstr("a load in the world's axes"));
}

}  // namespace
}  // namespace limber::dynamics::steady_spin_test
