// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "dynamics/central_differences.hpp"
#include "dynamics/energy_conserving.hpp"
#include "dynamics/explicit_euler.hpp"
#include "dynamics/generalized_alpha.hpp"
#include "dynamics/runge_kutta.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/splitting.hpp"

namespace limber::dynamics {

/// The integrators behind one face.
class Stepper {
 public:
  Stepper(const SystemModel& model, const SimulationSettings& settings)
      : scheme_(make(model, settings)) {}

  /// Before the first step, which will be about `h` long [s].
  void start(const SystemState& state, double h) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      alpha->start(state, h);
    }
    if (auto* central = std::get_if<CentralDifferences>(&scheme_)) {
      central->start(state);
    }
  }
  /// After a step that ended where a load jumps.
  void cross_jump(const SystemState& state, double h) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      alpha->cross_jump(state, h);
    }
    if (auto* central = std::get_if<CentralDifferences>(&scheme_)) {
      central->start(state);
    }
  }
  /// Takes the last step back, to the state before it.
  void undo(const SystemState& before) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) alpha->undo();
    if (auto* central = std::get_if<CentralDifferences>(&scheme_)) {
      central->start(before);
    }
  }
  /// Linear solves since this was asked last, of failed steps, too.
  [[nodiscard]] long take_solves() {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      return alpha->take_solves();
    }
    auto* conserving = std::get_if<EnergyConserving>(&scheme_);
    return conserving != nullptr ? conserving->take_solves() : 0;
  }
  /// Drops what it could keep to be faster.
  void refresh() {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) alpha->refresh();
    if (auto* conserving = std::get_if<EnergyConserving>(&scheme_)) {
      conserving->refresh();
    }
  }
  /// What it knows between steps, of which the last left `state`.
  void exchange_memory(Archive& archive, const SystemState& state) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      alpha->exchange_memory(archive, state);
    }
    if (auto* central = std::get_if<CentralDifferences>(&scheme_)) {
      central->exchange_memory(archive, state);
    }
    if (auto* runge_kutta = std::get_if<RungeKutta4>(&scheme_)) {
      runge_kutta->exchange_memory(archive, state);
    }
  }
  /// At about the last step's end.
  [[nodiscard]] const SystemTerms& terms() const {
    return std::visit(
        [](const auto& s) -> const SystemTerms& { return s.terms(); }, scheme_);
  }
  /// Advances `state` by h, to the time `end` [s].
  /// @throws NumericalError naming the body and the time.
  StepResult step(SystemState& state, double h, double end) {
    return std::visit([&](auto& s) { return s.step(state, h, end); }, scheme_);
  }

 private:
  using Scheme = std::variant<GeneralizedAlpha, RungeKutta4, ExplicitEuler,
                              CentralDifferences, EnergyConserving, Splitting>;
  static Scheme make(const SystemModel& model,
                     const SimulationSettings& settings) {
    switch (settings.integrator) {
      case IntegratorKind::runge_kutta_4:
        return RungeKutta4(model);
      case IntegratorKind::explicit_euler:
        return ExplicitEuler(model);
      case IntegratorKind::central_differences:
        return CentralDifferences(model);
      case IntegratorKind::energy_conserving:
        return EnergyConserving(
            model, {settings.newton_tolerance, settings.newton_iterations});
      case IntegratorKind::splitting:
        return Splitting(model);
      case IntegratorKind::generalized_alpha:
      case IntegratorKind::implicit_euler:
        break;
    }
    return GeneralizedAlpha(
        model, {settings.rho_inf, settings.newton_tolerance,
                settings.newton_iterations,
                settings.integrator == IntegratorKind::implicit_euler,
                settings.tolerance > 0.0});
  }
  Scheme scheme_;
};

}  // namespace limber::dynamics
