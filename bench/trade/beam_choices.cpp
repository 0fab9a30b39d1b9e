// SPDX-License-Identifier: BSD-3-Clause
#include "beam_choices.hpp"

#include <fmt/format.h>

namespace limber::bench::trade {

Choice make_reference() {
  return {.name = "full, Runge-Kutta 1.7e-5 s",
          .level = Fidelity::full,
          .integrator = IntegratorKind::runge_kutta_4,
          .step = kFullStep,
          .repeats = 1};
}

Choice make_explicit(flexbody::NodalMassKind mass, int repeats) {
  const std::string name(to_string(mass));
  return {.name = "full, " + name + " mass, central differences",
          .label = name,
          .level = Fidelity::full,
          .integrator = IntegratorKind::central_differences,
          .step = 5e-3,  // divided
          .full = {.mass = mass},
          .repeats = repeats};
}

void add_whole_meshes(Study& study) {
  study.add_reference(make_reference());
  study.add(make_explicit(flexbody::NodalMassKind::consistent, 1));
  study.add(make_explicit(flexbody::NodalMassKind::lumped, 2));
}

const Outcome& find_lumped(const Study& study) {
  return study.find(make_explicit(flexbody::NodalMassKind::lumped, 1).name);
}

scene::BasisChoice make_basis(int eigenmodes, bool has_loads) {
  return {.eigenmodes = eigenmodes, .interfaces = false, .loads = has_loads};
}

Choice make_exact(const std::string& name, scene::BasisChoice basis,
                  double step) {
  return {.name = "uncoupled, " + name + ", closed form",
          .label = name + " exact",
          .level = Fidelity::uncoupled,
          .basis = basis,
          .integrator = IntegratorKind::runge_kutta_4,
          .step = step};
}

namespace {

struct SchemeName {
  const char* name;
  const char* label;
};

SchemeName find_scheme_name(IntegratorKind integrator) {
  switch (integrator) {
    case IntegratorKind::runge_kutta_4:
      return {"Runge-Kutta", "RK"};
    case IntegratorKind::explicit_euler:
      return {"the report's scheme", "report"};
    default:
      return {"generalized-alpha", "GA"};
  }
}

}  // namespace

Choice make_stepped(const std::string& name, Fidelity level,
                    scene::BasisChoice basis, IntegratorKind integrator,
                    double step) {
  const SchemeName scheme = find_scheme_name(integrator);
  return {.name = fmt::format("{}, {}, {} {:g} s", to_string(level), name,
                              scheme.name, step),
          .label = fmt::format("{} {} {:g} s", name, scheme.label, step),
          .level = level,
          .basis = basis,
          .integrator = integrator,
          .step = step,
          .exact_modes = false};
}

}  // namespace limber::bench::trade
