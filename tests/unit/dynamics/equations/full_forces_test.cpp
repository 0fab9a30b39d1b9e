// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/full_lattice.hpp"
#include "support/paired_bodies.hpp"

/// Energies, momenta and forces of one body at level `full`, a network of
/// springs.
namespace limber::dynamics::full_forces_test {
namespace {

using testing::Lattice;
using testing::make_field;
using testing::stir;

struct Fields {  // in the world
  Matrix3X p;
  Matrix3X v;
};
Fields find_fields(const SystemModel& model, const SystemState& state) {
  const Matrix3X& x = model.full_bodies[0].mesh->x_B;
  const Pose& X_WH = state.X_WH[0];
  const Matrix3X moved = x + state.u_H.reshaped(3, x.cols());
  return {(X_WH.R * moved).colwise() + X_WH.p,
          X_WH.R * state.udot_H.reshaped(3, x.cols())};
}

// --- Energies and momenta ---------------------------------------------------

TEST(FullEnergy, AndMomentaAreThoseOfTheNodes) {
  const Lattice lattice;
  const SystemModel model = lattice.builder.build();
  const SystemState state = stir(model);
  const auto [p, v] = find_fields(model, state);
  const MatrixX& M = lattice.network.M_s;
  Vector3 spin = Vector3::Zero();
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    spin += Vector3(p.col(i)).cross(Vector3(v * M.col(i)));
  }
  const EnergyBalance energy = calc_energy(model, state);
  const double kinetic = 0.5 * (v * M).cwiseProduct(v).sum();
  EXPECT_NEAR(energy.kinetic_rigid + energy.kinetic_modal, kinetic,
              1e-13 * kinetic);
  EXPECT_GT(energy.kinetic_modal, 0.0);
  EXPECT_LT((energy.linear_momentum - v * M.rowwise().sum()).norm(), 1e-13);
  EXPECT_LT((energy.angular_momentum - spin).norm(), 1e-12);
}

TEST(FullEnergy, OfRigidMotionIsRigid) {
  const Lattice lattice;
  const SystemModel model = lattice.builder.build();
  SystemState state = make_state(model);
  state.bodies[0].quat_WB = exp_quaternion(Vector3(2.0, -1.0, 0.5));
  state.bodies[0].v_WB_W = Vector3(0.5, -1.0, 0.3);
  state.bodies[0].w_WB_B = Vector3(3.0, 1.0, -2.0);
  place_nodes(model, {}, {}, state);
  const EnergyBalance energy = calc_energy(model, state);
  const Vector3 w = state.bodies[0].w_WB_B;
  const double rigid = 0.5 * 2.0 * state.bodies[0].v_WB_W.squaredNorm() +
                       0.5 * w.dot(lattice.reduced->inertia() * w);
  EXPECT_NEAR(energy.kinetic_rigid, rigid, 1e-13 * rigid);
  EXPECT_NEAR(energy.kinetic_modal, 0.0, 1e-13 * rigid);
  EXPECT_EQ(energy.elastic, 0.0);
}

TEST(FullEnergy, OfABentBodyThatMovesAsOneIsRigid) {
  const Lattice lattice;
  const SystemModel model = lattice.builder.build();
  SystemState state = stir(model);
  const FullModel& full = model.full_bodies[0];
  const Matrix3X p = full.mesh->x_B + nodes_of(full, state.u_H);
  auto udot = nodes_of(full, state.udot_H);
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    udot.col(i) = Vector3(0.5, 0.2, -0.7) +
                  Vector3(3.0, -1.0, 2.0).cross(Vector3(p.col(i)));
  }
  const EnergyBalance energy = calc_energy(model, state);
  EXPECT_GT(energy.kinetic_rigid, 0.5);
  EXPECT_NEAR(energy.kinetic_modal, 0.0, 1e-12 * energy.kinetic_rigid);
}

// --- Forces -----------------------------------------------------------------

SystemTerms find_terms(const SystemModel& model, const SystemState& state) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  return terms;
}

Vector3 find_moment(const SystemModel& model, const SystemState& state,
                    const Matrix3X& force_H) {
  const auto [p, v] = find_fields(model, state);
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    sum += Vector3(p.col(i)).cross(Vector3(state.X_WH[0].R * force_H.col(i)));
  }
  return sum;
}

TEST(FullDamping, NeitherPushesNorTurnsADeformedBodyAndTakesItsPower) {
  const Lattice lattice({}, {.ratios = {0.1}});
  const SystemModel model = lattice.builder.build();
  const SystemState state = stir(model);
  const SystemTerms terms = find_terms(model, state);
  const Matrix3X& force = terms.full[0].force;
  ASSERT_GT(force.norm(), 10.0);
  const double roundoff = 1e-13 * force.norm();
  EXPECT_LT(force.rowwise().sum().norm(), roundoff);
  EXPECT_LT(find_moment(model, state, force).norm(), 10.0 * roundoff);
  EXPECT_NEAR(force.reshaped().dot(state.udot_H), -terms.bodies[0].dissipated,
              1e-12 * terms.bodies[0].dissipated);
  EXPECT_EQ(terms.bodies[0].supplied, 0.0);
}

TEST(FullDamping, LeavesRigidMotionAlone) {
  const Lattice lattice({}, {.ratios = {0.1}});
  const SystemModel model = lattice.builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W = Vector3(0.5, -1.0, 0.3);
  state.bodies[0].w_WB_B = Vector3(3.0, 1.0, -2.0);
  const MatrixX& Phi = lattice.reduced->rows.Phi_B;
  place_nodes(model, Phi * make_field(Phi.cols(), 1e-3, 3), {}, state);
  const SystemTerms terms = find_terms(model, state);
  EXPECT_LT(terms.full[0].force.norm(), 1e-10);
}

TEST(FullLoad, TurnsWithTheBodyOrStaysInTheWorld) {
  for (const char* name : {"last", "node", "edge"}) {
    for (const LoadFrame frame : {LoadFrame::body, LoadFrame::world}) {
      Lattice lattice;
      const Vector3 origin(0.02, 0.01, 0.2);
      const auto place = lattice.builder.attach_nodes(
          name, BodyIndex(0), find_node_set(*lattice.full, name),
          {exp_rotation(Vector3(1, 0, 0)), origin});
      const Vector3 force(1.0, -2.0, 3.0);
      const Vector3 moment(0.3, 0.1, -0.2);
      lattice.builder.add_load("push", place, force, moment, frame, Constant{});
      const SystemModel model = lattice.builder.build();
      const SystemState state = stir(model);
      const SystemTerms terms = find_terms(model, state);
      const Matrix3 R_W = frame == LoadFrame::world
                              ? Matrix3(Matrix3::Identity())
                              : state.bodies[0].quat_WB.toRotationMatrix();
      const FrameMotion at = find_frame_motion(model, state, place);
      const Matrix3X& nodal = terms.full[0].force;
      const Vector3 total = state.X_WH[0].R * nodal.rowwise().sum();
      EXPECT_LT((total - R_W * force).norm(), 1e-13) << name;
      const Vector3 about_origin = at.X_WF.p.cross(R_W * force) + R_W * moment;
      EXPECT_LT((find_moment(model, state, nodal) - about_origin).norm(), 1e-12)
          << name;
      const double power =
          (R_W * force).dot(at.v_WF_W) + (R_W * moment).dot(at.w_WF_W);
      EXPECT_NEAR(terms.bodies[0].supplied, power, 1e-13 * std::abs(power));
      EXPECT_NEAR(nodal.reshaped().dot(state.udot_H), power, 1e-12);
    }
  }
}

TEST(FullLoad, OfNodesTurnsWithTheBodyAndDoesItsWork) {
  Lattice lattice;
  const VectorX pattern = make_field(3 * lattice.network.size(), 1.0, 4);
  lattice.builder.add_nodal_load(
      "nodal", BodyIndex(0),
      flexbody::reduce_nodal_load(*lattice.reduced, {0.0}, pattern), pattern);
  const SystemModel model = lattice.builder.build();
  const SystemState state = stir(model);
  const SystemTerms terms = find_terms(model, state);
  const Matrix3 R_HB =
      state.X_WH[0].R.transpose() * state.bodies[0].quat_WB.toRotationMatrix();
  const Matrix3X expected = R_HB * pattern.reshaped(3, lattice.network.size());
  EXPECT_LT((terms.full[0].force - expected).norm(), 1e-13);
  EXPECT_NEAR(terms.bodies[0].supplied, expected.reshaped().dot(state.udot_H),
              1e-12);
}

// --- What pairs see ----------------------------------------------------------

TEST(FullPairMotion, HasTheNodesPlacesAndVelocities) {
  Lattice lattice;
  lattice.builder.add_pair(
      "touch", kWorld, BodyIndex(0),
      std::make_shared<testing::SphereContact>(1.0, 0.0, 0.1));
  const SystemModel model = lattice.builder.build();
  for (const SystemState& state : {stir(model), make_state(model)}) {
    const auto [p, v] = find_fields(model, state);
    const PairMotion motion = find_pair_motion(model, model.pairs[0], state);
    const joints::PairBody& body = motion.bodies().B;
    const Eigen::Index nodes = p.cols();
    ASSERT_EQ(body.modes, 3 * nodes + 1);
    double most_u = 0.0;
    double most_udot = 0.0;
    for (Eigen::Index n = 0; n < nodes; ++n) {
      const Eigen::Map<const Vector3> u(body.eta + 3 * n);
      const Eigen::Map<const Vector3> udot(body.etadot + 3 * n);
      const Vector3 arm = model.full_bodies[0].mesh->x_B.col(n) + u;
      EXPECT_LT((body.p_WB + body.R_WB * arm - p.col(n)).norm(), 1e-13);
      EXPECT_LT(
          (body.v_WB_W + body.R_WB * (body.w_WB_B.cross(arm) + udot) - v.col(n))
              .norm(),
          1e-12);
      most_u = std::max(most_u, u.norm());
      most_udot = std::max(most_udot, udot.norm());
    }
    EXPECT_NEAR(body.eta[3 * nodes], most_u, 1e-15);
    EXPECT_NEAR(body.etadot[3 * nodes], most_udot, 1e-14);
  }
}

}  // namespace
}  // namespace limber::dynamics::full_forces_test
