// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/terms/mean_frame.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/full_lattice.hpp"

namespace limber::dynamics::mean_frame_test {
namespace {

using testing::make_field;
using testing::make_full;
using testing::make_lattice;
using testing::make_reduced;
using testing::SpringNetwork;

const Vector3 kAxis = Vector3(0.3, -0.5, 0.7).normalized();

SystemModel make_model(const SpringNetwork& network,
                       const Vector3& offset = Vector3::Zero(),
                       int modes = 12) {
  auto reduced =
      std::make_shared<flexbody::ReducedBody>(*make_reduced(network, modes));
  // As a lumped mass does it: its centre is not at Bo.
  SpringNetwork moved = network;
  moved.x_B.colwise() += offset;
  reduced->rows.x_B = moved.x_B;
  SystemBuilder builder;
  builder.add_full_body("lattice", reduced, make_full(moved), {});
  return builder.build();
}

MeanFrame find_frame(const SystemModel& model, const SystemState& state) {
  MeanFrame frame;
  calc_mean_frame(model, model.full_bodies[0], state, frame);
  return frame;
}

TEST(MeanFrame, FollowsARigidMotionOfAnyAngle) {
  const Vector3 p(3.0, -1.0, 0.5);
  const Vector3 w(2.0, -1.0, 0.4);
  const Vector3 v(0.3, 0.2, -5.0);
  for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(0.01, 0.02, -0.03)}) {
    const SystemModel model = make_model(make_lattice(), offset);
    const Matrix3X& x = model.full_bodies[0].mesh->x_B;
    for (const double angle : {0.0, 0.1, 3.0, std::numbers::pi, 5.0}) {
      const Matrix3 turn = exp_rotation(angle * kAxis);
      SystemState state = make_state(model);
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Vector3 arm = turn * x.col(i);
        state.u_H.segment<3>(3 * i) = p + arm - x.col(i);
        state.udot_H.segment<3>(3 * i) = v + w.cross(arm);
      }
      const MeanFrame frame = find_frame(model, state);
      EXPECT_LT((frame.R_HB - turn).norm(), 1e-13);
      EXPECT_LT((frame.p_HB - p).norm(), 1e-14);
      EXPECT_LT((frame.w_H - w).norm(), 1e-12);
      EXPECT_LT((frame.v_H - v).norm(), 1e-13);
      Matrix3X u_B(3, x.cols());
      const SystemState& now = state;
      calc_deformation(model.full_bodies[0], frame,
                       nodes_of(model.full_bodies[0], now.u_H), u_B);
      EXPECT_LT(u_B.norm(), 1e-13);
    }
  }
}

TEST(MeanFrame, VelocitiesAreTheDerivativesOfItsPose) {
  const SystemModel model =
      make_model(make_lattice(), Vector3(0.01, 0.02, -0.03));
  SystemState state = make_state(model);
  state.bodies[0].quat_WB = exp_quaternion(2.0 * kAxis);
  place_nodes(model, make_field(model.nodal_count, 0.02, 1),
              make_field(model.nodal_count, 1.0, 2), state);
  const MeanFrame frame = find_frame(model, state);
  constexpr double kStep = 1e-6;
  SystemState ahead = state;
  SystemState behind = state;
  ahead.u_H += kStep * state.udot_H;
  behind.u_H -= kStep * state.udot_H;
  const MeanFrame a = find_frame(model, ahead);
  const MeanFrame b = find_frame(model, behind);
  const Vector3 w =
      log_rotation(Matrix3(a.R_HB * b.R_HB.transpose())) / (2.0 * kStep);
  const Vector3 v = (a.p_HB - b.p_HB) / (2.0 * kStep);
  EXPECT_LT((frame.w_H - w).norm(), 1e-8 * w.norm());
  EXPECT_LT((frame.v_H - v).norm(), 1e-8 * v.norm());
  // The same in the world.
  update_mean_frames(model, state);
  const BodyState& body = state.bodies[0];
  const Matrix3 R_WH = state.X_WH[0].R;
  EXPECT_LT((body.v_WB_W - R_WH * frame.v_H).norm(), 1e-15);
  EXPECT_LT((body.quat_WB * body.w_WB_B - R_WH * frame.w_H).norm(), 1e-13);
}

TEST(MeanFrame, OfADeformationInTheModesIsTheUndeformedOne) {
  const SystemModel model = make_model(make_lattice());
  const MatrixX& Phi = model.bodies[0].reduced->rows.Phi_B;
  const VectorX eta = make_field(Phi.cols(), 0.01, 3);
  const VectorX etadot = make_field(Phi.cols(), 1.0, 4);
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(1, 2, 3);
  state.bodies[0].quat_WB = exp_quaternion(2.0 * kAxis);
  state.bodies[0].v_WB_W = Vector3(0.1, 0.2, 0.3);
  const BodyState before = state.bodies[0];
  place_nodes(model, Phi * eta, Phi * etadot, state);
  const MeanFrame frame = find_frame(model, state);
  EXPECT_LT((frame.R_HB - Matrix3::Identity()).norm(), 1e-13);
  EXPECT_LT(frame.p_HB.norm(), 1e-15);
  EXPECT_LT((state.bodies[0].p_WB - before.p_WB).norm(), 1e-14);
  EXPECT_LT((state.bodies[0].v_WB_W - before.v_WB_W).norm(), 1e-13);
  MatrixX u_B(Phi.rows(), 1);
  calc_node_deformations(model, BodyIndex(0), {&state, 1}, u_B);
  EXPECT_LT((u_B - Phi * eta).norm(), 1e-14);
  // A reduced body spins about the same axes: H etadot is not in w.
  const VectorX back = Phi.transpose() * make_lattice().mass() * u_B.col(0);
  EXPECT_LT((back - eta).norm(), 1e-13);
}

TEST(MeanFrame, PlacedNodesSpinAsTheBodyWasAskedTo) {
  const SystemModel model = make_model(make_lattice());
  const MatrixX& Phi = model.bodies[0].reduced->rows.Phi_B;
  SystemState state = make_state(model);
  state.bodies[0].quat_WB = exp_quaternion(2.0 * kAxis);
  const Vector3 w(3.0, -2.0, 1.0);
  state.bodies[0].w_WB_B = w;
  // Deformed: the mean frame of v = w x (x + u) is w itself.
  place_nodes(model, Phi * make_field(Phi.cols(), 0.01, 5),
              Phi * make_field(Phi.cols(), 1.0, 6), state);
  EXPECT_LT((state.bodies[0].w_WB_B - w).norm(), 1e-12);
}

TEST(MeanFrame, OfAClampedBodyRests) {
  const SystemModel model = make_model(make_lattice({.is_clamped = true}));
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(1, 2, 3);
  state.bodies[0].quat_WB = exp_quaternion(2.0 * kAxis);
  const MatrixX& Phi = model.bodies[0].reduced->rows.Phi_B;
  place_nodes(model, Phi * make_field(Phi.cols(), 0.01, 5), {}, state);
  EXPECT_LT((state.bodies[0].p_WB - Vector3(1, 2, 3)).norm(), 1e-15);
  EXPECT_EQ(state.bodies[0].w_WB_B, Vector3::Zero());
  MatrixX u_B(Phi.rows(), 1);
  calc_node_deformations(model, BodyIndex(0), {&state, 1}, u_B);
  EXPECT_LT((u_B.col(0) - state.u_H).norm(), 1e-15);
}

}  // namespace
}  // namespace limber::dynamics::mean_frame_test
