// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/modal/modal_response.hpp"

namespace limber::dynamics {

/// Splits a system into modes driven by known loads only, solved in closed form
/// at any time, and the rest, which is integrated in steps.
///
/// Source     SimpleRB of the WOBBLE report [@morrison2023, section 3.4.3];
///            has_closed_modal_loads (modal_loads.hpp) selects the bodies
class ExactModes {
 public:
  /// @param start state of the whole system at the start
  ExactModes(const SystemModel& model, const SystemState& start);

  /// Number of modes solved in closed form.
  [[nodiscard]] int count() const { return count_; }

  /// The same system without them; its bodies have the same indices.
  [[nodiscard]] const SystemModel& rest() const { return rest_; }
  /// Whether the rest has any degree of freedom.
  [[nodiscard]] bool has_motion_left() const;
  [[nodiscard]] SystemState take_rest(const SystemState& whole) const;

  /// Evaluates the modes at all `times` [s], not before the start.
  void prepare(const std::vector<double>& times);
  /// Writes the rest's state and the modes at prepared time i to `whole`.
  void join(const SystemState& rest, std::size_t i, SystemState& whole) const;
  /// The same at rest.t, which need not be prepared.
  void join(const SystemState& rest, SystemState& whole) const;
  /// Writes the rest's state alone; the modes keep their last values.
  void join_rest(const SystemState& rest, SystemState& whole) const;
  /// Longest sampling interval that misses no extreme of the modes until `end`
  /// [s]: a tenth of the shortest period of the loads and of the modes whose
  /// energy is at least a millionth of the largest; infinite if none moves [s].
  [[nodiscard]] double find_longest_look(double end) const;

  /// Work of loads on the modes and energy dissipated until prepared time i.
  struct Losses {
    double work = 0.0;        ///< [J]
    double dissipated = 0.0;  ///< [J]
  };
  [[nodiscard]] Losses losses(std::size_t i) const;

 private:
  struct Part {
    int offset = 0;  // in the whole state
    VectorX lambda;
    flexbody::ModalResponse response;
    flexbody::ModalHistory history;  // at the prepared times
    double fastest_load = 0.0;       // of sinusoids [rad/s]
    VectorX work;                    // of all modes, at the prepared times
    VectorX dissipated;
  };

  const SystemModel& model_;
  SystemModel rest_;
  double start_ = 0.0;  // [s]
  std::vector<Part> parts_;
  int count_ = 0;
};

}  // namespace limber::dynamics
