// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace limber::contact {

/// A bristle, a spring s in parallel with a damper, whose force
/// friction limits: in the tangent plane (n = 3) or about the normal (n
/// = 1).
///
/// Equation   with the trial s* = s_0 + increment:
///            s = s* min(1, L / (k |s*|)),
///            t = x min(1, L / |x|),  x = -k s - c v
/// Source     return mapping: [@wriggers2006, ch. 5]; here the spring's force
///            is returned to the cone first, then the sum with the damper's, so
///            that slip and damper can only dissipate.
template <int n>
struct ConeReturn {
  using Vector = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n>;

  struct Input {
    const Vector& trial;     ///< s* [m or rad]
    const Vector& velocity;  ///< v [m/s or rad/s]
    const Matrix& plane;     ///< projector P on the space of s and v [-]
    double stiffness = 0.0;  ///< k >= 0 [N/m or N m/rad]
    double damping = 0.0;    ///< c >= 0 [N s/m or N m s/rad]
    double limit = 0.0;      ///< L >= 0 [N or N m]
  };

  Vector force = Vector::Zero();        ///< t [N or N m]
  Vector bristle = Vector::Zero();      ///< s [m or rad]
  bool slips = false;                   ///< whether L limits s or t
  double energy = 0.0;                  ///< k s^2 / 2 [J]
  double slip_work = 0.0;               ///< k s . (s* - s) >= 0 [J]
  double damper_power = 0.0;            ///< -(t + k s) . v >= 0 [W]
  Matrix by_trial = Matrix::Zero();     ///< dt/ds* [N/m or N m/rad]
  Matrix by_velocity = Matrix::Zero();  ///< dt/dv, L held [N s/m, N m s/rad]
  Vector by_limit = Vector::Zero();     ///< dt/dL [-]

  [[nodiscard]] static ConeReturn find(const Input& in) {
    ConeReturn out;
    const double k = in.stiffness;
    const double L = in.limit;
    // The spring.
    out.bristle = in.trial;
    Matrix bristle_by_trial = in.plane;
    Vector spring_by_limit = Vector::Zero();
    const double length = in.trial.norm();
    if (k * length > L) {
      const Vector direction = in.trial / length;
      out.slips = true;
      out.bristle = (L / k) * direction;
      bristle_by_trial = L / (k * length) * reject(in.plane, direction);
      spring_by_limit = direction;  // of k s
      out.slip_work = L * (length - L / k);
    }
    out.energy = 0.5 * k * out.bristle.squaredNorm();
    // The sum.
    const Vector sum = -k * out.bristle - in.damping * in.velocity;
    out.force = sum;
    Matrix by_sum = in.plane;
    const double size = sum.norm();
    if (size > L) {
      const Vector direction = sum / size;
      out.slips = true;
      out.force = L * direction;
      by_sum = (L / size) * reject(in.plane, direction);
      out.by_limit = direction;
    }
    out.by_limit -= by_sum * spring_by_limit;
    out.by_trial = -k * by_sum * bristle_by_trial;
    out.by_velocity = -in.damping * by_sum;
    out.damper_power = -(out.force + k * out.bristle).dot(in.velocity);
    return out;
  }

 private:
  static Matrix reject(const Matrix& plane, const Vector& direction) {
    return plane - direction * direction.transpose();
  }
};

}  // namespace limber::contact
