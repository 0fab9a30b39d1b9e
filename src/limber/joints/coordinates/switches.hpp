// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

/// Switches of laws: functions of the motion whose sign changes when an event
/// happens.
namespace limber::joints {

/// Position of a switch: by the sign of its value, or fixed through a step, so
/// that a law is smooth within the step and changes only between steps.
enum class SwitchMode : unsigned char { by_motion, off, on };

/// Largest number of switches of a scalar law.
inline constexpr int kMaxScalarSwitches = 2;
using SwitchModes = std::array<SwitchMode, kMaxScalarSwitches>;

[[nodiscard]] inline bool is_on(SwitchMode mode, bool by_motion) {
  return mode == SwitchMode::by_motion ? by_motion : mode == SwitchMode::on;
}

/// A function of the motion whose change of sign is an event.
struct SwitchValue {
  double value = 0.0;  ///< [m, rad, N or s]
  double rate = 0.0;   ///< d value / dt [m/s, rad/s, N/s or -]
};

/// Events at changes of a switch's sign.
enum class EventKind {
  stop_reached,
  stop_left,
  taut,
  slack,
  latched,
  released,
};
[[nodiscard]] std::string_view to_string(EventKind kind);

/// Whether forces may be discontinuous at such an event.
[[nodiscard]] bool may_jump(EventKind kind);

}  // namespace limber::joints
