// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/step_work.hpp"

namespace limber::dynamics {

StepWork::StepWork(const SystemModel& model)
    : pairs_(EnergyRows(model).pairs),
      dampers_(model),
      supplies_(model),
      power_(make_flows(model)),
      last_power_(power_),
      flows_(power_) {}

// What friction loses is known as a mean over the step.
void StepWork::add_slip(const SystemTerms& terms, double duration,
                        EnergyFlows& flows) const {
  Eigen::Index i = 0;
  for (const joints::PairResponse& pair : terms.pairs.responses) {
    const double lost = duration * pair.slip_power;
    flows.dissipated[pairs_ + i] += lost;
    flows.rubbed[i++] += lost;
  }
}

void StepWork::set_powers(const SystemTerms& terms) {
  power_.clear();
  add_powers(terms, 1.0, power_);
  add_slip(terms, -1.0, power_);
}

void StepWork::start(const SystemState& state, const SystemTerms& terms) {
  set_powers(terms);
  dampers_.start(terms);
  supplies_.start(state, terms);
}

void StepWork::advance(const SystemState& from, const SystemState& to,
                       const SystemTerms& terms, double h, StepResult& result) {
  std::swap(power_, last_power_);
  set_powers(terms);
  const StepPower begin = sum(last_power_);
  const StepPower end = sum(power_);
  flows_ = last_power_;
  flows_ += power_;
  flows_ *= 0.5 * h;
  add_slip(terms, h, flows_);
  supplies_.advance(to, terms, h, flows_.supplied);
  dampers_.advance(from, to, terms, h, flows_.dissipated);
  set_work(flows_, result);
  const double loads = result.load_work / h - 0.5 * (begin.loads + end.loads);
  const double losses =
      result.dissipated / h - 0.5 * (begin.dissipated + end.dissipated);
  result.begin = {begin.loads + loads, begin.dissipated + losses};
  result.end = {end.loads + loads, end.dissipated + losses};
}

void StepWork::undo() {
  dampers_.undo();
  supplies_.undo();
  std::swap(power_, last_power_);
}

void StepWork::exchange_memory(Archive& archive) {
  archive(power_);
  dampers_.exchange_memory(archive);
  supplies_.exchange_memory(archive);
}

}  // namespace limber::dynamics
