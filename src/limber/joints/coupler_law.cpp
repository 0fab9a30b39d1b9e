// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coupler_law.hpp"

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

// Names the function that a law lacks.
template <typename... Laws>
constexpr bool check_kinds(const std::variant<Laws...>* /*any*/) {
  return ([]<typename Law>(const Law* /*law*/) {
    static_assert(CouplerLawKind<Law>, "joints/coupler_law_kind.hpp");
    return true;
  }(static_cast<const Laws*>(nullptr)) &&
          ...);
}
static_assert(check_kinds(static_cast<const CouplerLaw*>(nullptr)));

}  // namespace

CouplerResponse evaluate(const CouplerLaw& law, const RelativeMotion& motion,
                         const CouplerMemory& memory,
                         const EvaluationTime& now) {
  return std::visit(
      [&](const auto& own) { return own.evaluate(motion, memory, now); }, law);
}

CouplerResponse evaluate_over_step(const CouplerLaw& law,
                                   const MotionStep& motion,
                                   const CouplerMemory& memory,
                                   const StepTimes& times) {
  return std::visit(
      [&](const auto& own) {
        return own.evaluate_over_step(motion, memory, times);
      },
      law);
}

RequiredSides find_required_rotations(const CouplerLaw& law) {
  return std::visit(
      [](const auto& own) { return own.find_required_rotations(); }, law);
}

int switch_count(const CouplerLaw& law) {
  return std::visit([](const auto& own) { return own.switch_count(); }, law);
}

SwitchValue find_switch(const CouplerLaw& law, int index,
                        const RelativeMotion& motion,
                        const CouplerMemory& memory, double t) {
  LIMBER_EXPECT(index >= 0 && index < switch_count(law));
  return std::visit(
      [&](const auto& own) {
        return own.find_switch(index, motion, memory, t);
      },
      law);
}

std::optional<EventKind> find_event(const CouplerLaw& law, int index,
                                    bool rises, const CouplerMemory& memory) {
  LIMBER_EXPECT(index >= 0 && index < switch_count(law));
  return std::visit(
      [&](const auto& own) { return own.find_event(index, rises, memory); },
      law);
}

bool has_triggers(const CouplerLaw& law) {
  return std::visit([](const auto& own) { return own.has_triggers(); }, law);
}

void update_memory(const CouplerLaw& law, int index,
                   const RelativeMotion& motion, CouplerMemory& memory) {
  std::visit([&](const auto& own) { own.update(index, motion, memory); }, law);
}

const std::vector<AxisCoordinate>& coordinates_of(const CouplerLaw& law) {
  return std::visit(
      [](const auto& own) -> const auto& { return own.coordinates(); }, law);
}

const std::vector<JointElement>& elements_of(const CouplerLaw& law) {
  return std::visit(
      [](const auto& own) -> const auto& { return own.elements(); }, law);
}

std::vector<double> break_times(const CouplerLaw& law) {
  return std::visit([](const auto& own) { return own.break_times(); }, law);
}

std::vector<int> find_inputs(const CouplerLaw& law) {
  return std::visit([](const auto& own) { return own.find_inputs(); }, law);
}

Vector6 find_target_velocity(const CouplerLaw& law,
                             const RelativeMotion& motion,
                             const CouplerMemory& memory,
                             const EvaluationTime& now) {
  return std::visit(
      [&](const auto& own) {
        return own.find_target_velocity(motion, memory, now);
      },
      law);
}

std::optional<ConstraintStiffness> find_constraint_stiffness(
    const CouplerLaw& law) {
  return std::visit(
      [](const auto& own) { return own.find_constraint_stiffness(); }, law);
}

ConstraintDeflection find_deflection(const CouplerLaw& law,
                                     const ConstraintStiffness& stiffness,
                                     const RelativeMotion& motion) {
  return std::visit(
      [&](const auto& own) { return own.find_deflection(stiffness, motion); },
      law);
}

bool is_ideal(const CouplerLaw& law) {
  const auto* joint = std::get_if<Joint>(&law);
  return joint != nullptr && joint->is_ideal();
}

ConstraintGap find_constraint_gap(const CouplerLaw& law,
                                  const RelativeMotion& motion) {
  const auto* joint = std::get_if<Joint>(&law);
  LIMBER_EXPECT(joint != nullptr);
  return joint->find_constraint_gap(motion);
}

std::vector<AxisCoordinate::Kind> reading_kinds(const CouplerLaw& law) {
  return std::visit([](const auto& own) { return own.reading_kinds(); }, law);
}

CoordinateReading read(const CouplerLaw& law, int coordinate,
                       const RelativeMotion& motion,
                       const CouplerMemory& memory, const EvaluationTime& now) {
  return std::visit(
      [&](const auto& own) {
        return own.read(coordinate, motion, memory, now);
      },
      law);
}

}  // namespace limber::joints
