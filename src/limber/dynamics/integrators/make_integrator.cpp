// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/make_integrator.hpp"

#include <algorithm>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/integrators/central_differences.hpp"
#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "limber/dynamics/integrators/explicit_euler.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/integrators/impact_integrator.hpp"
#include "limber/dynamics/integrators/runge_kutta.hpp"
#include "limber/dynamics/integrators/splitting.hpp"

namespace limber::dynamics {

namespace {

EnergyConserving::Settings read_conserving(const SimulationSettings& settings) {
  EnergyConserving::Settings own;
  own.max_iterations = settings.newton_iterations;
  if (settings.newton_tolerance > 0.0) {
    own.tolerance = settings.newton_tolerance;
  }
  return own;
}

}  // namespace

bool conserves_impacts(const SystemModel& model,
                       const SimulationSettings& settings) {
  return traits_of(settings.integrator).is_implicit &&
         settings.integrator != IntegratorKind::energy_conserving &&
         settings.tolerance == 0.0 && model.nodal_count == 0 &&
         std::any_of(model.pairs.begin(), model.pairs.end(),
                     [](const Pair& pair) { return pair.law->touching(); });
}

std::unique_ptr<Integrator> make_integrator(
    const SystemModel& model, const SimulationSettings& settings) {
  const auto make_alpha = [&](bool is_euler) -> std::unique_ptr<Integrator> {
    auto own = std::make_unique<GeneralizedAlpha>(
        model,
        GeneralizedAlpha::Settings{settings.rho_inf, settings.newton_tolerance,
                                   settings.newton_iterations, is_euler,
                                   settings.tolerance > 0.0});
    if (!conserves_impacts(model, settings)) return own;
    EnergyConserving::Settings conserving = read_conserving(settings);
    conserving.damps_unresolved = true;
    return std::make_unique<ImpactIntegrator>(model, std::move(own),
                                              conserving);
  };
  switch (settings.integrator) {
    case IntegratorKind::generalized_alpha:
      return make_alpha(false);
    case IntegratorKind::implicit_euler:
      return make_alpha(true);
    case IntegratorKind::runge_kutta_4:
      return std::make_unique<RungeKutta4>(model);
    case IntegratorKind::explicit_euler:
      return std::make_unique<ExplicitEuler>(model);
    case IntegratorKind::central_differences:
      return std::make_unique<CentralDifferences>(model);
    case IntegratorKind::energy_conserving:
      return std::make_unique<EnergyConserving>(model,
                                                read_conserving(settings));
    case IntegratorKind::splitting:
      return std::make_unique<Splitting>(model);
  }
  throw ContractError("an IntegratorKind without an integrator");
}

}  // namespace limber::dynamics
