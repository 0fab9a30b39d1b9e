// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/operating_states.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/surface_matrix.hpp"
#include "limber/reduction/state_balance.hpp"

namespace limber::flexbody {
namespace {

/// M a with a rigid acceleration field, 3 x N [N].
Matrix3X calc_rigid_inertia(const MeshedBody& body, const Vector3& center,
                            const Vector3& acceleration,
                            const Vector3& angular) {
  Matrix3X field(3, body.mesh.x.cols());
  for (Eigen::Index n = 0; n < field.cols(); ++n)
    field.col(n) = acceleration + angular.cross(body.mesh.x.col(n) - center);
  return field * body.M_s;
}

double sum(const fem::SparseMatrix& matrix) {
  return VectorX(matrix * VectorX::Ones(matrix.cols())).sum();
}

/// Where the drag of a translation acts [m].
Vector3 find_drag_center(const MeshedBody& body,
                         const fem::SparseMatrix& drag) {
  const VectorX nodal = drag * VectorX::Ones(drag.cols());
  return body.mesh.x * nodal / nodal.sum();
}

[[noreturn]] void refuse_turning(const MeshedBody& body, const NetLoad& net,
                                 const char* name, const Vector3& center,
                                 const Vector3& moment) {
  throw InputError(fmt::format(
      "{}: the load, {:.6g} N, has a moment ({:.4g}, {:.4g}, {:.4g}) N m about "
      "the centre of {} at ({:.6g}, {:.6g}, {:.6g}) m, which nothing balances: "
      "the body would rotate. Expected a load whose line passes through it.",
      body.mesh.source, net.force.norm(), moment[0], moment[1], moment[2], name,
      center[0], center[1], center[2]));
}

/// @throws InputError if the load has a moment about `center`.
void check_turning(const MeshedBody& body, const Matrix3X& load,
                   const char* name, const Vector3& center) {
  const NetLoad net = sum_load(body.mesh.x, load, center);
  const double size = load.colwise().norm().sum() * body.mesh.size().maxCoeff();
  if (net.moment.norm() > kBalanced * size)
    refuse_turning(body, net, name, center, net.moment);
}

}  // namespace

OperatingState find_accelerating_state(const MeshedBody& body,
                                       const Matrix3X& load) {
  check_load(body, load);
  OperatingState state;
  Matrix3X total = load;
  if (!body.support.is_clamped) {
    const fem::MassProperties mass =
        fem::calc_mass_properties(body.M_s, body.mesh.x);
    const Matrix3 inertia = mass.S0.trace() * Matrix3::Identity() - mass.S0;
    const NetLoad net = sum_load(body.mesh.x, load, mass.center);
    state.acceleration = net.force / mass.mass;
    state.angular_acceleration = inertia.ldlt().solve(net.moment);
    total -= calc_rigid_inertia(body, mass.center, state.acceleration,
                                state.angular_acceleration);
  }
  const MatrixX F = take_rows(total.reshaped(), body.support.free_nodes);
  fill_state(body, body.inverse.solve(F), total, state);
  return state;
}

OperatingState find_drifting_state(const MeshedBody& body, const Matrix3X& load,
                                   const Friction& friction) {
  check_load(body, load);
  const fem::SparseMatrix drag = make_drag(body, friction);
  if (body.support.is_clamped)
    throw InputError(fmt::format(
        "{}: the body is clamped, so it has no constant velocity. Expected a "
        "free body.",
        body.mesh.source));
  check_turning(body, load, "drag", find_drag_center(body, drag));
  OperatingState state;
  state.velocity = load.rowwise().sum() / sum(drag);
  const Matrix3X total = load - state.velocity.replicate(1, load.cols()) * drag;
  fill_state(body, body.inverse.solve(total.reshaped()), total, state);
  return state;
}

SlowChange find_slow_change(const MeshedBody& body, const Matrix3X& load,
                            const Friction& friction) {
  SlowChange change;
  change.drifting = find_drifting_state(body, load, friction);
  const fem::MassProperties mass =
      fem::calc_mass_properties(body.M_s, body.mesh.x);
  check_turning(body, load, "mass", mass.center);
  change.accelerating = find_accelerating_state(body, load);
  change.rate = sum(make_drag(body, friction)) / mass.mass;
  return change;
}

OperatingState SlowChange::at(double t, const MeshedBody& body) const {
  LIMBER_EXPECT(t >= 0.0);
  const double alpha = std::exp(-rate * t);
  const double beta = -std::expm1(-rate * t);
  OperatingState state;
  const Matrix3X u = alpha * accelerating.u + beta * drifting.u;
  const Matrix3X none = Matrix3X::Zero(3, u.cols());
  fill_state(body, take_rows(u.reshaped(), body.support.free_nodes), none,
             state);
  state.acceleration = alpha * accelerating.acceleration;
  state.velocity = beta * drifting.velocity;
  return state;
}

}  // namespace limber::flexbody
