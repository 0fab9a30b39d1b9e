// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/newton/newton_measures.hpp"

/// Convergence criteria of Newton's method in a time step.
namespace limber::dynamics {

/// Smallest error required, relative to a step's motion [-].
inline constexpr double kLeastFraction = 1e-12;

/// Fraction to take of a correction that reverses the one before [-].
inline constexpr double kReversedFraction = 0.5;

/// Largest error allowed for both kinds of motion [m]: a hundredth of the
/// step's own error, between 1e-12 and 1e-9 of its motion.
///
/// Equation   the correction of a prediction by linearly extrapolated
///            accelerations is c = beta h^2 e, e = h^2 a'' their error. Of the
///            second-order
///            A-stable schemes the trapezoidal rule has the smallest error in
///            velocity, h^3 a'' / 12 = h e / 12, and a correction x changes
///            the velocity by gamma x / (beta h): x = c / (12 gamma) changes
///            it by as much.
/// Source     errors from predictor and corrector: [@milne1926]; the
///            trapezoidal rule's error: [@dahlquist1963]
/// @param predictor_errors lengths of the first correction after such a
/// prediction [m]; zero for any other
/// @param gamma of Newmark's formula for the velocity [-]
/// @param motion length of the step's motion [m]
[[nodiscard]] CorrectionSize find_limit(const CorrectionSize& predictor_errors,
                                        double gamma, double motion);

/// Whether, for both kinds of motion, the error left after a correction is
/// within the limit, if corrections contract further as from the one before to
/// this one, or the correction is round-off.
[[nodiscard]] bool has_converged(const CorrectionSize& correction,
                                 const CorrectionSize& before,
                                 const CorrectionSize& limit,
                                 const Roundoff& roundoff);

/// One group of bodies in a step.
struct GroupProgress {
  CorrectionSize before;  ///< the correction before the last one
  CorrectionSize now;     ///< the last correction
  Reversal reversal;      ///< from one to the other, if they were compared
  CorrectionSize limit;   ///< largest error allowed
  Roundoff roundoff;
  double motion = 0.0;              ///< the step's [m]
  double contraction_before = 1.0;  ///< at the correction before the last [-]
  bool was_done = false;            ///< before the last correction
  bool is_done = false;

  /// Of the last correction by the one before; 1 if there was none [-].
  [[nodiscard]] double contraction() const {
    return before.value > 0.0 ? now.value / before.value : 1.0;
  }
  /// Error left at the same rate of contraction [m].
  [[nodiscard]] double rest() const;
  [[nodiscard]] bool is_roundoff() const {
    return now.rigid <= roundoff.rigid && now.modal <= roundoff.modal;
  }
  /// Whether corrections alternate between two faces of a shape or mesh: where
  /// an edge between them is pressed inwards, the solution for one face makes
  /// the other one nearest. Then the last correction took the one before back,
  /// and is at most 1e-3 of the step's motion.
  [[nodiscard]] bool alternates() const;
};

/// Newton's method in a step, by groups of bodies: it ends when it has
/// converged in all of them.
class NewtonProgress {
 public:
  explicit NewtonProgress(const SystemModel& model);

  /// Begins a step, at its predicted end.
  void start(const SystemState& end, const VectorX& motion);
  /// Measures a correction.
  /// @param compares with the one before, if that was to be compared, too;
  /// else reversals are zero
  void include(const VectorX& increments, bool compares);
  /// Measures the step's motion. @param as MotionGroups::measure_motion
  void measure_motion(const SystemState& state, const SystemTerms& terms,
                      const VectorX& motion);
  /// Adds what round-off elsewhere does, given as increments.
  void add_roundoff(const VectorX& increments);

  /// Sets which groups are done: that have converged, or alternate.
  void judge();
  /// Whether a group is not done although its correction is round-off of
  /// coordinates, or contracts worse than `poor` [-].
  [[nodiscard]] bool may_be_noise(double poor) const;
  /// Whether the last correction takes back much of the one before in a group:
  /// between the two slopes of a law with a kink Newton's method can alternate
  /// for ever.
  [[nodiscard]] bool reverses_last() const;
  /// The slowest contraction of groups that were not done before; none if all
  /// were. That of round-off, above `poor`, is meaningless [-].
  [[nodiscard]] std::optional<double> find_contraction(double poor) const;

  [[nodiscard]] std::vector<GroupProgress>& groups() { return progress_; }
  [[nodiscard]] const std::vector<GroupProgress>& groups() const {
    return progress_;
  }
  /// The last correction, by groups.
  [[nodiscard]] const std::vector<CorrectionSize>& sizes() const {
    return sizes_;
  }
  [[nodiscard]] bool is_finite() const;
  [[nodiscard]] bool is_done() const;
  /// The group that is not done with the longest correction; NaN is longest.
  [[nodiscard]] const GroupProgress& find_worst() const;

 private:
  const SystemModel& model_;
  MotionGroups groups_;
  std::vector<GroupProgress> progress_;
  bool is_compared_ = false;  // the last correction, which is last_
  VectorX last_;
  std::vector<CorrectionSize> sizes_;
  std::vector<Reversal> reversals_;
  std::vector<Roundoff> roundoffs_;
  std::vector<double> motions_;
};

}  // namespace limber::dynamics
