// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/rounding_limit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

constexpr double kVisible = 1e-7;         // of a body's size: gives a warning
constexpr double kAbsurdRounding = 1e-4;  // of it: gives an error

// Largest of each body [m].
std::vector<double> find_radii_of_gyration(const SystemModel& model) {
  std::vector<double> radii;
  for (const BodyModel& body : model.bodies) {
    const Vector3 moments = dense::find_eigenvalues(body.J0);
    radii.push_back(std::sqrt(moments.maxCoeff() / body.mass));
  }
  return radii;
}

// The body whose position is rounded most, relative to its size.
struct Rounding {
  std::size_t body = 0;
  double distance = 0.0;  // from the world's origin [m]
  double radius = 0.0;    // of gyration [m]
  double fraction = 0.0;  // of the radius that is rounded away [-]
};

Rounding find_largest_rounding(const std::vector<double>& radii,
                               const SystemState& state) {
  Rounding largest;
  for (std::size_t b = 0; b < radii.size(); ++b) {
    const double distance = state.bodies[b].p_WB.stableNorm();
    const double fraction =
        std::numeric_limits<double>::epsilon() * distance / radii[b];
    if (fraction > largest.fraction)
      largest = {b, distance, radii[b], fraction};
  }
  return largest;
}

std::string describe_rounding(const SystemModel& model,
                              const SystemState& state,
                              const Rounding& rounding) {
  return fmt::format(
      "body '{}' at t = {:.9g} s is {:.3g} m from the origin of the world, "
      "where positions are rounded to {:.2g} m, {:.2g} of its radius of "
      "gyration ({:.3g} m)",
      model.bodies[rounding.body].name, state.t, rounding.distance,
      rounding.fraction * rounding.radius, rounding.fraction, rounding.radius);
}

}  // namespace

RoundingLimit::RoundingLimit(const SystemModel& model)
    : model_(model), radii_(find_radii_of_gyration(model)) {}

void RoundingLimit::check(const SystemState& state,
                          std::vector<std::string>& warnings) {
  if (was_reported_) return;
  const Rounding rounding = find_largest_rounding(radii_, state);
  if (rounding.fraction <= kVisible) return;
  was_reported_ = true;
  warnings.push_back(fmt::format(
      "{}: deformations are off by as much, and forces of joints by that times "
      "their stiffness; move the origin nearer to the bodies",
      describe_rounding(model_, state, rounding)));
}

void RoundingLimit::exchange_memory(Archive& archive) {
  archive(was_reported_);
}

void check_rounding(const SystemModel& model, const SystemState& state) {
  const Rounding rounding =
      find_largest_rounding(find_radii_of_gyration(model), state);
  if (rounding.fraction <= kAbsurdRounding) return;
  throw InputError(fmt::format("{}; expected at most {:.2g} of it",
                               describe_rounding(model, state, rounding),
                               kAbsurdRounding));
}

}  // namespace limber::dynamics
