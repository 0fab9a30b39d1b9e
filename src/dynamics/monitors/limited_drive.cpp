// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/limited_drive.hpp"

#include <cmath>

namespace limber::dynamics {

std::vector<LimitedDrive> find_limited_drives(const SystemModel& model) {
  std::vector<LimitedDrive> drives;
  const auto add = [&](bool is_transmission, std::size_t index, int coordinate,
                       const joints::ScalarLaw& law) {
    const auto* drive = std::get_if<joints::Drive>(&law);
    if (drive == nullptr || !std::isfinite(drive->max_effort())) return;
    drives.push_back({is_transmission, index,
                      static_cast<std::size_t>(coordinate), &law,
                      drive->parameters().pulls_only});
  };
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    for (const joints::JointElement& element :
         joints::elements_of(model.couplers[c].law)) {
      add(false, c, element.coordinate, element.law);
    }
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    for (const joints::ScalarLaw& law : model.transmissions[i].laws) {
      add(true, i, 0, law);
    }
  }
  return drives;
}

const std::string& name_of(const LimitedDrive& drive,
                           const SystemModel& model) {
  return drive.is_transmission ? model.transmissions[drive.index].name
                               : model.couplers[drive.index].name;
}

}  // namespace limber::dynamics
