// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/terms/mean_frame.hpp"

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/nodal_frame.hpp"

namespace limber::dynamics {
namespace {

const BodyModel& body_of(const SystemModel& model, const FullModel& full) {
  return model.bodies[static_cast<std::size_t>(full.body)];
}

}  // namespace

void calc_mean_frame(const SystemModel& model, const FullModel& full,
                     const SystemState& state, MeanFrame& frame) {
  frame = MeanFrame{};
  if (body_of(model, full).clamped) return;
  const flexbody::FullBody& mesh = *full.mesh;
  const ConstNodes u = nodes_of(full, state.u_H);
  const ConstNodes udot = nodes_of(full, state.udot_H);
  const double mass = mesh.node_mass.sum();
  // A = sum_i (x_i + u_i) y_i^T with y the first moment; its columns sum to 0.
  const Matrix3 A = mesh.x_B * mesh.first_moment.transpose() +
                    u * mesh.first_moment.transpose();
  frame.R_HB = find_polar_rotation(A);
  const Matrix3 S = frame.R_HB * A.transpose();
  Vector3 spin = Vector3::Zero();
  Vector3 mean_x = Vector3::Zero();
  Vector3 mean_u = Vector3::Zero();
  Vector3 mean_v = Vector3::Zero();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 y_H = frame.R_HB * mesh.first_moment.col(i);
    const Vector3 v = udot.col(i);
    spin += y_H.cross(v);
    mean_x += mesh.node_mass[i] * mesh.x_B.col(i);
    mean_u += mesh.node_mass[i] * u.col(i);
    mean_v += mesh.node_mass[i] * v;
  }
  frame.spread = (S.trace() * Matrix3::Identity() - S).inverse();
  frame.w_H = frame.spread * spin;
  mean_x /= mass;
  // The mean of a lumped mass need not be at Bo.
  const Vector3 offset = frame.R_HB * mean_x;
  frame.center_H = mean_x + mean_u / mass;
  frame.p_HB = frame.center_H - offset;
  frame.v_H = mean_v / mass - frame.w_H.cross(offset);
}

void add_mean_wrench(const flexbody::FullBody& mesh, const MeanFrame& frame,
                     const Vector3& force_H, const Vector3& moment_H,
                     Eigen::Ref<Matrix3X> nodal) {
  const Vector3 fraction = force_H / mesh.node_mass.sum();
  const Vector3 rotation_B = frame.R_HB.transpose() * (frame.spread * moment_H);
  for (Eigen::Index i = 0; i < nodal.cols(); ++i) {
    const Vector3 y = mesh.first_moment.col(i);
    nodal.col(i) +=
        mesh.node_mass[i] * fraction + frame.R_HB * rotation_B.cross(y);
  }
}

void calc_deformation(const FullModel& full, const MeanFrame& frame,
                      const ConstNodes& u_H, Eigen::Ref<Matrix3X> u_B) {
  const Matrix3X& x = full.mesh->x_B;
  // R^T (x + u - p) - x = R^T (u - p - (R - I) x), without cancellation.
  const Matrix3 rotation = frame.R_HB - Matrix3::Identity();
  const Matrix3 R_BH = frame.R_HB.transpose();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vector3 u = u_H.col(i) - frame.p_HB - rotation * x.col(i);
    u_B.col(i) = R_BH * u;
  }
}

void place_nodes(const SystemModel& model, const VectorX& u_B,
                 const VectorX& udot_B, SystemState& state) {
  LIMBER_EXPECT(u_B.size() == 0 || u_B.size() == model.nodal_count);
  LIMBER_EXPECT(udot_B.size() == 0 || udot_B.size() == model.nodal_count);
  state.u_H = VectorX::Zero(model.nodal_count);
  state.udot_H = VectorX::Zero(model.nodal_count);
  if (u_B.size() > 0) state.u_H = u_B;
  if (udot_B.size() > 0) state.udot_H = udot_B;
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    const BodyState& body = state.bodies[static_cast<std::size_t>(full.body)];
    state.X_WH[f] = {body.quat_WB.toRotationMatrix(), body.p_WB};
    if (body_of(model, full).clamped) continue;
    const Vector3 v = state.X_WH[f].R.transpose() * body.v_WB_W;
    const Nodes u = nodes_of(full, state.u_H);
    Nodes udot = nodes_of(full, state.udot_H);
    for (Eigen::Index i = 0; i < u.cols(); ++i) {
      const Vector3 b = full.mesh->x_B.col(i) + u.col(i);
      udot.col(i) += v + body.w_WB_B.cross(b);
    }
  }
  update_mean_frames(model, state);
}

void update_mean_frames(const SystemModel& model, SystemState& state) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    MeanFrame frame;
    calc_mean_frame(model, full, state, frame);
    const Pose& X_WH = state.X_WH[f];
    BodyState& body = state.bodies[static_cast<std::size_t>(full.body)];
    body.p_WB = X_WH * frame.p_HB;
    body.quat_WB = Quaternion(Matrix3(X_WH.R * frame.R_HB)).normalized();
    body.v_WB_W = X_WH.R * frame.v_H;
    body.w_WB_B = frame.R_HB.transpose() * frame.w_H;
  }
}

}  // namespace limber::dynamics
