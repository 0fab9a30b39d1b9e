// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/controller_probe.hpp"

namespace limber::scene {

std::vector<ProbeColumnName> column_names(const ControllerProbe& /*probe*/,
                                          const std::string& name) {
  return {{name + ".u", "-"}};
}

void append_values(const ControllerProbe& probe,
                   const dynamics::SystemModel& /*model*/,
                   const dynamics::SystemState& state,
                   std::vector<double>& values) {
  values.push_back(find_input(dynamics::now_of(state), probe.input).value);
}

}  // namespace limber::scene
