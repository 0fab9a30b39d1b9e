// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/flexbody/modal/modal_response_oscillator.hpp"

namespace limber::dynamics {

/// All modes of a model as damped oscillators, with their free response over a
/// time that all share, by its closed form.
class FreeVibration {
 public:
  explicit FreeVibration(const SystemModel& model);

  /// @param time that the responses are over [s]
  void set_time(double time);
  [[nodiscard]] double time() const { return time_; }  ///< [s]

  /// Number of modes, in the order of SystemState::eta.
  [[nodiscard]] std::size_t size() const { return oscillators_.size(); }
  [[nodiscard]] const flexbody::ModalOscillator& oscillator(
      std::size_t i) const {
    return oscillators_[i];
  }
  [[nodiscard]] const flexbody::FreeResponse& response(std::size_t i) const {
    return responses_[i];
  }

 private:
  std::vector<flexbody::ModalOscillator> oscillators_;
  std::vector<flexbody::FreeResponse> responses_;
  double time_ = 0.0;
};

}  // namespace limber::dynamics
