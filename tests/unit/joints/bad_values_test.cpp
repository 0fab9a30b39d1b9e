// SPDX-License-Identifier: BSD-3-Clause
// Each constructor refuses a bad value with an InputError that names it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/joints/latch.hpp"
#include "limber/joints/point_spring.hpp"

namespace limber::joints::bad_values_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const Vector3 kX = Vector3::UnitX();
const Vector3 kY = Vector3::UnitY();
const Matrix3 kI = Matrix3::Identity();

template <typename Law, typename Parameters = typename Law::Parameters>
void expect_refused(const Parameters& parameters, const std::string& text) {
  try {
    static_cast<void>(Law(parameters));
    ADD_FAILURE() << "taken: " << text;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

void expect_refused(const Signal& signal, const std::string& text) {
  try {
    check(signal);
    ADD_FAILURE() << "taken: " << text;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

TEST(BadValues, OfASpringCurve) {
  for (const double bad : {-1.0, kNaN, kInf}) {
    expect_refused<SpringCurve>({.stiffness = bad}, "its stiffness is");
    expect_refused<SpringCurve>({.quadratic = bad}, "its quadratic stiffness");
  }
  expect_refused<SpringCurve>({.extensions = {0.0}, .forces = {0.0}},
                              "1 extensions and 1 forces");
  expect_refused<SpringCurve>({.extensions = {0.0, 1.0}, .forces = {0.0}},
                              "2 extensions and 1 forces");
  expect_refused<SpringCurve>({.extensions = {0.0, 0.0}, .forces = {0.0, 1.0}},
                              "decreases at extension 0");
  expect_refused<SpringCurve>({.extensions = {0.0, 1.0}, .forces = {2.0, 1.0}},
                              "force 1;");
  expect_refused<SpringCurve>({.extensions = {0.0, 1.0}, .forces = {0.0, kNaN}},
                              "not finite");
}

TEST(BadValues, OfASpringAlongACoordinate) {
  for (const double bad : {-1.0, kNaN, kInf}) {
    expect_refused<ScalarSpring>({.damping = bad}, "its damping is");
  }
  expect_refused<ScalarSpring>({.rest = kInf}, "rest position");
  const SpringCurve pushes({.extensions = {0.0, 1.0}, .forces = {-2.0, 1.0}});
  expect_refused<ScalarSpring>({.curve = pushes, .tension_only = true},
                               "pushes with 2 at extension 0");
}

TEST(BadValues, OfAPointSpring) {
  expect_refused<PointSpring>({.stiffness = -1.0}, "its stiffness is -1");
  expect_refused<PointSpring>({.damping = -1.0}, "its damping is -1");
  expect_refused<PointSpring>({.free_length = -1.0}, "free length is -1 m");
  expect_refused<PointSpring>({.free_length = kInf}, "not finite");
  expect_refused<PointSpring>({.forces = {1.0, 2.0}}, "0 extensions");
}

TEST(BadValues, OfFriction) {
  for (const double bad : {-1.0, kNaN, kInf}) {
    expect_refused<Friction>({.coulomb = bad}, "its Coulomb force is");
    expect_refused<Friction>({.viscous = bad}, "its viscous coefficient is");
    expect_refused<Friction>({.speed = bad}, "its smoothing speed is");
  }
  expect_refused<Friction>({.speed = 0.0}, "its smoothing speed is 0");
}

TEST(BadValues, OfAnEndStop) {
  expect_refused<EndStop>({.lower = 2.0, .upper = 1.0, .stiffness = 1.0},
                          "its bounds 2 and 1");
  expect_refused<EndStop>({.lower = kNaN, .stiffness = 1.0}, "its bounds nan");
  expect_refused<EndStop>({.lower = kInf, .stiffness = 1.0}, "its bounds inf");
  expect_refused<EndStop>({.upper = -kInf, .stiffness = 1.0}, "and -inf");
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    expect_refused<EndStop>({.stiffness = bad}, "its stiffness is");
  }
  for (const double bad : {-1.0, kNaN, kInf}) {
    expect_refused<EndStop>({.stiffness = 1.0, .damping = bad},
                            "its damping is");
  }
  for (const double bad : {0.0, -0.5, 1.5, kNaN}) {
    EXPECT_THROW(static_cast<void>(find_stop_damping(bad, 1.0)), InputError);
  }
  for (const double bad : {0.0, -0.5, kInf, kNaN}) {
    EXPECT_THROW(static_cast<void>(find_stop_damping(0.5, bad)), InputError);
  }
}

TEST(BadValues, OfADrive) {
  const Signal at_rest{ConstantSignal{}};
  const Signal ramp{RampSignal{.to = 3.0, .duration = 1.0}};
  using enum DriveMode;
  expect_refused<Drive>({.signal = at_rest}, "its stiffness is 0");
  expect_refused<Drive>({.mode = velocity, .signal = at_rest},
                        "its damping is 0");
  expect_refused<Drive>({.mode = effort, .signal = at_rest, .damping = -1.0},
                        "its damping is -1");
  for (const double bad : {0.0, -1.0, kNaN}) {
    expect_refused<Drive>(
        {.mode = effort, .signal = at_rest, .max_effort = bad},
        "its largest effort is");
    expect_refused<Drive>({.mode = effort, .signal = at_rest, .max_speed = bad},
                          "its largest speed is");
  }
  expect_refused<Drive>({.signal = ramp, .stiffness = 1.0, .max_speed = 2.9},
                        "a speed of 3; its limit is 2.9");
  expect_refused<Drive>(
      {.mode = velocity, .signal = ramp, .damping = 1.0, .max_speed = 2.9},
      "a speed of 3; its limit is 2.9");
  expect_refused<Drive>({.mode = effort, .signal = ramp, .max_effort = 2.9},
                        "an effort of 3; its limit is 2.9");
  expect_refused<Drive>({.mode = effort, .signal = {ConstantSignal{kNaN}}},
                        "not finite");
}

TEST(BadValues, OfASignal) {
  expect_refused(Signal{RampSignal{.to = 1.0}}, "duration is 0 s");
  expect_refused(Signal{RampSignal{.to = kInf, .duration = 1.0}}, "not finite");
  for (const double bad : {0.0, -0.1, 0.501, kNaN}) {
    expect_refused(Signal{RampSignal{.duration = 1.0, .rise = bad}},
                   "a trapezoid's rise is");
  }
  expect_refused(Signal{TableSignal{}}, "0 times and 0 values");
  expect_refused(Signal{TableSignal{{0.0, 1.0}, {0.0}}},
                 "2 times and 1 values");
  expect_refused(Signal{TableSignal{{0.0, 0.0}, {0.0, 1.0}}},
                 "do not increase at 0 s");
  expect_refused(Signal{TableSignal{{0.0}, {kNaN}}}, "not finite");
  expect_refused(Signal{SineSignal{.amplitude = 1.0}}, "frequency is 0 Hz");
  expect_refused(Signal{SineSignal{.frequency = kNaN}}, "not finite");
}

TEST(BadValues, OfAShaper) {
  const ConstantSignal one{1.0};
  expect_refused(Signal{one, {}}, "sum to 0");
  expect_refused(Signal{one, {{0.5, 0.0}, {0.4, 0.1}}}, "sum to 0.9");
  expect_refused(Signal{one, {{1.0, -0.1}}}, "delay is -0.1 s");
  expect_refused(Signal{one, {{1.0, kInf}}}, "not finite");
  for (const double bad : {0.0, -1.0, kInf, kNaN}) {
    EXPECT_THROW(static_cast<void>(make_shaper(ShaperKind::zv, bad, 0.0)),
                 InputError);
  }
  for (const double bad : {-0.1, 1.0, kNaN}) {
    EXPECT_THROW(static_cast<void>(make_shaper(ShaperKind::zvd, 1.0, bad)),
                 InputError);
  }
}

TEST(BadValues, OfABushing) {
  expect_refused<Bushing>({.translational_stiffness = -kI},
                          "translational stiffness has a negative eigenvalue");
  expect_refused<Bushing>({.rotational_damping = kNaN * kI},
                          "rotational damping is not finite");
  Matrix3 skewed = kI;
  skewed(0, 1) = 0.5;
  expect_refused<Bushing>({.rotational_stiffness = skewed},
                          "rotational stiffness is not symmetric");
  // Coupling that makes the matrix indefinite; and the same in other units.
  for (const double unit : {1.0, 1e4}) {
    expect_refused<Bushing>(
        {.translational_stiffness = 4.0 * unit * unit * kI,
         .rotational_stiffness = 9.0 * kI,
         .coupling_stiffness = 6.01 * unit * kI},
        "stiffness with its coupling has a negative eigenvalue");
    EXPECT_NO_THROW(Bushing({.translational_stiffness = 4.0 * unit * unit * kI,
                             .rotational_stiffness = 9.0 * kI,
                             .coupling_stiffness = 6.0 * unit * kI}));
  }
  expect_refused<Bushing>({.coupling_damping = kI}, "negative eigenvalue");
}

TEST(BadValues, OfALatch) {
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    expect_refused<Latch>({.reach = bad}, "its reach is");
  }
  for (const double bad : {0.0, -1.0, kNaN}) {
    expect_refused<Latch>({.reach = 1.0, .release_force = bad},
                          "its release force is");
  }
  for (const double bad : {kNaN, -kInf}) {
    expect_refused<Latch>({.reach = 1.0, .release_time = bad},
                          "its release time is");
  }
  expect_refused<Latch>(
      {.reach = 1.0, .bushing = {.translational_stiffness = -kI}},
      "negative eigenvalue");
}

TEST(BadValues, OfAUniversalConstraint) {
  expect_refused<UniversalConstraint>({.axis_F = Vector3::Zero()},
                                      "no direction");
  expect_refused<UniversalConstraint>({.axis_M = kNaN * kX}, "no direction");
  expect_refused<UniversalConstraint>({.axis_F = kX, .axis_M = kX + kY},
                                      "not normal to each other");
  for (const double bad : {-1.0, kNaN, kInf}) {
    expect_refused<UniversalConstraint>({.translational_stiffness = bad},
                                        ">= 0");
    expect_refused<UniversalConstraint>({.rotational_stiffness = bad}, ">= 0");
    expect_refused<UniversalConstraint>({.translational_damping = bad}, ">= 0");
    expect_refused<UniversalConstraint>({.rotational_damping = bad}, ">= 0");
  }
}

TEST(BadValues, OfAJoint) {
  using enum JointKind;
  const auto make = [](JointKind kind, const Vector3& axis,
                       const Vector3& second, const JointParameters& p) {
    static_cast<void>(make_joint(kind, axis, second, p));
  };
  for (const JointKind kind : {revolute, continuous, prismatic, planar}) {
    EXPECT_THROW(make(kind, Vector3::Zero(), kY, {}), InputError);
    EXPECT_THROW(make(kind, Vector3(kNaN, 0.0, 1.0), kY, {}), InputError);
    EXPECT_NO_THROW(make(kind, 7.0 * kX, Vector3::Zero(), {}));
  }
  for (const JointKind kind : {fixed, floating, ball}) {
    EXPECT_NO_THROW(make(kind, Vector3::Zero(), Vector3::Zero(), {}));
  }
  EXPECT_THROW(make(universal, kX, Vector3::Zero(), {}), InputError);
  EXPECT_THROW(make(universal, kX, kX, {}), InputError);
  for (const JointKind kind : {fixed, revolute, universal}) {
    for (const double bad : {-1.0, kNaN, kInf}) {
      EXPECT_THROW(make(kind, kX, kY, {.translational_stiffness = bad}),
                   InputError);
      EXPECT_THROW(make(kind, kX, kY, {.free_damping = bad}), InputError);
    }
  }
}

TEST(BadValues, OfACallerAreItsDefects) {
  const ScalarLaw spring = ScalarSpring({});
  const AxisCoordinate angle;
  EXPECT_THROW(Joint(Bushing({}), {angle}, {{1, spring}}), ContractError);
  EXPECT_THROW(Joint(Bushing({}), {angle}, {{-1, spring}}), ContractError);
  EXPECT_THROW(Joint(Bushing({}), {angle, angle, angle, angle}, {}),
               ContractError);
  const ScalarLaw stop = EndStop({.stiffness = 1.0});
  const std::vector<JointElement> stops(6, {0, stop});  // 12 switches
  EXPECT_THROW(Joint(Bushing({}), {angle}, stops), ContractError);
  EXPECT_THROW(Joint(Bushing({}), {{.axis = 2.0 * kX}}, {}), ContractError);
  EXPECT_THROW(static_cast<void>(
                   make_joint(JointKind::fixed, kX, kY, {}, {{0, spring}})),
               ContractError);
  EXPECT_THROW(
      static_cast<void>(make_joint_bushing(JointKind::universal, kX, {})),
      ContractError);
}

}  // namespace
}  // namespace limber::joints::bad_values_test
