// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/followed.hpp"

namespace limber::dynamics {

/// A value at a time.
struct PeakPoint {
  double t = 0.0;  ///< [s]
  double y = 0.0;
};
using PeakPoints = std::array<PeakPoint, 3>;  ///< in the order of time

/// For checkpoints.
void exchange(Archive& archive, Extreme& extreme);

/// Extremes in time of scalars that a run follows, over all its steps; shows
/// their spectator what it looks at.
///
/// Equation   a local extreme of three values in a row, at the ends of steps,
///            is looked for within the steps if the parabola through them
///            beats the extreme so far: for Course::motion on the state between
///            (dynamics/interpolation), by successive parabolas; for
///            Course::values on the parabola itself.
/// Source     successive parabolic interpolation [@brent1973, ch. 5]
/// Limits     of two extremes within a step the smaller may be found. No more
///            than half of what three values span is added to them: beyond
///            that the steps do not resolve the motion.
class PeakWatch {
 public:
  /// @param model of the states; kept by reference
  PeakWatch(const SystemModel& model, Followed followed);

  /// The state that a run begins with.
  void start(const SystemState& state);
  /// The end of a step. What couplers remember may have changed there.
  void include(const SystemState& state);
  /// A load or a command may jump at `state`, the end of the last step.
  void cross_jump(const SystemState& state);
  /// No step follows. @returns one entry a scalar
  const std::vector<Extreme>& finish();

  /// What it knows between steps.
  void exchange_memory(Archive& archive);

 private:
  // A state and its values; at a jump those before it.
  struct Sample {
    SystemState state;
    std::vector<double> values;
  };
  friend void exchange(Archive& archive, Sample& sample);

  // Of three samples in a row: which of the two spans a maximum is looked for
  // in; that in the middle always.
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
  [[nodiscard]] double evaluate_at(std::size_t scalar, double t);

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
};

}  // namespace limber::dynamics
