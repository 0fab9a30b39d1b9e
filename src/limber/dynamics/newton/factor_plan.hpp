// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"

namespace limber::dynamics {

/// Decides whether a step starts with the factors of an earlier one, by their
/// contraction of corrections so far, and estimates the error left after a
/// correction.
class FactorPlan {
 public:
  /// @param groups of MotionGroups
  explicit FactorPlan(std::size_t groups) : measured_(groups) {}

  /// Whether the next step keeps the current factors.
  [[nodiscard]] bool keeps() const { return fresh_steps_ == 0; }

  /// Error left after a correction.
  struct Rest {
    double rigid = 0.0;  ///< of frames [m]
    double modal = 0.0;  ///< of modes [m]
  };
  /// Error left in a group after correction i (from 0) of a step that keeps
  /// factors, by recent measurements; infinite without one, or if the
  /// correction is much larger than the measured ones.
  [[nodiscard]] Rest expect_rest(std::size_t i, std::size_t group,
                                 const CorrectionSize& correction) const;

  /// Course of Newton's method in a step.
  struct Course {
    explicit Course(std::size_t groups) {
      corrections.fill(std::vector<CorrectionSize>(groups));
    }
    /// The first ones, by groups.
    std::array<std::vector<CorrectionSize>, 4> corrections;
    std::size_t count = 0;     ///< number of these
    double slowest = 0.0;      ///< worst contraction of corrections [-]
    bool is_measured = false;  ///< whether a contraction was measured

    void add(const std::vector<CorrectionSize>& correction) {
      if (count < corrections.size()) corrections[count++] = correction;
    }
    /// @param contraction of a correction, if it was measured [-]
    void include(std::optional<double> contraction) {
      if (!contraction) return;
      slowest = std::max(slowest, *contraction);
      is_measured = true;
    }
    /// For the next step. Keeps memory.
    void clear() {
      count = 0;
      slowest = 0.0;
      is_measured = false;
    }
  };
  /// @param kept whether the step started with factors of an earlier one
  void finish_step(bool kept, const Course& course);

  /// Discards measurements.
  void refresh();
  /// Saves or restores the history, without the data that refresh() discards.
  void exchange_memory(Archive& archive);

 private:
  int fresh_steps_ = 0;       // number of further steps with new factors
  int next_fresh_steps_ = 0;  // the same after the next early failure
  int age_ = 0;               // number of steps with the current factors
  int unmeasured_ = 0;        // number of successive steps
  int trusted_steps_ = 0;     // number of steps for which measured_ is valid
  Course measured_;
};

}  // namespace limber::dynamics
