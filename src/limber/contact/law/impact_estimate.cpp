// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/impact_estimate.hpp"

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// The integral of sin(x) / f(x) by the double-exponential rule, which converges
// in spite of the integrand's root at x = 0.
double integrate(const HertzLaw& law, double peak_energy) {
  constexpr double kStep = 0.125;
  constexpr int kHalfCount = 26;  // weights beyond are below round-off
  double sum = 0.0;
  for (int i = -kHalfCount; i <= kHalfCount; ++i) {
    const double t = kStep * i;
    const double fraction =
        1.0 / (1.0 + std::exp(-std::numbers::pi * std::sinh(t)));
    const double rest = 1.0 / (1.0 + std::exp(std::numbers::pi * std::sinh(t)));
    const double weight = std::numbers::pi * std::cosh(t) * fraction * rest;
    const double sine = std::sin(0.5 * std::numbers::pi * fraction);
    const double force =
        law.find_state_of_energy(peak_energy * sine * sine).force;
    sum += weight * sine / force;
  }
  return 0.5 * std::numbers::pi * kStep * sum;
}

}  // namespace

ImpactEstimate estimate_impact(const HertzLaw& law, double mass, double speed) {
  LIMBER_EXPECT(mass > 0.0 && std::isfinite(mass));
  LIMBER_EXPECT(speed > 0.0 && std::isfinite(speed));
  const double energy = 0.5 * mass * speed * speed;
  const HertzLaw::Response peak = law.find_state_of_energy(energy);
  return {.duration = 2.0 * mass * speed * integrate(law, energy),
          .peak_force = peak.force,
          .peak_depth = peak.hertz_depth + peak.residual_depth};
}

}  // namespace limber::contact
