// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/fidelity.hpp"

#include "limber/common/names.hpp"

namespace limber::dynamics {

const std::vector<std::string>& fidelity_names() {
  static const std::vector<std::string> names = {
      "rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full"};
  return names;
}

std::string_view to_string(Fidelity fidelity) {
  return fidelity_names()[static_cast<std::size_t>(fidelity)];
}

Fidelity parse_fidelity(std::string_view name) {
  return static_cast<Fidelity>(find_name("fidelity", name, fidelity_names()));
}

}  // namespace limber::dynamics
