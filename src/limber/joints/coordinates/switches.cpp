// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/switches.hpp"

namespace limber::joints {

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::stop_reached:
      return "stop reached";
    case EventKind::stop_left:
      return "stop left";
    case EventKind::taut:
      return "taut";
    case EventKind::slack:
      return "slack";
    case EventKind::latched:
      return "latched";
    case EventKind::released:
      break;
  }
  return "released";
}

bool may_jump(EventKind kind) {
  return kind != EventKind::stop_reached && kind != EventKind::stop_left;
}

}  // namespace limber::joints
