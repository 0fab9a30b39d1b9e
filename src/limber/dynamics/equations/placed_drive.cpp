// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/placed_drive.hpp"

#include <cmath>

#include "limber/dynamics/equations/transmission.hpp"

namespace limber::dynamics {
namespace {

joints::ScalarMotion find_along(const SystemModel& model,
                                const SystemState& state,
                                const joints::RelativeMotion& motion,
                                const PlacedDrive& drive) {
  const joints::CoordinateValue value = evaluate(
      joints::coordinates_of(model.couplers[drive.index].law)[drive.coordinate],
      motion, state.memory[drive.index].near[drive.coordinate]);
  return {value.z, value.rate};
}

}  // namespace

std::vector<PlacedDrive> find_drives(const SystemModel& model) {
  std::vector<PlacedDrive> drives;
  const auto add = [&](bool is_transmission, std::size_t index, int coordinate,
                       const joints::ScalarLaw& law) {
    const auto* drive = std::get_if<joints::Drive>(&law);
    if (drive == nullptr) return;
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

std::vector<PlacedDrive> find_limited_drives(const SystemModel& model) {
  std::vector<PlacedDrive> drives = find_drives(model);
  std::erase_if(drives, [](const PlacedDrive& drive) {
    return !std::isfinite(joints::max_effort(*drive.law));
  });
  return drives;
}

const std::string& name_of(const PlacedDrive& drive, const SystemModel& model) {
  return drive.is_transmission ? model.transmissions[drive.index].name
                               : model.couplers[drive.index].name;
}

joints::ScalarMotion find_motion(const SystemModel& model,
                                 const SystemState& state,
                                 const PlacedDrive& drive) {
  if (drive.is_transmission) {
    return find_motion(model, state, model.transmissions[drive.index]);
  }
  const auto coupler = static_cast<CouplerIndex>(drive.index);
  return find_along(model, state, find_relative_motion(model, state, coupler),
                    drive);
}

joints::ScalarMotion find_motion(const SystemModel& model,
                                 const SystemState& state,
                                 const SystemTerms& terms,
                                 const PlacedDrive& drive) {
  if (drive.is_transmission) return terms.transmissions[drive.index].motion;
  return find_along(model, state, terms.couplers[drive.index].motion, drive);
}

}  // namespace limber::dynamics
