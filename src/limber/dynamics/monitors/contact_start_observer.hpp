// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/monitors/event.hpp"
#include "limber/dynamics/monitors/travel_bound.hpp"
#include "limber/dynamics/newton/joint_mobility.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::dynamics {

/// Monitors which pairs are in contact from step to step, and locates the
/// beginning and the end of contact.
///
/// Equation   between a step's ends positions are cubic, as for outputs between
///            steps. A touch is found by conservative advancement: no touch is
///            possible during clearance / largest speed, so that thin shapes
///            are not missed. A known distance remains a bound until both
///            bodies have moved that far (TravelBound): distant pairs cost two
///            sums a step
/// Source     [@mirtich1996, ch. 2]
/// Limits     an end and a beginning of contact within one step are not
/// detected; between two
///            evaluations a body must not turn by more than half a turn
class ContactStartObserver {
 public:
  /// Steps per T_c of an impact [-].
  static constexpr double kStepsOfImpact = 16.0;
  /// Smallest number of steps per T_c that resolves its restitution [-].
  static constexpr double kFewestSteps = 4.0;
  /// With fewer of them a step may gain energy, which is checked.
  static constexpr double kSureSteps = 8.0;

  explicit ContactStartObserver(const SystemModel& model);

  [[nodiscard]] bool is_empty() const { return pairs_.empty(); }

  /// Pairs that overlap touch from the start.
  void start(SystemState& state, std::vector<Event>& events);

  struct Crossing {
    std::size_t index = 0;  ///< of the pair, among those observed
    double fraction = 0.0;  ///< fraction of the step, in [0, 1] [-]
  };
  /// Marks in `state` the pairs that do not touch: they have no points in the
  /// next step, even if it ends beyond their touch, which is then found on the
  /// path without contact forces.
  void mark_apart(SystemState& state) const;
  /// The first touch or leave in a step from `before` to `after`.
  [[nodiscard]] std::optional<Crossing> find_first(const SystemState& before,
                                                   const SystemState& after);

  /// Refuses a step of h [s] from the last accepted state in which two touching
  /// bodies could pass through each other.
  /// @throws NumericalError naming the pair.
  void check_step(double h, double t) const;
  /// Depth of a pair before a step that ends without any place of contact
  /// although it cannot have parted; else 0 [m].
  [[nodiscard]] double find_lost_depth(std::size_t index,
                                       const SystemState& before,
                                       const SystemState& after);
  /// Accepts a step from `before` to `state`.
  void accept(const SystemState& before, const SystemState& state);

  /// Signed distance of a pair from the touch or leave that was found: < 0
  /// before it, > 0 after it [m].
  [[nodiscard]] double find_excess(std::size_t index, const SystemState& state);
  /// Distance that counts as zero for a pair [m]: apart, in the search that
  /// found its touch; touching, as it moves at `state`, in steps of h [s].
  [[nodiscard]] double find_tolerance(std::size_t index,
                                      const SystemState& state, double h);

  /// Whether a pair overlaps by more than a twentieth of the bodies' size.
  [[nodiscard]] bool is_deep(std::size_t index, const SystemState& state);

  /// Marks the pair as touching, or as apart, from here on.
  void pass(std::size_t index, SystemState& state, std::vector<Event>& events);
  /// Marks all pairs that overlap at `state` as touching, and no others.
  void pass_all(SystemState& state, std::vector<Event>& events);

  /// Index into SystemModel::pairs of each pair observed.
  [[nodiscard]] std::size_t pair_of(std::size_t index) const {
    return pairs_[index].pair;
  }
  [[nodiscard]] std::size_t count() const { return pairs_.size(); }
  [[nodiscard]] bool is_touching(std::size_t index) const {
    return pairs_[index].is_touching;
  }
  /// T_c of a free impact at the last touch's speed [s].
  [[nodiscard]] double impact_duration(std::size_t index) const {
    return pairs_[index].impact_duration;
  }
  /// T_c / parts of the shortest touch that the last step ended at, or that
  /// there is from the start, faster than `slow` [m/s]; infinite without any
  /// [s].
  [[nodiscard]] double find_first_step(double parts, double slow) const;
  /// Longest step that resolves ongoing impacts; infinite without any. A touch
  /// of more than eight times the expected duration is rest [s].
  [[nodiscard]] double find_longest_step(double t) const;
  struct Impact {
    double steps = std::numeric_limits<double>::infinity();  ///< T_c / h [-]
    std::size_t pair = 0;                                    ///< if any
  };
  /// The shortest ongoing impact. An impact is ongoing for three steps from a
  /// touch, or eight times T_c.
  [[nodiscard]] Impact find_impact(double h, double t) const;
  /// The shortest touch, an impact or not.
  [[nodiscard]] Impact find_touch_in(double h) const;
  /// Both bodies at `state`, until its next call for this pair.
  [[nodiscard]] joints::PairBodies find_bodies(std::size_t index,
                                               const SystemState& state) {
    return set_motion(pairs_[index], state);
  }
  /// The touch at `state`.
  [[nodiscard]] joints::PairTouch find_touch(std::size_t index,
                                             const SystemState& state);
  [[nodiscard]] joints::TouchReading read(std::size_t index,
                                          const SystemState& state);

  /// Discards distances that exchange_memory does not save: all pairs are
  /// looked at again.
  void refresh();
  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Observed {
    std::size_t pair = 0;
    const joints::Touching* law = nullptr;
    bool is_touching = false;
    // Of the last touch or leave [s].
    double since = std::numeric_limits<double>::lowest();
    double impact_duration = 0.0;  // [s]
    double rate = 0.0;             // of the depth, while they touch [m/s]
    int steps = 0;                 // accepted since the touch
    // Travel of both bodies up to which they cannot touch [m].
    double look_at = 0.0;
    double near = 0.0;      // distance that counts as a touch [m]
    bool is_clear = false;  // in the step last searched
    joints::PairResponse scratch;
    PairMotion motion;
  };
  [[nodiscard]] joints::PairBodies set_motion(Observed& observed,
                                              const SystemState& state) const;
  [[nodiscard]] double find_speed_bound(Observed& observed,
                                        const SystemState& state) const;
  [[nodiscard]] double find_clearance(Observed& observed,
                                      const SystemState& state) const;
  // Of the distance of both bodies, for the places they are at [m].
  [[nodiscard]] double find_rounding(const Observed& observed,
                                     const SystemState& state) const;
  [[nodiscard]] double find_least_advance(Observed& observed,
                                          const SystemState& before,
                                          double part_of_size);
  [[nodiscard]] std::optional<double> find_touch_fraction(
      Observed& observed, const SystemState& before, const SystemState& after);
  [[nodiscard]] bool has_left(Observed& observed, const SystemState& after);
  template <typename Predicate>
  [[nodiscard]] const Observed* find_shortest(const Predicate& counts) const;
  [[nodiscard]] static Impact describe(const Observed* touch, double h);
  // Whether a touching pair is no longer in an impact.
  [[nodiscard]] static bool has_rested(const Observed& observed, double t);
  // @param is_early whether `within_` is before what is looked for
  template <typename Predicate>
  double bisect(const SystemState& before, const SystemState& after, double low,
                double high, const Predicate& is_early);
  [[nodiscard]] double find_leave_fraction(Observed& observed,
                                           const SystemState& before,
                                           const SystemState& after);
  [[nodiscard]] joints::PairTouch find_touch(Observed& observed,
                                             const SystemState& state);

  void find_ways(const SystemState& before, const SystemState& after);
  [[nodiscard]] bool is_clear(Observed& observed, const SystemState& before);

  const SystemModel& model_;
  std::vector<Observed> pairs_;
  TravelBound travel_;
  JointMobility mobility_;
  std::vector<double> first_speeds_;  // of each body [m/s]
  std::vector<double> ways_;          // of each in a step, at most [m]
  SystemState within_;                // between a step's ends
};

}  // namespace limber::dynamics
