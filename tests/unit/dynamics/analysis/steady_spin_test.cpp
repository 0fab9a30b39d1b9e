// SPDX-License-Identifier: BSD-3-Clause
// Steady rotations against closed forms.
#include "limber/dynamics/analysis/steady_spin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
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

// A rotor on a hinge of the world, its mass at an arm r from the axis. In its
// own axes its centre moves by d = d_x + i d_y from the arm's end:
// m (-w^2 + i a) (r + d) = -(k + i c w) d. The damper, which stays in the
// world, brakes it by a, which no angle balances: the force at the hinge, about
// the centre, is J a = m r (w^2 d_y - a (r + d_x)).
struct Rotor {
  static constexpr double kMass = 1.0;
  static constexpr double kArm = 0.02;
  static constexpr double kHold = 1e8;
  static constexpr double kDamper = 500.0;
  static constexpr double kInertia = 0.01;

  SystemBuilder builder;
  Matrix3 R;
  Vector3 at;

  Rotor(const Matrix3& axes, const Vector3& place) : R(axes), at(place) {
    add("rotor", kArm);
  }
  void add(const std::string& name, double arm) {
    const BodyIndex body =
        builder.add_rigid_body(name, {kMass, kInertia * Matrix3::Identity()});
    builder.add_coupler(
        name + " axle",
        joints::make_joint(joints::JointKind::revolute, Vector3::UnitZ(), {},
                           {.translational_stiffness = kHold,
                            .rotational_stiffness = 1e6,
                            .translational_damping = kDamper,
                            .rotational_damping = 1.0}),
        builder.attach_world(name + ".F", {R, at}),
        builder.attach_frame(name + ".M", body,
                             {Matrix3::Identity(), {-arm, 0.0, 0.0}}));
    arms.push_back(arm);
  }
  [[nodiscard]] SystemState solve(double speed) const {
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    const Vector3 w = R * (speed * Vector3::UnitZ());
    for (std::size_t b = 0; b < arms.size(); ++b) {
      state.bodies[b].quat_WB = Quaternion(R);
      state.bodies[b].p_WB = at + R * Vector3(arms[b], 0.0, 0.0);
      state.bodies[b].v_WB_W = w.cross(state.bodies[b].p_WB - at);
      state.bodies[b].w_WB_B = speed * Vector3::UnitZ();
    }
    return find_steady_spin(model, state);
  }
  /// Of the centre, in the rotor's own axes.
  [[nodiscard]] Vector3 find_shift(const SystemState& state,
                                   std::size_t body) const {
    const BodyState& rotor = state.bodies[body];
    return rotor.quat_WB.conjugate() * (rotor.p_WB - at) -
           Vector3(arms[body], 0.0, 0.0);
  }
  static void expect_shift(const Vector3& found, double arm, double speed) {
    std::complex<double> d;
    double a = 0.0;
    for (int i = 0; i < 100; ++i) {
      const std::complex<double> inertial =
          kMass * std::complex<double>(speed * speed, -a);
      d = inertial * arm /
          (std::complex<double>(kHold, kDamper * speed) - inertial);
      a = kMass * arm * speed * speed * d.imag() /
          (kInertia + kMass * arm * (arm + d.real()));
    }
    EXPECT_NEAR(found.x(), d.real(), 1e-9 * std::abs(d) + 1e-15);
    EXPECT_NEAR(found.y(), d.imag(), 1e-9 * std::abs(d) + 1e-15);
    EXPECT_NEAR(found.z(), 0.0, 1e-15);
  }

  std::vector<double> arms;
};

TEST(SteadySpin, OfARotorWithItsMassOffTheAxisExistsAtEverySpeed) {
  const Matrix3 turned = exp_rotation(Vector3(0.4, -1.1, 0.7));
  for (const double speed : {-300.0, 0.01, 10.0, 300.0, 5000.0}) {
    for (const Matrix3& R : {Matrix3(Matrix3::Identity()), turned}) {
      SCOPED_TRACE(speed);
      const Rotor rotor(R, {0.0, 0.0, 0.0});
      Rotor::expect_shift(rotor.find_shift(rotor.solve(speed), 0), Rotor::kArm,
                          speed);
    }
  }
}

TEST(SteadySpin, OfTwoRotorsOnOneAxisIsThatOfEach) {
  Rotor rotor(Matrix3::Identity(), Vector3::Zero());
  rotor.add("other", -0.05);
  const SystemState found = rotor.solve(200.0);
  Rotor::expect_shift(rotor.find_shift(found, 0), Rotor::kArm, 200.0);
  Rotor::expect_shift(rotor.find_shift(found, 1), -0.05, 200.0);
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
