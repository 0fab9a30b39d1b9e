// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/operating_state.hpp"

#include <fmt/format.h>

namespace limber::flexbody {

std::string describe(const LinearTrust& trust) {
  return fmt::format(
      "displacement {:.3g} of the body's size, strain {:.3g}, rotation {:.3g} "
      "rad: {} the linear limit of {}",
      trust.displacement, trust.strain, trust.rotation,
      trust.is_linear() ? "within" : "beyond", LinearTrust::kLimit);
}

}  // namespace limber::flexbody
