// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/monitors/contact_start_observer.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Shortens steps while bodies strike each other, so that each impact is
/// resolved whatever the step of a run.
///
/// Equation   omega h <= pi / n while a pair is struck, omega the frequency of
///            its touch at the step's end (TouchReading), n steps a half
///            period; a touch begins with T_c / n, an impact
///            in an ongoing touch with a fiftieth of a part. Struck:
///            approaching or parting, before the step or after it, at more
///            than v / 20, v the speed whose kinetic energy is the touch's
///            elastic energy, and both together at more than |g| h, h the step
///            of the run; what is slower, for longer than a turn takes, rests,
///            as a body on the ground, or in a grip that tightens. After a step
///            one longer by a quarter is tried.
/// Limits     a longer step gets at most that many parts; the remainder is
/// taken
///            at once
class ImpactSteps {
 public:
  /// @param steps n, of half a period of a touch > 0 [-]
  /// @param most_parts of a step
  /// @param model stored by reference
  ImpactSteps(const SystemModel& model, double steps, int most_parts);

  /// Length of the next step, at most h [s].
  [[nodiscard]] double limit(double h, const ContactStartObserver& touches);
  /// A shorter length for the step of `h` from `before` to `after`, if an
  /// impact in it is not resolved [s].
  [[nodiscard]] std::optional<double> find_shorter(
      const SystemState& before, const SystemState& after, double h,
      ContactStartObserver& touches);
  /// Whether bodies rest on each other, after the last step, that vibrate
  /// faster than steps of h [s] resolve.
  [[nodiscard]] bool rests_stiffly(double h) const;
  /// Whether the next step, or the last one that was shortened, is part of an
  /// impact that it resolves.
  [[nodiscard]] bool is_struck() const { return is_struck_; }
  /// Whether the step of the last query is, and did not count as that before;
  /// from here on it does.
  [[nodiscard]] bool take_onset();
  /// Accepts the step of the last query.
  void accept(double h);

  /// Pair whose impacts shorten steps.
  [[nodiscard]] std::size_t fastest() const { return fastest_; }
  /// Pair with which a step got more than the most parts, once.
  [[nodiscard]] std::optional<std::size_t> take_excess();

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  [[nodiscard]] double find_slow() const;
  [[nodiscard]] bool is_fast(double speed, double elastic_speed) const;
  [[nodiscard]] bool turns_back(const joints::TouchReading& now,
                                double h) const;
  [[nodiscard]] double find_approach(std::size_t touch,
                                     const SystemState& before,
                                     const SystemState& after,
                                     ContactStartObserver& touches);

  const SystemModel& model_;
  double steps_;
  int most_parts_;
  SystemState approach_;  // after a step, with the velocities before it
  double longest_;        // next step [s]
  double step_ = 0.0;     // of the run, without impacts [s]
  int parts_ = 0;         // of it, so far
  bool is_struck_ = false;
  double quiet_ = 0.0;     // since a pair approached or parted that fast [s]
  bool is_quiet_ = false;  // the last step asked about
  // The last step asked about: of its touches the largest omega that counts
  // [rad/s], and their pair.
  double frequency_ = 0.0;
  std::size_t fastest_ = 0;
  double rest_frequency_ = 0.0;  // largest of those that do not count [rad/s]
  bool has_excess_ = false;
  bool was_reported_ = false;
};

}  // namespace limber::dynamics
