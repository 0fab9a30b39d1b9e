// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/load_shells.hpp"

#include <algorithm>
#include <cmath>

#include "limber/contact/law/check_value.hpp"
#include "limber/contact/law/within.hpp"

namespace limber::contact {
namespace {

constexpr double kLevelRatio = 1.5;
// Below this exponent the stiffness is constant.
constexpr double kFlat = 1.05;

bool is_flat(const ShellLoad& load) { return !(load.exponent >= kFlat); }

// Takes all shells below another level into its one.
void raise(double lowest, ShellMemory& memory) {
  const auto count = static_cast<std::size_t>(
      std::min(lowest - memory.lowest, double(kShells)));
  ShellMemory moved{.lowest = lowest};
  for (std::size_t i = 0; i < kShells; ++i) {
    const LoadShell& shell = memory.shells[i];
    LoadShell& into = moved.shells[i > count ? i - count : 0];
    into.stiffness += shell.stiffness;
    into.spring += shell.spring;
  }
  memory = moved;
}

}  // namespace

LoadShells::LoadShells(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters;
  check(p.limit);
  check_value(p.tangential_ratio > 0.0, "ratio of stiffness",
              p.tangential_ratio, "> 0");
  check_value(p.spin_ratio >= 0.0, "ratio of stiffness about the normal",
              p.spin_ratio, ">= 0");
  check_value(p.reference_stiffness > 0.0, "reference stiffness [N/m]",
              p.reference_stiffness, "> 0");
}

double LoadShells::find_stiffness(double level) const {
  return parameters_.reference_stiffness * std::pow(kLevelRatio, level);
}

ShellMemory LoadShells::move(const ShellMemory& memory,
                             const ShellLoad& load) const {
  ShellMemory moved = memory;
  if (is_flat(load)) {
    raise(memory.lowest + double(kShells), moved);
    return moved;
  }
  const double top =
      std::floor(std::log(load.stiffness / parameters_.reference_stiffness) /
                 std::log(kLevelRatio));
  const double lowest = top - double(kShells - 1);
  const bool is_new = memory.shells[0].stiffness == 0.0;
  if (is_new || memory.lowest > top) {
    moved = {.lowest = is_new ? lowest : top};
    moved.shells[0] = memory.shells[0];
  } else if (memory.lowest < lowest) {
    raise(lowest, moved);
  }
  return moved;
}

// dk/dN = (p - 1) / d; the load below a level k_j stays, so that dL_j/dN =
// 1 - k_j / k.
LoadShells::Parts LoadShells::find_parts(double lowest,
                                         const ShellLoad& load) const {
  const double N = load.force;
  const double k = load.stiffness;
  const double p = load.exponent;
  const double d = p * N / k;
  const double softened = std::max(1.0 + load.residual * k, 0.5);
  const double kappa = parameters_.tangential_ratio / softened;
  const double k_by_load = (p - 1.0) / d;
  const double by_softening =
      softened > 0.5 ? -load.residual * k_by_load / softened : 0.0;
  Parts parts = {};
  double load_above = 0.0;
  double load_above_by_load = 0.0;
  for (std::size_t i = kShells; i-- > 0;) {
    const bool is_lowest = i == 0;
    if (is_flat(load) && !is_lowest) continue;
    const double level = lowest + double(i);
    const double k_low = is_lowest ? 0.0 : find_stiffness(level);
    if (!(k > k_low)) continue;
    const double k_next = is_flat(load) ? k : find_stiffness(level + 1.0);
    const bool is_top = !(k_next < k);
    const double x = is_lowest ? 0.0 : std::pow(k_low / k, 1.0 / (p - 1.0));
    const double L = N * (1.0 - std::pow(x, p)) - k_low * d * (1.0 - x);
    const double L_by_load = 1.0 - k_low / k;
    Part& part = parts[i];
    part.stiffness = kappa * (std::min(k, k_next) - k_low);
    part.stiffness_by_load = by_softening * part.stiffness;
    if (is_top) part.stiffness_by_load += kappa * k_by_load;
    part.load = std::max(L - load_above, 0.0);
    part.load_by_load = L_by_load - load_above_by_load;
    load_above = L;
    load_above_by_load = L_by_load;
  }
  return parts;
}

double LoadShells::find_energy(const LoadShell& shell) const {
  if (!(shell.stiffness > 0.0)) return 0.0;
  const double c = parameters_.spin_ratio;
  const double spin = c > 0.0 ? shell.spring[2] * shell.spring[2] / c : 0.0;
  return 0.5 * (shell.spring.head<2>().squaredNorm() + spin) / shell.stiffness;
}

double LoadShells::find_energy(const ShellMemory& memory) const {
  double energy = 0.0;
  for (const LoadShell& shell : memory.shells) energy += find_energy(shell);
  return energy;
}

// The work of the spring except for its energy is T . (u* - T / k).
void LoadShells::add_shell(const LoadShell& before, const Part& part,
                           const ShellMotion& motion, double limit_by_load,
                           ShellResponse& out, LoadShell& next) const {
  if (!(part.stiffness > 0.0)) return;
  const double k = part.stiffness;
  const Vector3 ratios(1.0, 1.0, parameters_.spin_ratio);
  const bool is_released = k < before.stiffness;
  LoadShell released{k, before.spring};
  if (is_released) released.spring *= k / before.stiffness;
  const Vector3 way = ratios.cwiseProduct(motion.increment);
  const Vector3 trial = released.spring + k * way;
  const Within<3> spring(trial, limit_by_load * part.load);
  Vector3 trial_by_load = part.stiffness_by_load * way;
  if (is_released) {
    trial_by_load += part.stiffness_by_load / before.stiffness * before.spring;
  }
  next = {k, spring.value};
  out.force -= spring.value;
  // A spring on the cone slips as long as it is pulled outward.
  constexpr double kOnCone = 1.0 - 1e-9;
  const bool goes_on = trial.norm() >= kOnCone * limit_by_load * part.load &&
                       ratios.cwiseProduct(motion.velocity).dot(trial) > 0.0;
  out.slips = out.slips && (spring.is_cut || goes_on);
  out.energy += find_energy(next);
  out.slip_work +=
      spring.value.head<2>().dot((trial - spring.value).head<2>()) / k;
  if (ratios[2] > 0.0) {
    out.slip_work +=
        spring.value[2] * (trial - spring.value)[2] / (ratios[2] * k);
  }
  // Of the former springs: what the first of the step does not have.
  out.slip_work -= find_energy(released);
  out.by_increment -= k * spring.by_value * ratios.asDiagonal();
  out.by_load -= spring.by_value * trial_by_load +
                 limit_by_load * part.load_by_load * spring.by_most;
  // By the limit over mu g: also for the velocity.
  out.by_grip -= part.load * spring.by_most;
}

ShellResponse LoadShells::evaluate(const ShellMemory& memory,
                                   const ShellLoad& load,
                                   const ShellMotion& motion,
                                   double damping) const {
  ShellResponse out;
  if (!(load.force > 0.0)) return out;
  const double speed = motion.velocity.norm();
  const FrictionCoefficient mu = find_coefficient(parameters_.limit, speed);
  const Vector3 mu_by_velocity =
      speed > 0.0 ? Vector3(mu.slope / speed * motion.velocity)
                  : Vector3(Vector3::Zero());
  const ShellMemory before = move(memory, load);
  const Parts parts = find_parts(before.lowest, load);
  out.slips = true;
  out.slip_work = find_energy(memory);
  out.next.lowest = before.lowest;
  for (std::size_t i = 0; i < kShells; ++i) {
    add_shell(before.shells[i], parts[i], motion, mu.value * load.grip, out,
              out.next.shells[i]);
  }
  const Vector3 by_limit = out.by_grip;
  out.by_velocity = load.grip * by_limit * mu_by_velocity.transpose();
  out.by_grip = mu.value * by_limit;
  if (damping == 0.0) return out;
  const Vector3 springs = out.force;
  const Within<3> sum(springs - damping * motion.velocity,
                      mu.value * load.grip * load.force);
  out.force = sum.value;
  out.slips = out.slips || sum.is_cut;
  out.damper_power = (springs - out.force).dot(motion.velocity);
  out.by_increment = sum.by_value * out.by_increment;
  out.by_velocity =
      sum.by_value * (out.by_velocity - damping * Matrix3::Identity());
  out.by_velocity +=
      load.grip * load.force * sum.by_most * mu_by_velocity.transpose();
  out.by_load = sum.by_value * out.by_load + mu.value * load.grip * sum.by_most;
  out.by_grip =
      sum.by_value * out.by_grip + mu.value * load.force * sum.by_most;
  return out;
}

double find_spring_damping(double stiffness, double mass,
                           double damping_ratio) {
  return 2.0 * damping_ratio * std::sqrt(stiffness * mass);
}

}  // namespace limber::contact
