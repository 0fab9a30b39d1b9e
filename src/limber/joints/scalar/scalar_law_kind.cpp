// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/scalar_law_kind.hpp"

#include "limber/common/errors.hpp"

namespace limber::joints {

EventKind WithoutScalarSwitches::find_event(bool /*rises*/) {
  throw ContractError("an event of a law that has no switches");
}

}  // namespace limber::joints
