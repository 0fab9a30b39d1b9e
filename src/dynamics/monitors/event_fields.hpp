// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/dynamics/monitors/event.hpp"

namespace limber::dynamics {

constexpr auto fields_of(const Event*) {
  return list_fields("event", "time [s]", "source", "what",
                     "rate [m/s, rad/s]");
}

}  // namespace limber::dynamics
