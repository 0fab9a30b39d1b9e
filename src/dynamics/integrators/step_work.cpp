// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/step_work.hpp"

namespace limber::dynamics {

void StepWork::start(const SystemState& state, const SystemTerms& terms) {
  power_ = {terms.load_power, terms.dissipated_power};
  dampers_.start(terms);
  supplies_.start(state, terms);
}

void StepWork::advance(const SystemState& from, const SystemState& to,
                       const SystemTerms& terms, double h, StepResult& result) {
  const double loads = supplies_.advance(to, terms, h) / h;
  const double losses = dampers_.advance(from, to, terms, h) / h;
  last_power_ = power_;
  power_ = {terms.load_power, terms.dissipated_power};
  result.begin = {last_power_.loads + loads, last_power_.dissipated + losses};
  result.end = {power_.loads + loads, power_.dissipated + losses};
  result.load_work = 0.5 * h * (result.begin.loads + result.end.loads);
  result.dissipated =
      0.5 * h * (result.begin.dissipated + result.end.dissipated);
}

void StepWork::undo() {
  dampers_.undo();
  supplies_.undo();
  power_ = last_power_;
}

void StepWork::exchange_memory(Archive& archive) {
  archive(power_.loads, power_.dissipated);
  dampers_.exchange_memory(archive);
  supplies_.exchange_memory(archive);
}

}  // namespace limber::dynamics
