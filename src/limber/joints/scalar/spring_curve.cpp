// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/spring_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

void check_coefficient(double value, const char* what) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw InputError(
        fmt::format("spring: its {} is {:g}; expected >= 0", what, value));
  }
}

void check_table(const std::vector<double>& x, const std::vector<double>& f) {
  if (x.size() != f.size() || x.size() == 1) {
    throw InputError(fmt::format(
        "spring: its table has {} extensions and {} forces; expected as many, "
        "at least two",
        x.size(), f.size()));
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(f[i])) {
      throw InputError("spring: its table is not finite");
    }
    if (i > 0 && !(x[i] > x[i - 1] && f[i] >= f[i - 1])) {
      throw InputError(fmt::format(
          "spring: its table decreases at extension {:g}, force {:g}; expected "
          "increasing extensions and forces that do not decrease",
          x[i], f[i]));
    }
  }
}

}  // namespace

SpringCurve::SpringCurve(const Parameters& parameters)
    : parameters_(parameters) {
  check_coefficient(parameters.stiffness, "stiffness");
  check_coefficient(parameters.quadratic, "quadratic stiffness");
  const auto& x = parameters.extensions;
  const auto& f = parameters.forces;
  check_table(x, f);
  if (x.empty()) return;
  energies_.push_back(0.0);
  for (std::size_t i = 1; i < x.size(); ++i) {
    energies_.push_back(energies_.back() +
                        0.5 * (f[i] + f[i - 1]) * (x[i] - x[i - 1]));
  }
  energy_at_rest_ = evaluate_table(0.0).energy;
}

SpringCurve::Point SpringCurve::evaluate_table(double s) const {
  const auto& x = parameters_.extensions;
  const auto& f = parameters_.forces;
  const auto next = std::upper_bound(x.begin() + 1, x.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - x.begin()) - 1;
  const double slope = (f[i + 1] - f[i]) / (x[i + 1] - x[i]);
  const double ds = s - x[i];
  return {f[i] + slope * ds, energies_[i] + ds * (f[i] + 0.5 * slope * ds),
          slope};
}

SpringCurve::Point SpringCurve::evaluate(double s) const {
  const double k = parameters_.stiffness;
  const double k2 = parameters_.quadratic;
  const double size = std::abs(s);
  Point point{(k + k2 * size) * s, (0.5 * k + k2 * size / 3.0) * s * s,
              k + 2.0 * k2 * size};
  if (energies_.empty()) return point;
  const Point table = evaluate_table(s);
  point.force += table.force;
  point.energy += table.energy - energy_at_rest_;
  point.slope += table.slope;
  return point;
}

}  // namespace limber::joints
