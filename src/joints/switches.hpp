// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "joints/coupler_law.hpp"

/// Events of couplers: functions of the motion whose sign changes when one
/// happens.
namespace limber::joints {

enum class EventKind {
  stop_reached,
  stop_left,
  taut,
  slack,
  latched,
  released,
};
[[nodiscard]] std::string_view to_string(EventKind kind);

/// How many switches a law has; each is found by its index below this.
[[nodiscard]] int switch_count(const CouplerLaw& law);
/// @param t time [s]
/// @throws ContractError for an index that is not below the count.
/// @throws NumericalError as AxisCoordinate does.
[[nodiscard]] SwitchValue find_switch(const CouplerLaw& law, int index,
                                      const RelativeMotion& motion,
                                      const CouplerMemory& memory, double t);

/// What it means that a switch's sign changes, if anything.
/// @param memory that before the change
[[nodiscard]] std::optional<EventKind> find_event(const CouplerLaw& law,
                                                  int index, bool rises,
                                                  const CouplerMemory& memory);
[[nodiscard]] EventKind find_event(const ScalarLaw& law, bool rises);

/// Changes what the coupler remembers, after switch `index` rose.
void update_memory(const CouplerLaw& law, int index,
                   const RelativeMotion& motion, CouplerMemory& memory);

}  // namespace limber::joints
