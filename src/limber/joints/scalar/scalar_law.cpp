// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/scalar_law.hpp"

namespace limber::joints {
namespace {

// Names the function that a law lacks.
template <typename... Laws>
constexpr bool check(const std::variant<Laws...>* /*any*/) {
  return ([]<typename Law>(const Law* /*law*/) {
    static_assert(ScalarLawKind<Law>, "joints/scalar/scalar_law_kind.hpp");
    return true;
  }(static_cast<const Laws*>(nullptr)) &&
          ...);
}
static_assert(check(static_cast<const ScalarLaw*>(nullptr)));

}  // namespace

ScalarResponse evaluate(const ScalarLaw& law, const ScalarMotion& motion,
                        const EvaluationTime& now, const SwitchModes& modes) {
  return std::visit(
      [&](const auto& own) { return own.evaluate(motion, now, modes); }, law);
}

ScalarResponse evaluate_over_step(const ScalarLaw& law,
                                  const CoordinateStep& coordinate,
                                  const StepTimes& times,
                                  const SwitchModes& modes) {
  return std::visit(
      [&](const auto& own) {
        return own.evaluate_over_step(coordinate, times, modes);
      },
      law);
}

int switch_count(const ScalarLaw& law) {
  return std::visit([](const auto& own) { return own.switch_count(); }, law);
}

SwitchValue find_switch(const ScalarLaw& law, int index,
                        const ScalarMotion& motion) {
  return std::visit(
      [&](const auto& own) { return own.find_switch(index, motion); }, law);
}

EventKind find_event(const ScalarLaw& law, bool rises) {
  return std::visit([&](const auto& own) { return own.find_event(rises); },
                    law);
}

std::vector<double> break_times(const ScalarLaw& law) {
  return std::visit([](const auto& own) { return own.break_times(); }, law);
}

std::vector<int> find_inputs(const ScalarLaw& law) {
  return std::visit([](const auto& own) { return own.find_inputs(); }, law);
}

double max_effort(const ScalarLaw& law) {
  return std::visit([](const auto& own) { return own.max_effort(); }, law);
}

double find_load(const ScalarLaw& law, const ScalarMotion& motion,
                 const EvaluationTime& now) {
  return std::visit([&](const auto& own) { return own.find_load(motion, now); },
                    law);
}

std::optional<Supply> find_supply(const ScalarLaw& law,
                                  const ScalarMotion& motion,
                                  const EvaluationTime& now) {
  return std::visit(
      [&](const auto& own) { return own.find_supply(motion, now); }, law);
}

std::optional<BeyondBound> find_beyond_bound(const ScalarLaw& law,
                                             const ScalarMotion& motion) {
  return std::visit(
      [&](const auto& own) { return own.find_beyond_bound(motion); }, law);
}

void TargetRate::add(const ScalarLaw& law, const ScalarMotion& motion,
                     const EvaluationTime& now, const SwitchModes& modes) {
  const double damping = evaluate(law, motion, now, modes).damping;
  damping_ += damping;
  push_ += damping *
           std::visit(
               [&](const auto& own) { return own.find_target_rate(now); }, law);
}

}  // namespace limber::joints
