// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/offset.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace limber::results {
namespace {

constexpr double kFar = 10.0;  // of the size of the box

// To a multiple of 10^power; exact for fractions, too.
double round_to(double value, int power) {
  const double unit = std::pow(10.0, std::abs(power));
  const double rounded = power < 0 ? std::round(value * unit) / unit
                                   : std::round(value / unit) * unit;
  return rounded + 0.0;  // never -0
}

double find_radius(const dynamics::BodyModel& body) {
  if (!body.reduced || body.reduced->rows.x_B.cols() == 0) {
    return estimate_radius(body.mass, body.J0);
  }
  return body.reduced->rows.x_B.colwise().norm().maxCoeff();
}

}  // namespace

double estimate_radius(double mass, const Matrix3& J) {
  return std::sqrt(J.trace() / mass);
}

Vector3 choose_offset(const Bounds& box) {
  const double size = box.size();
  const Vector3 centre = 0.5 * (box.lower + box.upper);
  const bool is_empty = (box.lower.array() > box.upper.array()).any();
  if (is_empty || !(size > 0.0) || !(centre.norm() > kFar * size)) {
    return Vector3::Zero();
  }
  const int power = static_cast<int>(std::floor(std::log10(size)));
  return centre.unaryExpr([power](double c) { return round_to(c, power); });
}

Vector3 find_offset(const dynamics::SystemModel& model,
                    std::span<const dynamics::SystemState> states) {
  Bounds box;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double radius = find_radius(model.bodies[b]);
    for (const auto& state : states) box.include(state.bodies[b].p_WB, radius);
  }
  return choose_offset(box);
}

dynamics::SystemState shift_bodies(dynamics::SystemState state,
                                   const Vector3& offset) {
  for (auto& body : state.bodies) body.p_WB -= offset;
  return state;
}

}  // namespace limber::results
