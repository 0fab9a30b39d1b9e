// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/nodal_rotation.hpp"

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Displacements at the end; returns false and writes nothing for a body that
// hardly rotates.
bool predict_rotated_nodes(const SystemModel& model, const FullModel& full,
                           const SystemState& from, const ConstNodes& uddot,
                           double h, double s, Nodes u_H) {
  constexpr double kLeastRotation = 0.01;  // [rad]
  MeanFrame frame;
  calc_mean_frame(model, full, from, frame);
  const Vector3& w = frame.w_H;
  if (!(h * w.norm() > kLeastRotation)) return false;
  const flexbody::FullBody& mesh = *full.mesh;
  const ConstNodes u = nodes_of(full, from.u_H);
  Vector3 spin = Vector3::Zero();
  Vector3 mean = Vector3::Zero();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 r = mesh.x_B.col(i) + u.col(i) - frame.p_HB;
    const Vector3 y_H = frame.R_HB * mesh.first_moment.col(i);
    spin += y_H.cross(uddot.col(i) - w.cross(w.cross(r)));
    mean += mesh.node_mass[i] * uddot.col(i);
  }
  const Vector3 wdot = frame.spread * spin;
  const Vector3 c = frame.center_H - frame.p_HB;
  const Vector3 pddot =
      mean / mesh.node_mass.sum() - w.cross(w.cross(c)) - wdot.cross(c);
  const Vector3 path = h * frame.v_H + s * h * h * pddot;
  const Matrix3 rotation =
      exp_quaternion(h * w + s * h * h * wdot).toRotationMatrix();
  const Matrix3 change = rotation - Matrix3::Identity();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 r = mesh.x_B.col(i) + u.col(i) - frame.p_HB;
    u_H.col(i) = u.col(i) + path + change * r;
  }
  return true;
}

void rotate_correction(const SystemModel& model, const FullModel& full,
                       const SystemState& state, Nodes d_H) {
  constexpr double kLeastRotation = 1e-8;  // its square is round-off [rad]
  MeanFrame frame;
  calc_mean_frame(model, full, state, frame);
  Vector3 spin = Vector3::Zero();
  for (Eigen::Index i = 0; i < d_H.cols(); ++i) {
    const Vector3 y_H = frame.R_HB * full.mesh->first_moment.col(i);
    spin += y_H.cross(d_H.col(i));
  }
  const Vector3 theta = frame.spread * spin;
  if (!(theta.norm() > kLeastRotation)) return;
  const Matrix3 rest = exp_rotation(theta) - Matrix3::Identity() - skew(theta);
  const ConstNodes u = nodes_of(full, state.u_H);
  for (Eigen::Index i = 0; i < d_H.cols(); ++i) {
    d_H.col(i) += rest * (full.mesh->x_B.col(i) + u.col(i) - frame.p_HB);
  }
}

}  // namespace

bool predict_rotations(const SystemModel& model, const SystemState& from,
                       const VectorX& accelerations, const VectorX& a,
                       const NewmarkStep& step, VectorX& a_next) {
  const auto [h, lag, beta] = step;
  bool rotates = false;
  for (const FullModel& full : model.full_bodies) {
    Nodes next = nodal_rows(model, full, a_next);
    if (!predict_rotated_nodes(model, full, from,
                               nodal_rows(model, full, accelerations), h,
                               lag + beta, next)) {
      continue;
    }
    next -= nodes_of(full, from.u_H) + h * nodes_of(full, from.udot_H) +
            h * h * lag * nodal_rows(model, full, a);
    next /= h * h * beta;
    rotates = true;
  }
  return rotates;
}

void rotate_corrections(const SystemModel& model, const SystemState& state,
                        VectorX& correction) {
  for (const FullModel& full : model.full_bodies) {
    if (model.bodies[static_cast<std::size_t>(full.body)].clamped) continue;
    rotate_correction(model, full, state, nodal_rows(model, full, correction));
  }
}

}  // namespace limber::dynamics
