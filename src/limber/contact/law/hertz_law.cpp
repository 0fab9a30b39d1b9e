// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/hertz_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/types.hpp"
#include "limber/contact/law/check_value.hpp"

namespace limber::contact {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <int n>
constexpr double power(double x) {
  double product = 1.0;
  for (int i = 0; i < n; ++i) product *= x;
  return product;
}

// x > 0 of (x/flat)^n + (x/line)^(n+1) = 1, for flat, line > 0, one of which
// may be infinite. With u = x / min(flat, line) one coefficient is 1 and the
// other at most 1: nothing overflows, u is between 2^(-1/n) and 1, and from 1
// Newton's method decreases to u, as the left side is convex and increases.
template <int n>
double solve_series(double flat, double line) {
  const double scale = std::min(flat, line);
  const double a = flat > line ? power<n>(line / flat) : 1.0;
  const double b = line > flat ? power<n + 1>(flat / line) : 1.0;
  double u = 1.0;
  for (int i = 0; i < 20; ++i) {
    const double low = power<n - 1>(u);
    const double excess = low * u * (a + b * u) - 1.0;
    const double step = excess / (low * (n * a + (n + 1) * b * u));
    u -= step;
    if (!(step > 1e-9 * u)) break;  // the next one would be below round-off
  }
  return scale * u;
}

// x in (0, limit] of (x/flat)^n - (x/line)^(n+1) = 1. Up to the limit the left
// side increases and is convex: from x = flat, where it is smaller, Newton's
// method passes x once, and then decreases to it.
template <int n>
double solve_difference(double flat, double line, double limit) {
  double x = std::min(flat, limit);
  for (int i = 0; i < 50; ++i) {
    const double low = power<n - 1>(x / flat) / flat;
    const double high = power<n>(x / line) / line;
    const double excess = x * (low - high) - 1.0;
    const double next =
        std::min(x - excess / (n * low - (n + 1) * high), limit);
    const double step = std::abs(next - x);
    x = next;
    if (!(step > 1e-9 * x)) break;  // as above
  }
  return x;
}

}  // namespace

HertzLaw::HertzLaw(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters;
  check_value(true, "residual flexibility [m/N]", p.residual, "a number");
  if (p.stiffness == kRigid) {
    check_value(p.residual > 0.0, "residual flexibility [m/N]", p.residual,
                "> 0 between surfaces that do not flatten");
  } else {
    check_value(p.stiffness > 0.0, "stiffness [N/m^1.5]", p.stiffness, "> 0");
  }
  cbrt_stiffness_ = std::cbrt(p.stiffness);
  cbrt_residual_ = std::cbrt(p.residual);
  compliance_ = 1.0 / (cbrt_stiffness_ * cbrt_stiffness_);
  root_limit_ = depth_limit_ = kInfinity;
  if (p.residual >= 0.0) return;
  root_limit_ = -compliance_ / (3.0 * p.residual);
  depth_limit_ = 2.0 / 3.0 * compliance_ * root_limit_ * root_limit_;
}

HertzLaw::Response HertzLaw::evaluate(double depth) const {
  if (std::isnan(depth)) return {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
  if (!(depth > 0.0)) return {};
  if (depth > depth_limit_) return extend(depth - depth_limit_);
  return evaluate_root(find_root(depth));
}

HertzLaw::Response HertzLaw::find_state_of_energy(double energy) const {
  LIMBER_EXPECT(energy >= 0.0);
  if (energy == 0.0) return {};
  const double R = parameters_.residual;
  const double flat = std::pow(energy / (0.4 * compliance_), 0.2);
  const double line = std::pow(energy / (0.5 * std::abs(R)), 1.0 / 6);
  if (R >= 0.0) return evaluate_root(solve_series<5>(flat, line));
  const Response limit = evaluate_root(root_limit_);
  const double more = energy - limit.energy();
  if (more <= 0.0) {
    return evaluate_root(solve_difference<5>(flat, line, root_limit_));
  }
  // more = f x - x^2 / (2 R)
  const double f = limit.force;
  return extend(2.0 * more / (f + std::sqrt(f * f - 2.0 * more / R)));
}

double HertzLaw::find_root(double depth) const {
  const double flat = std::sqrt(depth) * cbrt_stiffness_;
  const double line = std::cbrt(depth) / std::abs(cbrt_residual_);
  return parameters_.residual < 0.0
             ? solve_difference<2>(flat, line, root_limit_)
             : solve_series<2>(flat, line);
}

HertzLaw::Response HertzLaw::extend(double beyond) const {
  const Response limit = evaluate_root(root_limit_);
  const double stiffness = -1.0 / parameters_.residual;
  const double energy =
      limit.energy() + beyond * (limit.force + 0.5 * stiffness * beyond);
  Response response;
  response.force = limit.force + stiffness * beyond;
  response.stiffness = stiffness;
  const double s = std::cbrt(response.force);
  response.hertz_depth = compliance_ * s * s;
  response.residual_depth = depth_limit_ + beyond - response.hertz_depth;
  response.hertz_energy = 0.4 * response.force * response.hertz_depth;
  response.residual_energy = energy - response.hertz_energy;
  return response;
}

HertzLaw::Response HertzLaw::evaluate_root(double s) const {
  const double c = compliance_;
  const double R = parameters_.residual;
  Response response;
  response.force = s * s * s;
  response.stiffness = 3.0 * s / (2.0 * c + 3.0 * R * s);
  response.hertz_depth = c * s * s;
  response.residual_depth = R * response.force;
  response.hertz_energy = 0.4 * response.force * response.hertz_depth;
  response.residual_energy = 0.5 * response.force * response.residual_depth;
  return response;
}

}  // namespace limber::contact
