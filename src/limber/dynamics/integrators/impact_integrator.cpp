// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/impact_integrator.hpp"

#include <utility>

#include "limber/common/errors.hpp"

namespace limber::dynamics {

ImpactIntegrator::ImpactIntegrator(const SystemModel& model,
                                   std::unique_ptr<Integrator> own,
                                   const EnergyConserving::Settings& settings)
    : own_(std::move(own)), conserving_(model, settings) {}

const Integrator& ImpactIntegrator::last() const {
  return conserved_ ? static_cast<const Integrator&>(conserving_) : *own_;
}

void ImpactIntegrator::start(const SystemState& state, double h) {
  own_->start(state, h);
  is_current_ = was_current_ = true;
}

void ImpactIntegrator::cross_jump(const SystemState& state, double h) {
  if (is_current_) own_->cross_jump(state, h);
}

bool ImpactIntegrator::damp(UnresolvedMotion motion) {
  conserves_ = motion == UnresolvedMotion::conserved;
  return !conserves_ && own_->damp(motion);
}

std::optional<StepResult> ImpactIntegrator::try_conserving(SystemState& state,
                                                           double h,
                                                           double end) {
  // The wrenches of another motion are no guess of those of this one.
  if (!conserved_) conserving_.refresh();
  try {
    return conserving_.step(state, h, end);
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

StepResult ImpactIntegrator::step(SystemState& state, double h, double end) {
  std::optional<StepResult> result;
  if (conserves_) result = try_conserving(state, h, end);
  const bool conserved = result.has_value();
  if (!conserved) {
    if (!is_current_) start(state, h);
    result = own_->step(state, h, end);
  }
  was_current_ = is_current_;
  is_current_ = !conserved;
  conserved_ = conserved;
  return *result;
}

void ImpactIntegrator::undo(const SystemState& before) {
  if (!conserved_) own_->undo(before);
  is_current_ = was_current_;
}

void ImpactIntegrator::refresh() {
  own_->refresh();
  conserving_.refresh();
}

void ImpactIntegrator::exchange_memory(Archive& archive,
                                       const SystemState& state) {
  archive(conserved_, is_current_);
  own_->exchange_memory(archive, state);
  conserving_.exchange_memory(archive, state);
}

long ImpactIntegrator::take_solves() {
  return own_->take_solves() + conserving_.take_solves();
}

}  // namespace limber::dynamics
