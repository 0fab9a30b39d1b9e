// SPDX-License-Identifier: BSD-3-Clause
// The equations of motion against Lagrange's, taken by differences from the
// kinetic energy of the point masses themselves.
#include "limber/dynamics/equations/equations.hpp"

#include <gtest/gtest.h>

#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "support/draw_vector.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::equations_test {
namespace {

using testing::make_point_mass_body;
using testing::PointMassBody;

constexpr int kModes = 4;

SystemModel one_body(const PointMassBody& body, Fidelity fidelity) {
  SystemBuilder builder;
  builder.add_flexible_body("body", testing::share(body), fidelity, {});
  return builder.build();
}

SystemState random_state(const SystemModel& model, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    return testing::draw_vector([&] { return uniform(random); });
  };
  SystemState state = make_state(model);
  for (BodyState& b : state.bodies) {
    b.p_WB = vector();
    b.quat_WB = exp_quaternion(2.0 * vector());
    b.v_WB_W = vector();
    b.w_WB_B = 3.0 * vector();
  }
  for (double& x : state.eta) x = 0.3 * uniform(random);
  for (double& x : state.etadot) x = uniform(random);
  return state;
}

// Position and velocity of mass i in the world.
struct PointMotion {
  Vector3 p, v;
};
PointMotion point_motion(const PointMassBody& body, const SystemState& s,
                         Eigen::Index i) {
  const auto phi = body.reduced.rows.Phi_B.middleRows<3>(3 * i);
  const BodyState& b = s.bodies[0];
  const Matrix3 R = b.quat_WB.toRotationMatrix();
  const Vector3 arm = body.reduced.rows.x_B.col(i) + phi * s.eta;
  return {b.p_WB + R * arm,
          b.v_WB_W + R * (b.w_WB_B.cross(arm) + phi * s.etadot)};
}

TEST(Bodies, OfOneReductionKeepItsModalInertiaOnce) {
  const auto one =
      testing::share(make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 1));
  const auto other =
      testing::share(make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 2));
  SystemBuilder builder;
  int count = 0;
  for (const auto& reduced : {one, other, one}) {
    builder.add_flexible_body("body" + std::to_string(count++), reduced,
                              Fidelity::coupled, {});
  }
  const SystemModel model = builder.build();
  EXPECT_EQ(model.bodies[0].inertia, model.bodies[2].inertia);
  EXPECT_NE(model.bodies[0].inertia, model.bodies[1].inertia);
  EXPECT_NE(model.bodies[0].inertia->columns, model.bodies[1].inertia->columns);
}

TEST(Energy, OfACoupledBodyIsThatOfItsMasses) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 1);
  const SystemModel model = one_body(body, Fidelity::coupled);
  const SystemState state = random_state(model, 2);
  double kinetic = 0.0;
  Vector3 momentum = Vector3::Zero();
  Vector3 spin = Vector3::Zero();
  for (Eigen::Index i = 0; i < body.masses.size(); ++i) {
    const PointMotion point = point_motion(body, state, i);
    kinetic += 0.5 * body.masses[i] * point.v.squaredNorm();
    momentum += body.masses[i] * point.v;
    spin += body.masses[i] * point.p.cross(point.v);
  }
  const EnergyBalance energy = calc_energy(model, state);
  EXPECT_NEAR(energy.kinetic_rigid + energy.kinetic_modal, kinetic,
              1e-12 * kinetic);
  EXPECT_LT((energy.linear_momentum - momentum).norm(),
            1e-12 * momentum.norm());
  EXPECT_LT((energy.angular_momentum - spin).norm(), 1e-12 * spin.norm());
}

// With the accelerations that the equations give, each mass's inertial force
// must do no virtual work but the elastic one: d'Alembert, mass by mass.
TEST(Equations, OfACoupledBodyAreDAlembertsOnItsMasses) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 3);
  const SystemModel model = one_body(body, Fidelity::coupled);
  const SystemState state = random_state(model, 4);
  SystemTerms terms = make_terms(model);
  VectorX a = make_unknowns(model);
  calc_terms(model, state, Side::right, terms);
  solve_accelerations(model, terms, a);

  // Accelerations of the masses by central differences along the motion.
  const double h = 1e-5;
  const auto carried = [&](double t) {
    SystemState s = state;
    BodyState& b = s.bodies[0];
    b.p_WB += t * b.v_WB_W + 0.5 * t * t * translation_rows(model.bodies[0], a);
    b.quat_WB = b.quat_WB *
                exp_quaternion(t * b.w_WB_B +
                               0.5 * t * t * rotation_rows(model.bodies[0], a));
    b.v_WB_W += t * translation_rows(model.bodies[0], a);
    b.w_WB_B += t * rotation_rows(model.bodies[0], a);
    s.eta += t * s.etadot + 0.5 * t * t * mode_rows(model.bodies[0], a);
    s.etadot += t * mode_rows(model.bodies[0], a);
    return s;
  };
  const SystemState before = carried(-h);
  const SystemState after = carried(h);
  const Matrix3 R = state.bodies[0].quat_WB.toRotationMatrix();
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  VectorX modal = VectorX::Zero(kModes);
  double scale = 0.0;
  for (Eigen::Index i = 0; i < body.masses.size(); ++i) {
    const Vector3 inertial =
        body.masses[i] *
        (point_motion(body, after, i).v - point_motion(body, before, i).v) /
        (2.0 * h);
    const auto phi = body.reduced.rows.Phi_B.middleRows<3>(3 * i);
    const Vector3 arm = body.reduced.rows.x_B.col(i) + phi * state.eta;
    force += inertial;
    moment += arm.cross(R.transpose() * inertial);
    modal += phi.transpose() * (R.transpose() * inertial);
    scale += inertial.norm();
  }
  modal += VectorX(body.reduced.lambda.array() * state.eta.array());
  constexpr double kDifferences = 1e-8;
  EXPECT_LT(force.norm(), kDifferences * scale);
  EXPECT_LT(moment.norm(), kDifferences * scale);
  EXPECT_LT(modal.norm(), kDifferences * scale);
  EXPECT_GT(scale, 1.0);
}

TEST(Equations, OneWayDrivesTheModesByTheCentrifugalForceOfTheUndeformedBody) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 5);
  const SystemModel model = one_body(body, Fidelity::one_way);
  SystemState state = make_state(model);
  const Vector3 w(0.4, -1.2, 2.0);
  state.bodies[0].w_WB_B = w;
  SystemTerms terms = make_terms(model);
  VectorX a = make_unknowns(model);
  calc_terms(model, state, Side::right, terms);
  solve_accelerations(model, terms, a);
  VectorX centrifugal = VectorX::Zero(kModes);
  for (Eigen::Index i = 0; i < body.masses.size(); ++i) {
    const Vector3 x = body.reduced.rows.x_B.col(i);
    centrifugal -= body.masses[i] *
                   body.reduced.rows.Phi_B.middleRows<3>(3 * i).transpose() *
                   w.cross(w.cross(x));
  }
  EXPECT_LT((mode_rows(model.bodies[0], a) - centrifugal).norm(),
            1e-12 * centrifugal.norm());
  EXPECT_GT(centrifugal.norm(), 0.1);
}

TEST(Equations, UncoupledModesDoNotSeeTheRotation) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 5);
  const SystemModel model = one_body(body, Fidelity::uncoupled);
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3(0.4, -1.2, 2.0);
  SystemTerms terms = make_terms(model);
  VectorX a = make_unknowns(model);
  calc_terms(model, state, Side::right, terms);
  solve_accelerations(model, terms, a);
  EXPECT_EQ(mode_rows(model.bodies[0], a).norm(), 0.0);
}

TEST(Equations, RigidLevelFollowsEuler) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 6);
  const SystemModel model = one_body(body, Fidelity::rigid);
  SystemState state = make_state(model);
  ASSERT_EQ(model.modal_count, 0);
  const Vector3 w(0.4, -1.2, 2.0);
  state.bodies[0].w_WB_B = w;
  SystemTerms terms = make_terms(model);
  VectorX a = make_unknowns(model);
  calc_terms(model, state, Side::right, terms);
  solve_accelerations(model, terms, a);
  const Matrix3 J = body.reduced.inertia();
  const Vector3 expected = -(J.inverse() * w.cross(J * w));
  EXPECT_LT((rotation_rows(model.bodies[0], a) - expected).norm(),
            1e-13 * expected.norm());
}

TEST(Equations, CouplersExertNoNetForceOrMoment) {
  const PointMassBody body = make_point_mass_body(30, kModes, 5.0, 2.0, 9.0, 7);
  SystemBuilder builder;
  std::vector<AttachmentIndex> ends;
  for (int i = 0; i < 2; ++i) {
    const auto b = builder.add_flexible_body(
        "b" + std::to_string(i), testing::share(body), Fidelity::coupled, {});
    const auto interface = testing::make_interface(body, 5 * i, 5 * i + 6);
    ends.push_back(builder.attach_interface(
        "i", b, interface, {exp_rotation(Vector3(1, 2, 3)), interface.p_B}));
  }
  builder.add_coupler(
      "c",
      joints::Bushing({100.0 * Matrix3::Identity(), 30 * Matrix3::Identity(),
                       3.0 * Matrix3::Identity(), 2 * Matrix3::Identity()}),
      ends[0], ends[1]);
  const SystemModel model = builder.build();
  const SystemState state = random_state(model, 8);
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  double scale = 0.0;
  for (std::size_t b = 0; b < 2; ++b) {
    const BodyTerms& t = terms.bodies[b];
    force += t.force_W;
    moment += state.bodies[b].p_WB.cross(t.force_W) + t.R_WB * t.moment_B;
    scale += t.force_W.norm() + t.moment_B.norm();
  }
  EXPECT_LT(force.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-13 * scale);
  EXPECT_GT(scale, 1.0);
}

}  // namespace
}  // namespace limber::dynamics::equations_test
