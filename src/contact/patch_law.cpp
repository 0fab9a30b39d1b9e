// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patch_law.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/restitution.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/law/bristle_friction.hpp"
#include "limber/contact/law/cone_return.hpp"

namespace limber::contact {
namespace {

Matrix6 find_pressure_matrix(const Patch& patch) {
  const double N = patch.load();
  const Vector3 n = patch.normal_W();
  const Matrix3 turn = skew(n);
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>() = N * n * n.transpose();
  D.bottomRightCorner<3, 3>() = N * turn * patch.spread_W * turn.transpose();
  return D;
}

}  // namespace

PatchLaw::PatchLaw(const ContactParameters& parameters, double tangential_ratio)
    : friction_(parameters.friction),
      tangential_ratio_(tangential_ratio),
      has_friction_(friction_.sliding + friction_.excess > 0.0),
      factor_(0.0) {
  check(parameters);
  factor_ = find_restitution_factor(parameters.restitution);
}

double PatchLaw::find_square(const Patch& patch, const Vector6& twist_W) {
  return twist_W.dot(find_pressure_matrix(patch) * twist_W);
}

// -s D twist, D of pressure along the normal; with d = D twist and vv = d .
// twist, ds = -s / (2 v^2) (d(vv / N) + 2 dW / m), d the change; that of other
// patches is left out.
void PatchLaw::add_damping(const Input& in, PatchResponse& out) const {
  const Patch& patch = in.patch;
  const double N = in.all.load;
  const Vector3 n = patch.normal_W();
  const Matrix6 D = find_pressure_matrix(patch);
  const Vector6 d = D * in.twist_W;
  const double square =
      in.all.square / N + 2.0 * in.all.energy * in.all.inverse_mass;
  if (factor_ == 0.0 || !(square > 0.0)) return;
  const double s = factor_ / std::sqrt(square);
  const double slope = -0.5 * s / square;
  const Vector6 load_by_motion = -patch.hessian_W.topRows<3>().transpose() * n;
  const Vector6 s_by_motion =
      slope * 2.0 * in.all.inverse_mass * patch.gradient_W;
  const Vector6 s_by_twist = slope * 2.0 / N * d;
  const double normal = -s * n.dot(d.head<3>());
  // Nothing pulls.
  const double share =
      out.normal_force + normal < 0.0 ? -out.normal_force / normal : 1.0;
  out.wrench.wrench_W -= share * s * d;
  out.wrench.stiffness_W +=
      share * d * (s / patch.load() * load_by_motion + s_by_motion).transpose();
  out.wrench.damping_W += share * (s * D + d * s_by_twist.transpose());
  out.normal_force = std::max(out.normal_force + normal, 0.0);
  out.damped = share * s * d.dot(in.twist_W);
}

void PatchLaw::add_friction(const Input& in, PatchResponse& out) const {
  const Vector3& n = out.normal_W;
  const double elastic = in.elastic_W.head<3>().norm();
  const double k =
      tangential_ratio_ * elastic * elastic / (2.0 * in.patch.energy);
  const double r_e = find_spin_radius(in.patch.spread_W, n);
  // Two directions and the turn times r_e.
  Eigen::Matrix<double, 6, 3> E = Eigen::Matrix<double, 6, 3>::Zero();
  E.block<3, 1>(0, 0) = n.unitOrthogonal();
  E.block<3, 1>(0, 1) = n.cross(Vector3(E.block<3, 1>(0, 0)));
  E.block<3, 1>(3, 2) = r_e * n;
  const auto tangent = E.topLeftCorner<3, 2>().transpose();
  // The spring keeps its length in the tangent plane.
  Eigen::Vector2d spring = tangent * in.slip.spring_W;
  const double length = spring.norm();
  if (length > 0.0) spring *= in.slip.spring_W.norm() / length;
  Vector3 trial;
  trial << spring, in.slip.spin;
  // Springs that are let go with the load, or get company, lose energy.
  const double last = in.slip.stiffness;
  const double square = trial.squaredNorm();
  const double stiffer = std::max(last, k);
  double let_go = 0.0;
  if (square > 0.0) {
    let_go = 0.5 * square * (1.0 / last - k / (stiffer * stiffer));
    trial /= stiffer;
  }
  trial.head<2>() += tangent * in.slip.way_W;
  trial[2] += r_e * in.slip.turn;
  const Vector3 velocity = E.transpose() * in.twist_W;
  const double mu = find_coefficient(friction_, velocity.norm()).value;
  const Matrix3 plane = Matrix3::Identity();
  const auto cone = ConeReturn<3>::find(
      {.trial = trial,
       .velocity = velocity,
       .plane = plane,
       .stiffness = k,
       .damping = find_bristle_damping(k, 1.0 / in.all.inverse_mass),
       .limit = mu * out.normal_force});
  PatchWrench& wrench = out.wrench;
  const auto by_limit = E * (mu * cone.by_limit);
  const Vector6 normal_by_motion =
      wrench.stiffness_W.topRows<3>().transpose() * n;
  const Vector6 normal_by_twist = wrench.damping_W.topRows<3>().transpose() * n;
  wrench.wrench_W += E * cone.force;
  wrench.stiffness_W += by_limit * normal_by_motion.transpose() -
                        in.way_by_motion * E * cone.by_trial * E.transpose();
  wrench.damping_W += by_limit * normal_by_twist.transpose() -
                      E * cone.by_velocity * E.transpose();
  out.friction_W = E.topRows<3>() * cone.force;
  out.slips = cone.slips;
  out.energy = cone.energy;
  out.slip_work = cone.slip_work + let_go;
  out.rubbed = cone.damper_power;
  out.friction_power = cone.force.dot(velocity);
  out.next.spring_W = k * (E.topRows<3>() * cone.bristle);
  out.next.spin = k * cone.bristle[2];
  out.next.stiffness = k;
}

PatchResponse PatchLaw::evaluate(const Input& in) const {
  PatchResponse out;
  out.wrench.wrench_W = in.elastic_W;
  out.wrench.stiffness_W = in.patch.hessian_W;
  out.normal_force = in.elastic_W.head<3>().norm();
  if (!(out.normal_force > 0.0)) return out;
  out.normal_W = in.elastic_W.head<3>() / out.normal_force;
  add_damping(in, out);
  if (has_friction_) add_friction(in, out);
  return out;
}

double find_spin_radius(const Matrix3& spread_W, const Vector3& normal_W) {
  const Vector3 u = normal_W.unitOrthogonal();
  const Vector3 v = normal_W.cross(u);
  const double a = u.dot(spread_W * u);
  const double b = v.dot(spread_W * v);
  const double c = u.dot(spread_W * v);
  const double trace = std::max(a + b, 0.0);
  if (trace == 0.0) return 0.0;
  // Of the roots of both principal moments.
  const double root = std::sqrt(0.25 * (a - b) * (a - b) + c * c);
  const double ratio =
      std::sqrt(std::max(0.5 * trace - root, 0.0) / (0.5 * trace + root));
  return (0.943 - 0.077 * (1.0 - ratio)) * std::sqrt(trace);
}

}  // namespace limber::contact
