// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_verdict.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

// Smaller fractions of the drift do not show its origin [-].
constexpr double kNamedFraction = 0.1;

// "0.006 J lost by t = 0.2 s, 12 % of the throughput ...".
std::string describe_energy(const EnergyDrift& energy) {
  const double drift = energy.drift.value;
  std::string text = fmt::format(
      "{:.3g} J {} by t = {:.6g} s, {:.3g} % of the throughput of {:.3g} J",
      std::abs(drift), drift < 0.0 ? "lost" : "gained", energy.drift.time,
      100.0 * find_unbalanced_fraction(energy), energy.throughput);
  if (!energy.place.empty() &&
      std::abs(energy.place_error) > kNamedFraction * std::abs(drift)) {
    text += fmt::format("; the largest part, {:.3g} J, in {}",
                        std::abs(energy.place_error), energy.place);
  }
  return text;
}

bool is_forgiven(IntegratorKind integrator, const EnergyDrift& energy) {
  return traits_of(integrator).order == 1 || energy.is_one_way;
}

std::string advise(IntegratorKind integrator, const EnergyDrift& energy) {
  if (energy.is_one_way) {
    return "level one-way drives modes by rotation without reaction on it; "
           "level coupled has both";
  }
  const IntegratorTraits& traits = traits_of(integrator);
  if (traits.order == 1 && traits.is_implicit) {
    return traits.name +
           " damps whatever its steps do not resolve; use shorter steps or "
           "generalized-alpha";
  }
  if (traits.order == 1) {
    return traits.name +
           " is of first order and uses the forces at the start of a step for "
           "work; use shorter steps or another integrator";
  }
  if (integrator == IntegratorKind::energy_conserving) {
    return "use shorter steps, or generalized-alpha with steps to a tolerance";
  }
  return "use shorter steps, steps to a tolerance, or energy-conserving";
}

}  // namespace

double find_unbalanced_fraction(const EnergyDrift& energy) {
  const double drift = std::abs(energy.drift.value);
  if (!(drift > energy.roundoff) || energy.throughput == 0.0) return 0.0;
  return drift / energy.throughput;
}

void warn_of_energy(IntegratorKind integrator, const EnergyRecord& record,
                    std::vector<std::string>& warnings) {
  const EnergyDrift& energy = record.worst;
  if (!(find_unbalanced_fraction(energy) > kReportedDrift)) return;
  warnings.push_back(fmt::format("energy error: {}; {}",
                                 describe_energy(energy),
                                 advise(integrator, energy)));
}

void check_energy(IntegratorKind integrator, const EnergyRecord& record) {
  const EnergyDrift& energy = record.worst;
  if (!(find_unbalanced_fraction(energy) > kMostDrift)) return;
  if (is_forgiven(integrator, energy)) return;
  throw NumericalError(fmt::format("the energy does not balance: error {}; {}",
                                   describe_energy(energy),
                                   advise(integrator, energy)));
}

}  // namespace limber::dynamics
