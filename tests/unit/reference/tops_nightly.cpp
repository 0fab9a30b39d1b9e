// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reference/simbody_reference.hpp"
#include "support/free_top.hpp"

namespace limber::reference::tops_nightly {
namespace {

using dynamics::Breakpoint;
using dynamics::IntegratorKind;

// --- The flip about the intermediate axis
// -------------------------------------

Vector3 spin_by_us(double t, double step) {
  dynamics::SystemBuilder builder;
  builder.add_rigid_body("top", {1.0, Matrix3(Vector3(1, 2, 3).asDiagonal())});
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[0].w_WB_B = {0.01, 1, 0};
  dynamics::SimulationSettings settings;
  settings.integrator = IntegratorKind::runge_kutta_4;
  settings.end_time = t;
  settings.step = step;
  dynamics::simulate(model, state, settings, {});
  return state.bodies[0].w_WB_B;
}

Vector3 spin_by_simbody(double t) {
  Mechanism mechanism;
  MechanismBody body;
  body.mass = 1.0;
  body.inertia = Vector3(1, 2, 3).asDiagonal();
  body.mobilizer = Mobilizer::free;
  body.velocity = {0, 0, 0, 0.01, 1, 0};
  mechanism.bodies = {body};
  mechanism.observed = {{0, {}}};
  return simulate(mechanism, {JointModel::ideal, 1e-12}, {{t, false, true}})
      .snapshots.back()
      .frames[0]
      .w_WB_B;
}

// Each flip magnifies the errors so far, which sorts integrators out.
TEST(Tops, AfterTenAndAHundredFlipsWeAreNoWorseThanSimbody) {
  const testing::FreeTop top(0.01);
  for (const int flips : {10, 100}) {
    // In the middle of the last.
    const double t = (flips - 0.5) * top.flip_time() + 3.0;
    const Vector3 exact = top.angular_velocity(t);
    const double ours = (spin_by_us(t, 0.0025) - exact).norm();
    const double theirs = (spin_by_simbody(t) - exact).norm();
    EXPECT_LT(ours, 1e-9) << flips;
    EXPECT_LE(ours, theirs) << flips;
  }
}

// --- Heavy symmetric top
// ------------------------------------------------------

constexpr double kMass = 1.0;
constexpr double kGravity = 9.81;
constexpr double kArm = 0.1;       // from the pivot to the centre of mass [m]
constexpr double kOwn1 = 0.002;    // across, about the centre of mass [kg m^2]
constexpr double kOwn3 = 0.004;    // along [kg m^2]
constexpr double kTilt = 0.5;      // at the start [rad]
constexpr double kSpin = 40.0;     // about its own axis [rad/s]
constexpr double kDuration = 0.5;  // several nutations [s]
const Vector3 kInertia(kOwn1, kOwn1, kOwn3);

Matrix3 tilted() {
  return Eigen::AngleAxisd(kTilt, Vector3::UnitX()).toRotationMatrix();
}

std::vector<double> sample() {
  std::vector<double> times;
  for (int i = 0; i <= 1000; ++i) times.push_back(kDuration * i / 1000);
  return times;
}

/// On an ideal ball; the body's frame is at the centre of mass.
std::vector<Snapshot> run_on_a_ball() {
  Mechanism mechanism;
  MechanismBody body;
  body.mass = kMass;
  body.inertia = kInertia.asDiagonal();
  body.mobilizer = Mobilizer::ball;
  body.X_LM.p = {0, 0, -kArm};
  body.position = {kTilt, 0, 0};
  const Vector3 w = kSpin * tilted().col(2);
  body.velocity = {w[0], w[1], w[2]};
  mechanism.bodies = {body};
  mechanism.gravity_W = {0, 0, -kGravity};
  mechanism.observed = {{0, {}}};
  std::vector<Breakpoint> marks;
  for (const double t : sample()) {
    if (t > 0.0) marks.push_back({t, false, true});
  }
  return simulate(mechanism, {JointModel::ideal, 1e-12}, marks).snapshots;
}

/// On a point held by a spring of no length and its damper.
std::vector<dynamics::SystemState> run_on_a_spring(double stiffness,
                                                   double step) {
  dynamics::SystemBuilder builder;
  const auto body =
      builder.add_rigid_body("top", {kMass, Matrix3(kInertia.asDiagonal())});
  const auto pivot = builder.attach_world("pivot", {});
  const auto foot =
      builder.attach_frame("foot", body, {Matrix3::Identity(), {0, 0, -kArm}});
  builder.add_coupler(
      "point",
      joints::PointSpring({.stiffness = stiffness,
                           .damping = 0.5 * std::sqrt(stiffness * kMass)}),
      pivot, foot);
  builder.set_gravity({0, 0, -kGravity});
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[0].quat_WB = Quaternion(tilted());
  state.bodies[0].p_WB = kArm * tilted().col(2);
  state.bodies[0].w_WB_B = {0, 0, kSpin};
  dynamics::SimulationSettings settings;
  settings.end_time = kDuration;
  settings.step = step;
  settings.output_times = sample();
  std::vector<dynamics::SystemState> states;
  dynamics::simulate(model, state, settings,
                     [&](const dynamics::SystemState& now, const auto&) {
                       states.push_back(now);
                     });
  return states;
}

/// Lowest cosine of the tilt that a top released without nutation reaches:
/// a root of (u0 - u) [2 m g l (1 - u^2) / I1 - a^2 (u0 - u)] = 0 with
/// a = I3 w3 / I1 (Goldstein, Classical Mechanics, sec. 5.7).
double find_lowest_cosine() {
  const double I1 = kOwn1 + kMass * kArm * kArm;
  const double a = kOwn3 * kSpin / I1;
  const double beta = 2.0 * kMass * kGravity * kArm / I1;
  const double u0 = std::cos(kTilt);
  // beta (1 - u^2) = a^2 (u0 - u): the root in (-1, u0).
  const double p = a * a / beta;
  return 0.5 * (p - std::sqrt(p * p - 4.0 * (p * u0 - 1.0)));
}

double find_cosine(const dynamics::BodyState& body) {
  return body.quat_WB.toRotationMatrix()(2, 2);
}

TEST(Tops, HeavyTopOfSimbodyNutatesBetweenTheClosedFormsBounds) {
  double lowest = 1.0;
  double highest = -1.0;
  const std::vector<Snapshot> run = run_on_a_ball();
  for (const Snapshot& now : run) {
    const dynamics::BodyState& body = now.frames[0];
    const double u = find_cosine(body);
    lowest = std::min(lowest, u);
    highest = std::max(highest, u);
    const Matrix3 R = body.quat_WB.toRotationMatrix();
    const Vector3 momentum = R * kInertia.cwiseProduct(body.w_WB_B) +
                             kMass * body.p_WB.cross(body.v_WB_W);
    EXPECT_NEAR(body.w_WB_B[2], kSpin, 1e-9 * kSpin);
    EXPECT_NEAR(momentum.z(), kOwn3 * kSpin * std::cos(kTilt), 1e-10);
    EXPECT_NEAR(now.kinetic + kMass * kGravity * body.p_WB.z(),
                run[0].kinetic + kMass * kGravity * kArm * std::cos(kTilt),
                1e-9);
  }
  // The samples miss an extreme by at most (dt)^2 / 2 of its curvature.
  EXPECT_NEAR(highest, std::cos(kTilt), 1e-12);
  EXPECT_GE(lowest, find_lowest_cosine() - 1e-9);
  EXPECT_NEAR(lowest, find_lowest_cosine(), 2e-4);
}

double find_difference(const std::vector<dynamics::SystemState>& ours,
                       const std::vector<Snapshot>& theirs) {
  double largest = 0.0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    largest = std::max(largest, ours[i].bodies[0].quat_WB.angularDistance(
                                    theirs[i].frames[0].quat_WB));
  }
  return largest;
}

// The pivot deflects by m g / k, which changes the motion at first order.
TEST(Tops, HeavyTopOnAStiffeningPointConvergesToSimbodysBall) {
  const std::vector<Snapshot> ball = run_on_a_ball();
  std::vector<double> difference;
  for (const double k : {1e4, 1e5, 1e6}) {
    difference.push_back(find_difference(run_on_a_spring(k, 1e-5), ball));
  }
  EXPECT_NEAR(std::log10(difference[0] / difference[1]), 1.0, 0.1);
  EXPECT_NEAR(std::log10(difference[1] / difference[2]), 1.0, 0.1);
}

}  // namespace
}  // namespace limber::reference::tops_nightly
