// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/restitution.hpp"
#include "limber/common/rotation.hpp"

namespace limber::contact {
namespace {

// Of Hertz's area, 2/3 (a / r_e)^2 with r_e = 0.943 sqrt(0.4) a.
constexpr double kSpinRatio = 1.875;
// The same with the r_e of a point, 3 pi a / 16, a^2 = 5/2 tr S.
constexpr double kPointSpinRatio =
    512.0 / (27.0 * std::numbers::pi * std::numbers::pi);
const double kPointSpinRadius = 3.0 * std::numbers::pi / 16.0 * std::sqrt(2.5);

// k of N ~ d^p.
double find_stiffness(const PatchLaw::Input& in) {
  const double p = in.patch.exponent;
  return p / (p + 1.0) * in.elastic_W.head<3>().squaredNorm() / in.patch.energy;
}

// Of a force E f, f(E' motion, E' twist, elastic load, normal force).
template <int kSize>
struct Tangents {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  Matrix by_way;
  Matrix by_rate;
  Vector by_load = Vector::Zero();
  Vector by_force = Vector::Zero();
};

// @param pressed without friction
template <int kSize>
void add_tangents(const PatchLaw::Input& in,
                  const Eigen::Matrix<double, 6, kSize>& E,
                  const Tangents<kSize>& tangents, const PatchWrench& pressed,
                  const Vector3& normal_W, PatchWrench& out) {
  const Vector6 load_by_motion =
      in.patch.hessian_W.topRows<3>().transpose() * normal_W;
  const Vector6 force_by_motion =
      pressed.stiffness_W.topRows<3>().transpose() * normal_W;
  const Vector6 force_by_twist =
      pressed.damping_W.topRows<3>().transpose() * normal_W;
  out.stiffness_W += E * (tangents.by_force * force_by_motion.transpose() +
                          tangents.by_load * load_by_motion.transpose()) -
                     in.way_by_motion * E * tangents.by_way * E.transpose();
  out.damping_W += E * tangents.by_force * force_by_twist.transpose() -
                   E * tangents.by_rate * E.transpose();
}

LoadShells make_patch_shells(const ContactParameters& parameters,
                             const PairModuli& moduli, bool is_point,
                             double size) {
  LoadShells::Parameters shells;
  shells.limit = parameters.friction;
  shells.tangential_ratio = moduli.tangential_ratio();
  shells.spin_ratio = (is_point ? kPointSpinRatio : kSpinRatio) *
                      moduli.torsional / moduli.tangential;
  shells.reference_stiffness = 2.0 * moduli.normal * size;
  return LoadShells(shells);
}

}  // namespace

PatchLaw::PatchLaw(const ContactParameters& parameters,
                   const PairModuli& moduli, bool is_point, double size)
    : is_point_(is_point),
      shells_(make_patch_shells(parameters, moduli, is_point, size)),
      slides_(parameters.friction.sliding + parameters.friction.excess > 0.0),
      rolling_arm_(parameters.rolling_friction),
      damping_(parameters.damping) {
  check(parameters);
  if (!damping_) factor_ = find_restitution_factor(parameters.restitution);
}

struct PatchLaw::Rate {
  double s = 0.0;          // [s/m]
  double by_square = 0.0;  // ds by a square of speed [s^3/m^3]
};

PatchLaw::Rate PatchLaw::find_rate(const PatchMotion& all) const {
  if (damping_) return {.s = *damping_};
  const double square =
      all.square / all.load + 2.0 * all.energy * all.inverse_mass;
  if (factor_ == 0.0 || !(square > 0.0)) return {};
  const double s = factor_ / std::sqrt(square);
  return {s, -0.5 * s / square};
}

// Rotations about which a body is round move no surface: rolling is free.
Matrix6 PatchLaw::find_approach(const Patch& patch) {
  const Vector3 n = patch.normal_W();
  const Matrix3 rotation = skew(n);
  const Matrix3 rocking = rotation * patch.spread_W * rotation.transpose();
  const Matrix3 moving = patch.turns_A_W * patch.turns_B_W;
  Matrix6 P = Matrix6::Zero();
  P.topLeftCorner<3, 3>() = n * n.transpose();
  P.bottomRightCorner<3, 3>() = 0.5 * (moving * rocking * moving.transpose() +
                                       moving.transpose() * rocking * moving);
  return P;
}

double PatchLaw::find_square(const Patch& patch, const Vector6& twist_W) {
  return patch.load() * twist_W.dot(find_approach(patch) * twist_W);
}

// -s D twist, D of pressure along the normal; with d = D twist and vv = d .
// twist, ds = by_square (d(vv / N) + 2 dW / m), d the change; that of other
// patches is left out.
void PatchLaw::add_damping(const Input& in, PatchResponse& out) const {
  const Patch& patch = in.patch;
  const double N = in.all.load;
  const Vector3 n = patch.normal_W();
  const Matrix6 D = patch.load() * find_approach(patch);
  const Vector6 d = D * in.twist_W;
  const auto [s, slope] = find_rate(in.all);
  if (s == 0.0) return;
  const Vector6 load_by_motion = -patch.hessian_W.topRows<3>().transpose() * n;
  const Vector6 s_by_motion =
      slope * 2.0 * in.all.inverse_mass * patch.gradient_W;
  const Vector6 s_by_twist = slope * 2.0 / N * d;
  const double normal = -s * n.dot(d.head<3>());
  // Nothing pulls.
  const double fraction =
      out.normal_force + normal < 0.0 ? -out.normal_force / normal : 1.0;
  out.wrench.wrench_W -= fraction * s * d;
  out.wrench.stiffness_W +=
      fraction * d *
      (s / patch.load() * load_by_motion + s_by_motion).transpose();
  out.wrench.damping_W += fraction * (s * D + d * s_by_twist.transpose());
  out.normal_force = std::max(out.normal_force + normal, 0.0);
  out.damped = fraction * s * d.dot(in.twist_W);
}

double PatchLaw::find_radius(const Patch& patch,
                             const Vector3& normal_W) const {
  return is_point_ ? kPointSpinRadius * std::sqrt(patch.spread_W.trace())
                   : find_spin_radius(patch.spread_W, normal_W);
}

// In two directions, and the rotation times r_e. Of a flat the elastic load
// counts only by the normal force.
void PatchLaw::add_sliding(const Input& in, const PatchWrench& pressed,
                           const FrictionFrame& frame, ShellMemory& next,
                           PatchResponse& out) const {
  const double N = in.elastic_W.head<3>().norm();
  const double r_e = find_radius(in.patch, frame.normal_W);
  Eigen::Matrix<double, 6, 3> E = Eigen::Matrix<double, 6, 3>::Zero();
  E.topLeftCorner<3, 2>() = frame.plane_W;
  E.bottomRightCorner<3, 1>() = r_e * frame.normal_W;
  const PatchSlip& slip = in.slip;
  ShellMotion motion;
  motion.increment << frame.plane_W.transpose() * slip.way_W,
      r_e * frame.normal_W.dot(find_rotation_W(slip.last, slip.rotations));
  motion.velocity = E.transpose() * in.twist_W;
  const ShellLoad load{.force = N,
                       .stiffness = find_stiffness(in),
                       .exponent = in.patch.exponent,
                       .grip = out.normal_force / N};
  const double k_t = shells_.parameters().tangential_ratio * load.stiffness;
  const bool is_flat = load.exponent == 1.0;
  const double damping =
      is_flat ? find_spring_damping(k_t, 1.0 / in.all.inverse_mass) : 0.0;
  const ShellResponse shells = shells_.evaluate(
      recall_friction(slip.last, frame, slip.rotations), load, motion, damping);
  Tangents<3> tangents{.by_way = shells.by_increment,
                       .by_rate = shells.by_velocity,
                       .by_force = shells.by_grip / N};
  if (!is_flat)
    tangents.by_load = shells.by_load - load.grip * tangents.by_force;
  add_tangents(in, E, tangents, pressed, frame.normal_W, out.wrench);
  out.wrench.wrench_W += E * shells.force;
  out.friction_W = frame.plane_W * shells.force.head<2>();
  out.slips = shells.slips;
  out.energy += shells.energy;
  out.slip_work += shells.slip_work;
  out.rubbed += shells.damper_power;
  out.friction_power += shells.force.dot(motion.velocity);
  next = shells.next;
}

void PatchLaw::add_rolling(const Input& in, const PatchWrench& pressed,
                           const FrictionFrame& frame, RollingSpring& next,
                           PatchResponse& out) const {
  Eigen::Matrix<double, 6, 2> E = Eigen::Matrix<double, 6, 2>::Zero();
  E.bottomRows<3>() = frame.plane_W;
  const PatchSlip& slip = in.slip;
  const RollingMotion motion{
      .rotation = frame.plane_W.transpose() *
                  find_rotation_W(slip.last, slip.rotations),
      .rate = E.transpose() * in.twist_W};
  const RollingResponse rolling = resist_rolling(
      rolling_arm_, recall_rolling(slip.last, frame, slip.rotations),
      {.force = out.normal_force,
       .stiffness = find_stiffness(in),
       .inverse_inertia = in.all.inverse_inertia},
      motion);
  add_tangents<2>(in, E,
                  {.by_way = rolling.by_rotation,
                   .by_rate = rolling.by_rate,
                   .by_force = rolling.by_force},
                  pressed, frame.normal_W, out.wrench);
  out.wrench.wrench_W += E * rolling.moment;
  out.energy += rolling.energy;
  out.slip_work += rolling.slip_work;
  out.rubbed += rolling.damper_power;
  out.friction_power += rolling.moment.dot(motion.rate);
  next = rolling.next;
}

void PatchLaw::add_friction(const Input& in, PatchResponse& out) const {
  const FrictionFrame frame(out.normal_W);
  const PatchWrench pressed = out.wrench;
  ShellMemory shells;
  RollingSpring rolling;
  if (slides_) add_sliding(in, pressed, frame, shells, out);
  if (rolls()) add_rolling(in, pressed, frame, rolling, out);
  out.next = keep_friction(shells, frame, in.slip.rotations, rolling);
}

double PatchLaw::find_energy(const FrictionMemory& memory) const {
  ShellMemory shells;
  for (std::size_t i = 0; i < kShells; ++i) {
    const FrictionMemory::Spring& spring = memory.springs[i];
    shells.shells[i].stiffness = spring.stiffness;
    shells.shells[i].spring = {spring.force_W.norm(), 0.0, spring.spin};
  }
  return shells_.find_energy(shells) +
         contact::find_energy(
             {memory.rolling_stiffness, {memory.rolling_W.norm(), 0.0}});
}

PatchResponse PatchLaw::evaluate(const Input& in) const {
  PatchResponse out;
  out.wrench.wrench_W = in.elastic_W;
  out.wrench.stiffness_W = in.patch.hessian_W;
  out.normal_force = in.elastic_W.head<3>().norm();
  if (!(out.normal_force > 0.0)) return out;
  out.normal_W = in.elastic_W.head<3>() / out.normal_force;
  add_damping(in, out);
  if (has_friction()) add_friction(in, out);
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
