// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/integrator_kind.hpp"

#include <cstddef>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::dynamics {
namespace {

IntegratorTraits make_traits(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::generalized_alpha:
      return {.name = "generalized-alpha",
              .is_implicit = true,
              .is_adaptive = true,
              .has_spectral_radius = true,
              .takes_nodes = true,
              .takes_ideal_joints = true,
              .leaves_end_terms = true};
    case IntegratorKind::runge_kutta_4:
      return {.name = "runge-kutta-4",
              .order = 4,
              .takes_nodes = true,
              .limit = StepLimit::growth};
    case IntegratorKind::explicit_euler:
      return {.name = "explicit-euler", .order = 1, .takes_exact_modes = false};
    case IntegratorKind::central_differences:
      return {.name = "central-differences",
              .takes_nodes = true,
              .leaves_end_terms = true,
              .limit = StepLimit::stability};
    case IntegratorKind::implicit_euler:
      return {.name = "implicit-euler",
              .order = 1,
              .is_implicit = true,
              .takes_nodes = true,
              .takes_ideal_joints = true,
              .leaves_end_terms = true};
    case IntegratorKind::energy_conserving:
      return {.name = "energy-conserving",
              .is_implicit = true,
              .takes_ideal_joints = true,
              .leaves_end_terms = true};
    case IntegratorKind::splitting:
      return {.name = "splitting", .limit = StepLimit::growth};
  }
  throw ContractError("an IntegratorKind without traits");
}

// In the order of IntegratorKind.
const std::vector<IntegratorTraits>& all_traits() {
  static const std::vector<IntegratorTraits> traits = [] {
    std::vector<IntegratorTraits> all;
    for (int kind = 0; kind <= static_cast<int>(kLastIntegrator); ++kind) {
      all.push_back(make_traits(static_cast<IntegratorKind>(kind)));
    }
    return all;
  }();
  return traits;
}

}  // namespace

const IntegratorTraits& traits_of(IntegratorKind kind) {
  return all_traits().at(static_cast<std::size_t>(kind));
}

const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const IntegratorTraits& traits : all_traits()) {
      all.push_back(traits.name);
    }
    return all;
  }();
  return names;
}

IntegratorKind parse_integrator(std::string_view name) {
  return static_cast<IntegratorKind>(
      find_name("integrator", name, integrator_names()));
}

const std::string& to_string(IntegratorKind kind) {
  return traits_of(kind).name;
}

}  // namespace limber::dynamics
