// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/step_observer.hpp"

#include "limber/dynamics/equations/equations.hpp"

namespace limber::dynamics {
namespace {

constexpr long kStride = 8;

// Whether the integrator's terms at a step's end also serve the step_observer.
// Explicit schemes do not need these terms, which cost a product with the mass
// matrix of unreduced bodies.
bool leaves_terms(const SystemModel& model, IntegratorKind integrator) {
  const IntegratorTraits& traits = traits_of(integrator);
  return traits.leaves_end_terms &&
         (traits.is_implicit || model.nodal_count == 0);
}

}  // namespace

StepObserver::StepObserver(const SystemModel& model, IntegratorKind integrator,
                           double h, SystemTerms& scratch)
    : model_(model),
      energy_observer_(model, integrator, h),
      deflection_(model),
      limits_(model),
      terms_(scratch),
      stride_(leaves_terms(model, integrator) ? 1 : kStride) {}

const SystemTerms& StepObserver::evaluate(const SystemState& state, Side side) {
  calc_terms(model_, state, side, terms_);
  return terms_;
}

void StepObserver::start(const SystemState& state, const SystemTerms& terms,
                         double taken, std::vector<Event>& events) {
  energy_observer_.start(state, terms, taken);
  deflection_.include(state, terms);
  limits_.include(state, terms, events);
}

void StepObserver::cross_jump(const SystemState& state,
                              const EnergyFlows& flows) {
  if (stride_ > 1 && steps_ % stride_ != 0) {
    energy_observer_.add(state, evaluate(state, Side::left), flows);
  }
  energy_observer_.restart(state, evaluate(state, Side::right));
}

void StepObserver::include(const SystemState& state, const SystemTerms* terms,
                           const EnergyFlows& flows, bool is_exact,
                           std::vector<Event>& events) {
  ++steps_;
  const bool has_event = terms == nullptr;
  if (!has_event && !is_exact && steps_ % stride_ != 0) return;
  const SystemTerms* now = terms;
  const bool needs_exact = has_event || is_exact || stride_ > 1;
  if (needs_exact || energy_observer_.has_passed_peak(*terms)) record_peak();
  if (needs_exact || !energy_observer_.try_add(state, *terms, flows)) {
    now = &evaluate(state, Side::left);
    energy_observer_.add(state, *now, flows);
  }
  deflection_.include(state, *now);
  limits_.include(state, *now, events);
}

void StepObserver::record_peak() {
  const SystemState* peak = energy_observer_.peak();
  if (peak == nullptr) return;
  energy_observer_.include_peak(evaluate(*peak, Side::left));
}

EnergyRecord StepObserver::find_energy() const {
  const EnergyRows rows(model_);
  VectorX negligible = VectorX::Zero(rows.count);
  deflection_.add_negligible_energies(
      negligible.segment(rows.couplers, std::ssize(model_.couplers)));
  EnergyRecord record = energy_observer_.find_record(negligible);
  if (const SystemState* peak = energy_observer_.peak()) {
    SystemTerms terms = make_terms(model_);
    calc_terms(model_, *peak, Side::left, terms);
    record.coupler.include(sum_coupler_energies(terms), peak->t);
  }
  return record;
}

void StepObserver::add_warnings(std::vector<std::string>& warnings) const {
  for (const auto& texts :
       {deflection_.find_warnings(), limits_.find_warnings()}) {
    warnings.insert(warnings.end(), texts.begin(), texts.end());
  }
}

void StepObserver::exchange_memory(Archive& archive) {
  archive(steps_);
  energy_observer_.exchange_memory(archive);
  deflection_.exchange_memory(archive);
  limits_.exchange_memory(archive);
}

}  // namespace limber::dynamics
