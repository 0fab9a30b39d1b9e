// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_observer.hpp"

#include <gtest/gtest.h>

#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/level_advice.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::level_observer_test {
namespace {

constexpr double kRoundoff = 1e-12;

// A load that rises to its end is largest in the limit from the left there.
TEST(LevelObserver, SeesALoadThatEndsAtAJumpBeforeTheJump) {
  auto chain = limber::testing::make_chain(
      {.bodies = 1, .fidelity = Fidelity::uncoupled});
  const Vector3 force_B(3.0, -2.0, 7.0);
  chain.builder.add_load("push", chain.last_interfaces[0], force_B,
                         Vector3::Zero(), LoadFrame::body,
                         Table{.times = {0.0, 1.0}, .values = {0.0, 1.0}});
  const SystemModel model = chain.builder.build();
  SystemModel rigid = model;
  rigid.bodies[0].modes = 0;
  LevelObserver level_observer(model);
  SystemState state = make_state(model);
  for (const double t : {0.0, 1.0, 2.0}) {
    state.t = t;
    level_observer.include(rigid, state);
  }
  const BodyModel& body = model.bodies[0];
  const Attachment& tip = model.attachments[index(chain.last_interfaces[0])];
  const VectorX eta =
      (tip.Phi_B.transpose() * force_B)
          .cwiseQuotient(flexbody::rest_stiffness(body.elasticity));
  const double u = DisplacementMeasure(body).calc_displacement(eta);
  const Peak loads = level_observer.find_peaks().front().loads;
  EXPECT_NEAR(loads.value, u, kRoundoff * u);
  EXPECT_EQ(loads.time, 1.0);
}

// A body whose masses u moves aside turns with J0 w0 = (J0 + dJ) w, dJ of first
// order in u, and its corners go where that leaves them.
TEST(LevelObserver, TurnsCornersAsideByTheInertiaThatDeformationAdds) {
  const auto cloud =
      limber::testing::make_point_mass_body(24, 6, 4.0, 1.0, 60.0, 42);
  SystemBuilder builder;
  builder.add_flexible_body("cloud", limber::testing::share(cloud),
                            Fidelity::uncoupled, {});
  const SystemModel model = builder.build();
  LevelObserver level_observer(model);
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(0.3, -0.2, 0.5);
  state.eta = VectorX::LinSpaced(6, -0.1, 0.2);
  constexpr double kTime = 2.0;
  for (const double t : {0.0, kTime}) {
    state.t = t;
    level_observer.include(model, state);
  }
  // At this level the modes lack the response to rotation, which is added.
  const BodyPeaks peaks = level_observer.find_peaks().front();
  VectorX eta = state.eta;
  const Vector3& w = state.bodies[0].w_WB_B;
  for (Eigen::Index n = 0; n < cloud.masses.size(); ++n) {
    const auto phi = cloud.reduced.rows.Phi_B.middleRows<3>(3 * n);
    const Vector3 force =
        cloud.masses[n] * -w.cross(w.cross(cloud.reduced.rows.x_B.col(n)));
    eta += (phi.transpose() * force).cwiseQuotient(cloud.reduced.lambda);
  }
  Matrix3 J0 = Matrix3::Zero();
  Matrix3 dJ = Matrix3::Zero();
  for (Eigen::Index n = 0; n < cloud.masses.size(); ++n) {
    const Vector3 x = cloud.reduced.rows.x_B.col(n);
    const Vector3 u = cloud.reduced.rows.Phi_B.middleRows<3>(3 * n) * eta;
    const double m = cloud.masses[n];
    J0 += m * (x.dot(x) * Matrix3::Identity() - x * x.transpose());
    dJ += m * (2.0 * x.dot(u) * Matrix3::Identity() - x * u.transpose() -
               u * x.transpose());
  }
  const Vector3 angle = (kTime * J0.inverse() * dJ * w).cwiseAbs();
  const Vector3 half = 0.5 * cloud.reduced.size;
  const double expected = Vector3(angle.y() * half.z() + angle.z() * half.y(),
                                  angle.z() * half.x() + angle.x() * half.z(),
                                  angle.x() * half.y() + angle.y() * half.x())
                              .norm();
  EXPECT_NEAR(peaks.turned_aside, expected, 1e-10 * expected);
}

// Euler's equations of the undeformed body.
TEST(LevelObserver, FindsTheAngularAccelerationOfASpinningBodyUnderAMoment) {
  const auto cloud =
      limber::testing::make_point_mass_body(24, 6, 4.0, 1.0, 60.0, 42);
  const auto tip = limber::testing::make_interface(cloud, 6, 12);
  const Vector3 moment_B(0.4, -0.7, 0.2);
  SystemBuilder builder;
  const auto body = builder.add_flexible_body(
      "cloud", limber::testing::share(cloud), Fidelity::uncoupled, {});
  builder.add_load("turn",
                   builder.attach_interface("tip", body, tip,
                                            {Matrix3::Identity(), tip.p_B}),
                   Vector3::Zero(), moment_B, LoadFrame::body, Constant{});
  const SystemModel model = builder.build();
  SystemModel rigid = model;
  rigid.bodies[0].modes = 0;
  SystemState state = make_state(model);
  const Vector3 w(1.3, -0.6, 0.9);
  state.bodies[0].w_WB_B = w;
  LevelObserver level_observer(model);
  level_observer.include(rigid, state);
  const Matrix3 J0 = cloud.reduced.inertia();
  const Vector3 alpha = J0.inverse() * (moment_B - w.cross(J0 * w));
  const BodyPeaks peaks = level_observer.find_peaks().front();
  EXPECT_NEAR(peaks.alpha.value, alpha.norm(), kRoundoff * alpha.norm());
  EXPECT_NEAR(peaks.Omega.value, w.norm(), kRoundoff);
  EXPECT_NEAR(peaks.report.value, alpha.norm() + w.squaredNorm(), 1e-11);
}

}  // namespace
}  // namespace limber::dynamics::level_observer_test
