// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/common/records/envelopes.hpp"
#include "limber/dynamics/monitors/followed.hpp"

namespace limber::dynamics {

/// A value at a time.
struct PeakPoint {
  double t = 0.0;  ///< [s]
  double y = 0.0;  ///< [unit of the value]
  int place = -1;  ///< Followed::find_place
};
using PeakPoints = std::array<PeakPoint, 3>;  ///< in order of time

/// Extremes in time of a run's scalars, over all its steps and in intervals of
/// time; passes the states that it evaluates to their motion_observer.
///
/// Equation   a local extreme of three values in a row, at the ends of steps,
///            is searched for within the steps if the parabola through them
///            exceeds the extreme so far: for Course::motion on the
///            interpolated state (dynamics/interpolation), by successive
///            parabolas; for Course::values on the parabola itself.
/// Source     successive parabolic interpolation [@brent1973, ch. 5]
/// Limits     of two extremes within a step the smaller may be found. At most
///            half the range of the three values is added to them: beyond that
///            the steps do not resolve the motion.
class PeakObserver {
 public:
  /// @param model of the states; stored by reference
  /// @param edges of the intervals (common/records/envelopes.hpp)
  PeakObserver(const SystemModel& model, Followed followed,
               std::vector<double> edges = {});

  /// The initial state of a run.
  void start(const SystemState& state);
  /// The end of a step. Couplers' memory may have changed there.
  void include(const SystemState& state);
  /// A load or a command may jump at `state`, the end of the last step.
  void cross_jump(const SystemState& state);
  /// Ends the monitoring. @returns one entry per scalar
  const std::vector<Extreme>& finish();
  /// finish(), where each extreme was, -1 for nowhere (Followed::find_place),
  /// and the envelopes.
  void store(std::vector<Extreme>& peaks, std::vector<int>& places,
             Envelopes& envelopes) {
    peaks = finish();
    places = places_;
    envelopes = envelopes_;
  }

  /// Saves or restores its state for checkpoints, except envelopes, which grow
  /// with the run.
  void exchange_memory(Archive& archive);
  /// The intervals that may have changed since the last call, for a
  /// checkpoint's log. It may have values of steps after the checkpoint, which
  /// a resumed run finds again.
  [[nodiscard]] std::vector<double> take_log();
  /// After exchange_memory(). @param log of all checkpoints
  void restore_log(const std::vector<double>& log);

 private:
  // A state and its values; at a jump the values before it.
  struct Sample {
    SystemState state;
    std::vector<double> values;
    std::vector<int> places;  // of the values
  };
  friend void exchange(Archive& archive, Sample& sample);

  // In which of the outer spans of consecutive samples a maximum is searched
  // for; in the middle one always.
  struct Edges {
    bool first = false;
    bool last = false;
  };

  [[nodiscard]] bool is_idle() const { return followed_.is_empty(); }
  void show(const SystemState& state) const;
  [[nodiscard]] Sample& sample(int age) {
    return samples_[static_cast<std::size_t>((newest_ + 3 - age) % 3)];
  }
  void add(const SystemState& state, double t);
  void add_within(const SystemState& end, double parts);
  void begin_anew(const SystemState& state);
  void look(Edges edges);
  void look(std::size_t scalar, const PeakPoints& points, Edges edges);
  [[nodiscard]] PeakPoint search(std::size_t scalar, PeakPoints points,
                                 double sign, double t);
  [[nodiscard]] PeakPoint evaluate_at(std::size_t scalar, double t);
  [[nodiscard]] int find_place(std::size_t scalar) const {
    return followed_.find_place ? followed_.find_place(scalar) : -1;
  }
  void include(std::size_t scalar, const PeakPoint& point) {
    limber::include(envelopes_, scalar, point.y, point.t);
    if (peaks_[scalar].include(point.y, point.t)) {
      places_[scalar] = point.place;
    }
  }

  const SystemModel& model_;
  Followed followed_;
  std::array<Sample, 3> samples_;  // a ring
  int newest_ = 0;
  int count_ = 0;  // of samples since the last jump, at most 4
  SystemState begin_;
  SystemState between_;
  SystemState within_;
  std::vector<double> values_;
  std::vector<Extreme> peaks_;
  std::vector<int> places_;  // of the peaks
  std::vector<double> edges_;
  Envelopes envelopes_;
  double logged_until_ = 0.0;  // later values are in no log [s]
};

}  // namespace limber::dynamics
