// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"

namespace limber::dynamics {

/// Decides whether a step starts with the factors of an earlier one, by their
/// contraction of corrections so far, and estimates the error left after a
/// correction.
class FactorPlan {
 public:
  /// Whether the next step keeps the current factors.
  [[nodiscard]] bool keeps() const { return fresh_steps_ == 0; }

  /// Error left after a correction.
  struct Rest {
    double rigid = 0.0;  ///< of frames [m]
    double modal = 0.0;  ///< of modes [m]
  };
  /// Error left after correction i (from 0) of a step that keeps factors, by
  /// recent measurements; infinite without one, or if the correction is much
  /// larger than the measured ones.
  [[nodiscard]] Rest expect_rest(std::size_t i,
                                 const CorrectionSize& correction) const;

  /// Course of Newton's method in a step.
  struct Course {
    std::array<CorrectionSize, 4> corrections{};  ///< the first ones
    std::size_t count = 0;                        ///< number of these
    double slowest = 0.0;      ///< worst contraction of corrections [-]
    bool is_measured = false;  ///< whether a contraction was measured

    void add(const CorrectionSize& correction) {
      if (count < corrections.size()) corrections[count++] = correction;
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
