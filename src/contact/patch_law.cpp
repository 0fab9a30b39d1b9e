// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patch_law.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/restitution.hpp"
#include "limber/common/rotation.hpp"

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

// Of Hertz's area, 2/3 (a / r_e)^2 with r_e = 0.943 sqrt(0.4) a.
constexpr double kSpinRatio = 1.875;

LoadShells make_patch_shells(const ContactParameters& parameters,
                             const PairModuli& moduli) {
  LoadShells::Parameters shells;
  shells.limit = parameters.friction;
  shells.tangential_ratio = moduli.tangential_ratio();
  shells.spin_ratio = kSpinRatio * moduli.torsional / moduli.tangential;
  return LoadShells(shells);
}

}  // namespace

PatchLaw::PatchLaw(const ContactParameters& parameters,
                   const PairModuli& moduli)
    : shells_(make_patch_shells(parameters, moduli)),
      has_friction_(parameters.friction.sliding + parameters.friction.excess >
                    0.0),
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
  const FrictionFrame frame(out.normal_W);
  const double elastic = in.elastic_W.head<3>().norm();
  const double k = elastic * elastic / (2.0 * in.patch.energy);
  const double r_e = find_spin_radius(in.patch.spread_W, frame.normal_W);
  // Two directions and the turn times r_e.
  Eigen::Matrix<double, 6, 3> E = Eigen::Matrix<double, 6, 3>::Zero();
  E.topLeftCorner<3, 2>() = frame.plane_W;
  E.bottomRightCorner<3, 1>() = r_e * frame.normal_W;
  const PatchSlip& slip = in.slip;
  ShellMotion motion;
  motion.increment << frame.plane_W.transpose() * slip.way_W,
      r_e * find_turn(slip.last, frame, slip.turns);
  motion.velocity = E.transpose() * in.twist_W;
  const double k_t = shells_.parameters().tangential_ratio * k;
  const ShellResponse shells = shells_.evaluate(
      recall_friction(slip.last, frame, slip.turns),
      {.force = elastic, .stiffness = k, .grip = out.normal_force / elastic},
      motion, find_spring_damping(k_t, 1.0 / in.all.inverse_mass));
  PatchWrench& wrench = out.wrench;
  // The load is the grip's times the elastic one: both in the normal force.
  const auto by_normal = E * (shells.by_grip / elastic);
  const Vector6 normal_by_motion =
      wrench.stiffness_W.topRows<3>().transpose() * frame.normal_W;
  const Vector6 normal_by_twist =
      wrench.damping_W.topRows<3>().transpose() * frame.normal_W;
  wrench.wrench_W += E * shells.force;
  wrench.stiffness_W +=
      by_normal * normal_by_motion.transpose() -
      in.way_by_motion * E * shells.by_increment * E.transpose();
  wrench.damping_W += by_normal * normal_by_twist.transpose() -
                      E * shells.by_velocity * E.transpose();
  out.friction_W = frame.plane_W * shells.force.head<2>();
  out.slips = shells.slips;
  out.energy = shells.energy;
  out.slip_work = shells.slip_work;
  out.rubbed = shells.damper_power;
  out.friction_power = shells.force.dot(motion.velocity);
  out.next = keep_friction(shells.next, frame, slip.turns);
}

double PatchLaw::find_energy(const FrictionMemory& memory) const {
  ShellMemory shells;
  for (std::size_t i = 0; i < kShells; ++i) {
    const FrictionMemory::Spring& spring = memory.springs[i];
    shells.shells[i].stiffness = spring.stiffness;
    shells.shells[i].spring = {spring.force_W.norm(), 0.0, spring.spin};
  }
  return shells_.find_energy(shells);
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
