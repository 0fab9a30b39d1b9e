// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/check_value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::contact {

void check_value(bool holds, const char* what, double value,
                 const char* expected) {
  if (holds && std::isfinite(value)) return;
  throw InputError(fmt::format("contact: its {} is {:g}; expected {}", what,
                               value, expected));
}

}  // namespace limber::contact
