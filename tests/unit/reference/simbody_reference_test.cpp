// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/simbody_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "support/free_top.hpp"

/// Simbody against closed forms, before anything is compared with it.
namespace limber::reference::simbody_reference_test {
namespace {

using dynamics::Breakpoint;

/// One body on a joint to the ground.
Mechanism make_single(Mobilizer mobilizer, const Vector3& inertia) {
  Mechanism mechanism;
  MechanismBody body;
  body.name = "body";
  body.mass = 2.0;
  body.inertia = inertia.asDiagonal();
  body.mobilizer = mobilizer;
  mechanism.bodies = {body};
  mechanism.observed = {{0, {}}};
  return mechanism;
}

std::vector<Breakpoint> outputs(const std::vector<double>& times) {
  std::vector<Breakpoint> marks;
  for (const double t : times) marks.push_back({t, false, true});
  return marks;
}

// The accuracy applies per step; over the run, with a flip in it, the error is
// larger and decreases with the accuracy.
TEST(SimbodyReference, TopConvergesToTheClosedFormWithTheAccuracy) {
  Mechanism mechanism = make_single(Mobilizer::free, {1, 2, 3});
  mechanism.bodies[0].velocity = {0, 0, 0, 0.01, 1, 0};
  const testing::FreeTop top(0.01);
  const auto run = [&](double accuracy) {
    return simulate(mechanism, {JointModel::ideal, accuracy},
                    outputs({10.377305, 20.0, 30.0}))
        .snapshots;
  };
  const std::vector<Snapshot> coarse = run(1e-10);
  const std::vector<Snapshot> fine = run(1e-12);
  EXPECT_NEAR(fine[1].frames[0].w_WB_B[1], 0.0, 1e-6);
  for (const std::size_t i : {2U, 3U}) {
    const Vector3 exact = top.angular_velocity(fine[i].time);
    const double error = (fine[i].frames[0].w_WB_B - exact).norm();
    EXPECT_LT(error, 1e-7);
    EXPECT_LT(error, 0.02 * (coarse[i].frames[0].w_WB_B - exact).norm());
  }
}

// A rectangular pulse gives F d / m, for any step of the integrator.
TEST(SimbodyReference, StepsOntoTheJumpsOfALoad) {
  Mechanism mechanism = make_single(Mobilizer::free, {1, 1, 1});
  LoadElement load;
  load.force = {3.0, 0.0, -1.0};
  load.function = dynamics::Pulse{.start = 0.0131, .duration = 0.0077};
  mechanism.loads = {load};
  const SimbodyRun run =
      simulate(mechanism, {JointModel::ideal, 1e-6},
               {{0.0131, true}, {0.0131 + 0.0077, true}, {0.1, false, true}});
  const Vector3 expected = load.force * 0.0077 / 2.0;
  EXPECT_LT((run.snapshots.back().frames[0].v_WB_W - expected).norm(), 1e-15);
}

TEST(SimbodyReference, NodalHistoryHoldsFromTimeToTime) {
  Mechanism mechanism = make_single(Mobilizer::free, {1, 1, 1});
  flexbody::NodalLoad history;
  history.times = {0.01, 0.03};
  history.force = (Matrix3X(3, 2) << 1, 5, 0, 0, 0, 0).finished();
  history.moment = Matrix3X::Zero(3, 2);
  mechanism.histories = {{{0, {}}, history}};
  const SimbodyRun run =
      simulate(mechanism, {JointModel::ideal, 1e-6},
               {{0.01, true}, {0.03, true}, {0.1, false, true}});
  EXPECT_NEAR(run.snapshots.back().frames[0].v_WB_W.x(),
              (1.0 * 0.02 + 5.0 * 0.07) / 2.0, 1e-15);
}

TEST(SimbodyReference, PendulumHasTheClosedFormPeriod) {
  Mechanism mechanism = make_single(Mobilizer::pin, {1e-6, 1e-6, 1e-6});
  mechanism.gravity_W = {9.81, 0, 0};
  mechanism.bodies[0].p_LBcm = {1, 0, 0};
  mechanism.bodies[0].position = {std::numbers::pi / 2};
  mechanism.observed[0].X_LF.p = {1, 0, 0};
  // 4 sqrt(L / g) K(sin 45 deg) with the compound pendulum's L = 1 + I / m.
  const double period = 2.367841948 * std::sqrt(1.0 + 1e-6 / 2.0);
  const SimbodyRun run =
      simulate(mechanism, {JointModel::ideal, 1e-12}, outputs({period}));
  EXPECT_LT((run.snapshots[1].frames[0].p_WB - Vector3(0, 1, 0)).norm(), 1e-8);
  // Speed at the turning point: g times the period's error, 1e-9 s.
  EXPECT_LT(run.snapshots[1].frames[0].v_WB_W.norm(), 2e-8);
}

TEST(SimbodyReference, SliderRunsAlongZ) {
  Mechanism mechanism = make_single(Mobilizer::slider, {1, 1, 1});
  mechanism.bodies[0].position = {0.5};
  mechanism.bodies[0].velocity = {-2.0};
  mechanism.gravity_W = {3, 4, 6};
  const SimbodyRun run =
      simulate(mechanism, {JointModel::ideal, 1e-10}, outputs({1.0}));
  EXPECT_LT((run.snapshots[1].frames[0].p_WB - Vector3(0, 0, 1.5)).norm(),
            1e-12);
}

// Simbody's own bushing and ours differ by the measure of rotation alone:
// three angles and a rotation vector part at second order in the angle, which
// relative to it is first.
TEST(SimbodyReference, LinearBushingIsTheChordalOneForSmallAngles) {
  std::vector<double> relative;
  for (const double angle : {0.08, 0.04, 0.02}) {
    Mechanism mechanism = make_single(Mobilizer::free, {1, 2, 3});
    mechanism.bodies[0].velocity = {0,          0,          0,
                                    30 * angle, 50 * angle, -20 * angle};
    BushingElement element;
    element.M.body = 0;
    element.law.translational_stiffness = Vector3(200, 300, 400).asDiagonal();
    element.law.rotational_stiffness = Vector3(3000, 4000, 5000).asDiagonal();
    element.law.rotational_damping = Vector3(0.1, 0.2, 0.3).asDiagonal();
    mechanism.bushings = {element};
    Quaternion turned[2];
    for (const int i : {0, 1}) {
      const JointModel joints =
          i == 0 ? JointModel::bushings : JointModel::linear_bushings;
      turned[i] = simulate(mechanism, {joints, 1e-12}, outputs({0.1}))
                      .snapshots[1]
                      .frames[0]
                      .quat_WB;
    }
    relative.push_back(turned[0].angularDistance(turned[1]) / angle);
  }
  EXPECT_NEAR(std::log2(relative[0] / relative[1]), 1.0, 0.2);
  EXPECT_NEAR(std::log2(relative[1] / relative[2]), 1.0, 0.2);
}

TEST(SimbodyReference, RefusesAnAccuracyOutsideItsRange) {
  const Mechanism mechanism = make_single(Mobilizer::free, {1, 1, 1});
  for (const double accuracy : {0.0, -1.0, 1.0, std::nan("")}) {
    EXPECT_THROW((void)simulate(mechanism, {JointModel::ideal, accuracy},
                                outputs({1.0})),
                 InputError);
  }
}

}  // namespace
}  // namespace limber::reference::simbody_reference_test
