// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "joints/drive.hpp"
#include "joints/end_stop.hpp"
#include "joints/friction.hpp"
#include "joints/scalar_spring.hpp"

namespace limber::joints {

/// What acts along one coordinate. A new law joins here, in docs/joints.md and
/// in the contract of scalar laws.
using ScalarLaw = std::variant<ScalarSpring, Friction, EndStop, Drive>;

[[nodiscard]] ScalarResponse evaluate(const ScalarLaw& law,
                                      const ScalarMotion& motion,
                                      const Instant& now,
                                      const SwitchModes& modes = {});

/// How many switches a law has, and one of them by its index below this.
[[nodiscard]] int switch_count(const ScalarLaw& law);
[[nodiscard]] SwitchValue find_switch(const ScalarLaw& law, int index,
                                      const ScalarMotion& motion);

/// Times at which a law's command or a derivative of it jumps, increasing [s].
[[nodiscard]] std::vector<double> break_times(const ScalarLaw& law);

}  // namespace limber::joints
