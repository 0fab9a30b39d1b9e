// SPDX-License-Identifier: BSD-3-Clause
#include "joints/scalar_law.hpp"

#include "common/overloaded.hpp"

namespace limber::joints {

ScalarResponse evaluate(const ScalarLaw& law, const ScalarMotion& motion,
                        const Instant& now, const SwitchModes& modes) {
  return std::visit(
      Overloaded{
          [&](const Drive& drive) { return drive.evaluate(motion, now); },
          [&](const Friction& friction) { return friction.evaluate(motion); },
          [&](const auto& other) { return other.evaluate(motion, modes); }},
      law);
}

int switch_count(const ScalarLaw& law) {
  return std::visit(
      Overloaded{
          [](const ScalarSpring& spring) { return spring.switch_count(); },
          [](const EndStop& stop) { return stop.switch_count(); },
          [](const auto&) { return 0; }},
      law);
}

SwitchValue find_switch(const ScalarLaw& law, int index,
                        const ScalarMotion& motion) {
  return std::visit(Overloaded{[&](const ScalarSpring& spring) {
                                 return spring.find_switch(index, motion);
                               },
                               [&](const EndStop& stop) {
                                 return stop.find_switch(index, motion);
                               },
                               [](const auto&) { return SwitchValue{}; }},
                    law);
}

std::vector<double> break_times(const ScalarLaw& law) {
  const auto* drive = std::get_if<Drive>(&law);
  if (drive == nullptr) return {};
  return break_times(drive->parameters().signal);
}

}  // namespace limber::joints
