// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/system_state.hpp"
#include "flexbody/modal_response.hpp"

namespace limber::dynamics {

/// Splits a system in two: modes that only known loads drive, answered in
/// closed form at any time, and the rest, which needs time steps.
///
/// Source     the report's SimpleRB [@morrison2023, section 3.4.3]; which
///            bodies qualify is has_closed_modal_loads (dynamics/modal_loads)
class ExactModes {
 public:
  /// @param start state of the whole system at the start
  ExactModes(const SystemModel& model, const SystemState& start);

  /// Modes answered in closed form.
  [[nodiscard]] int count() const { return count_; }

  /// The same system without them; its bodies have the same indices.
  [[nodiscard]] const SystemModel& rest() const { return rest_; }
  /// Whether anything in the rest moves.
  [[nodiscard]] bool has_motion_left() const;
  [[nodiscard]] SystemState take_rest(const SystemState& whole) const;

  /// Answers `times` [s], from the start on, at once.
  void prepare(const std::vector<double>& times);
  /// Puts the rest's state and the modes at prepared time i into `whole`.
  void join(const SystemState& rest, std::size_t i, SystemState& whole) const;
  /// The same at rest.t, whatever was prepared.
  void join(const SystemState& rest, SystemState& whole) const;
  /// The rest's state alone: the modes stay as they were joined before.
  void join_rest(const SystemState& rest, SystemState& whole) const;
  /// Between two looks, at most, that miss no extreme of the modes until `end`:
  /// a tenth of the shortest period of the modes that have a millionth of the
  /// largest energy of one, and of the loads on them; infinite if none moves
  /// [s].
  [[nodiscard]] double find_longest_look(double end) const;

  /// What the modes took from loads and lost by prepared time i.
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
