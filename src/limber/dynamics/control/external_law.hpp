// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>

#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/system/controller.hpp"

namespace limber::dynamics {

/// The law of a controller whose output is set from outside
/// (Simulator::set_external_outputs). ControllerModel::memory is that output,
/// one number for each of ControllerModel::writes [unit of the input].
class ExternalLaw final : public Controller {
 public:
  void sample(const ControllerView& /*view*/, std::span<double> memory,
              std::span<double> written) const override {
    std::copy(memory.begin(), memory.end(), written.begin());
  }
  void describe(Manifest& out) const override {
    out.add("law", "set from outside");
  }
};

[[nodiscard]] inline bool is_external(const ControllerModel& controller) {
  return dynamic_cast<const ExternalLaw*>(controller.law.get()) != nullptr;
}

}  // namespace limber::dynamics
