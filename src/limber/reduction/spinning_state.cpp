// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/spin.hpp"
#include "limber/reduction/operating_states.hpp"
#include "limber/reduction/state_balance.hpp"

namespace limber::flexbody {
namespace {

/// @throws InputError for an axis of no direction.
Vector3 find_direction(const MeshedBody& body, const SpinAxis& axis) {
  const double length = axis.direction.norm();
  if (!std::isfinite(length) || length == 0.0 || !axis.point.allFinite())
    throw InputError(fmt::format(
        "{}: the spin axis ({}, {}, {}) through ({}, {}, {}) m has no "
        "direction. Expected a finite vector other than 0.",
        body.mesh.source, axis.direction[0], axis.direction[1],
        axis.direction[2], axis.point[0], axis.point[1], axis.point[2]));
  return axis.direction / length;
}

void check_speed(const MeshedBody& body, double speed, double critical) {
  if (std::abs(speed) < critical) return;
  throw InputError(fmt::format(
      "{}: an angular speed of {:.6g} rad/s is not below the critical speed of "
      "{:.6g} rad/s about this axis, where linear theory has no steady "
      "deformation. Expected a lower speed, or level full.",
      body.mesh.source, std::abs(speed), critical));
}

/// The body in a frame that rotates about n.
class Spin {
 public:
  Spin(const MeshedBody& body, const SpinAxis& axis)
      : body_(body),
        n_(find_direction(body, axis)),
        r_(body.mesh.x.colwise() - axis.point),
        critical_(fem::find_critical_speed(body.inverse, n_)) {}

  [[nodiscard]] const Vector3& direction() const { return n_; }
  [[nodiscard]] double critical() const { return critical_; }

  /// n x (r + u): the velocity of the nodes at unit speed [m].
  [[nodiscard]] Matrix3X calc_turning(const Matrix3X& u) const {
    Matrix3X turning(3, r_.cols());
    for (Eigen::Index i = 0; i < r_.cols(); ++i)
      turning.col(i) = n_.cross(Vector3(r_.col(i) + u.col(i)));
    return turning;
  }

  /// n . sum (r + u) x F [N m].
  [[nodiscard]] double calc_torque(const Matrix3X& u, const Matrix3X& F) const {
    return calc_turning(u).cwiseProduct(F).sum();
  }

  /// Omega^2 M E (r + u): centrifugal forces [N].
  [[nodiscard]] Matrix3X calc_centrifugal(double speed,
                                          const Matrix3X& u) const {
    const Matrix3X arm = r_ + u;
    const Matrix3X normal = arm - n_ * (n_.transpose() * arm);
    return speed * speed * (normal * body_.M_s);
  }

  /// The deformation under additional forces, on the free nodes.
  [[nodiscard]] VectorX solve(double speed, const Matrix3X& F) const {
    check_speed(body_, speed, critical_);
    const Matrix3X rest = Matrix3X::Zero(3, r_.cols());
    const Matrix3X load = F + calc_centrifugal(speed, rest);
    return fem::solve_spun(
        body_.inverse, n_, speed,
        take_rows(load.reshaped(), body_.support.free_nodes));
  }

  [[nodiscard]] Matrix3X on_all_nodes(const VectorX& x) const {
    return put_rows(x, body_.support.free_nodes, r_.cols())
        .reshaped(3, r_.cols());
  }

 private:
  const MeshedBody& body_;
  Vector3 n_;
  Matrix3X r_;  ///< relative to the axis's point
  double critical_;
};

OperatingState make_state(const MeshedBody& body, const Spin& spin,
                          double speed, const VectorX& x, const Matrix3X& F) {
  OperatingState state;
  state.angular_velocity = speed * spin.direction();
  state.critical_speed = spin.critical();
  fill_state(body, x, F + spin.calc_centrifugal(speed, spin.on_all_nodes(x)),
             state);
  return state;
}

/// @throws InputError if a free body has a net force.
void check_net_force(const MeshedBody& body, const Matrix3X& load) {
  const Vector3 net = load.rowwise().sum();
  if (body.support.is_clamped ||
      net.norm() <= kBalanced * load.colwise().norm().sum())
    return;
  throw InputError(fmt::format(
      "{}: the load of a free body that is to spin steadily has a net force "
      "({:.4g}, {:.4g}, {:.4g}) N, which would carry it away. Expected forces "
      "that sum to 0 and have a torque about the axis.",
      body.mesh.source, net[0], net[1], net[2]));
}

/// @throws InputError if nothing rotates the body.
void check_torque(const MeshedBody& body, const Matrix3X& load, double torque) {
  const double size = load.colwise().norm().sum() * body.mesh.size().maxCoeff();
  if (std::abs(torque) > 1e-12 * size) return;
  throw InputError(fmt::format(
      "{}: the load has no torque about the spin axis ({:.3g} N m), so nothing "
      "keeps the body rotating against friction. Expected one other than 0.",
      body.mesh.source, torque));
}

}  // namespace

OperatingState find_spinning_state(const MeshedBody& body, const SpinAxis& axis,
                                   double speed) {
  static_cast<void>(find_direction(body, axis));
  if (!std::isfinite(speed) || speed == 0.0)
    throw InputError(fmt::format(
        "{}: no load: at {} rad/s the operating state is trivial or none. "
        "Expected an angular speed other than 0.",
        body.mesh.source, speed));
  const Spin spin(body, axis);
  const Matrix3X none = Matrix3X::Zero(3, body.mesh.x.cols());
  return make_state(body, spin, speed, spin.solve(speed, none), none);
}

OperatingState find_driven_spin_state(const MeshedBody& body,
                                      const SpinAxis& axis,
                                      const Matrix3X& load,
                                      const Friction& friction) {
  constexpr int kMaxSteps = 200;
  constexpr double kTolerance = 1e-13;  // change, relative
  constexpr double kStalled = 1e-9;     // roundoff of the deformation
  check_load(body, load);
  const fem::SparseMatrix drag = make_drag(body, friction);
  check_net_force(body, load);
  const Spin spin(body, axis);
  Matrix3X u = Matrix3X::Zero(3, body.mesh.x.cols());
  check_torque(body, load, spin.calc_torque(u, load));
  double previous = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const Matrix3X turning = spin.calc_turning(u);
    const Matrix3X resisted = turning * drag;
    const double speed =
        turning.cwiseProduct(load).sum() / turning.cwiseProduct(resisted).sum();
    const Matrix3X forces = load - speed * resisted;
    const VectorX x = spin.solve(speed, forces);
    const Matrix3X next = spin.on_all_nodes(x);
    const double change = (next - u).norm() / next.norm();
    u = next;
    if (change <= kTolerance || (change > 0.5 * previous && change <= kStalled))
      return make_state(body, spin, speed, x, forces);
    previous = change;
  }
  throw NumericalError(fmt::format(
      "{}: spin under a torque: speed and deformation do not settle in {} "
      "steps (last change {:.3g}): the deformation feeds back too strongly. "
      "Take a smaller load or less friction.",
      body.mesh.source, kMaxSteps, previous));
}

}  // namespace limber::flexbody
