// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "limber/common/records/archive.hpp"

namespace limber::dynamics {

/// The error allowed in each step of a run.
class ErrorBudget {
 public:
  /// The same for every step [m].
  static ErrorBudget each(double error) { return ErrorBudget(error, 0.0); }
  /// Errors of all steps that add up to about `total` [m], although their
  /// number is not known.
  ///
  /// Equation   after n steps, which reach the fraction s of the run, a step
  /// may
  ///            err by total max(s / n, 0.03 / (n + 1)): equal steps to the end
  ///            would be n / s in all, each with its fraction of the total. The
  ///            second term serves a run that begins with short steps.
  /// Limits     The sum is about `total` if the length of steps is even, and
  ///            at most ln(n) times that: steps that get shorter than all
  ///            before are more than was expected.
  /// @param span duration of the run, > 0 [s]
  static ErrorBudget in_all(double total, double span) {
    return ErrorBudget(total, span);
  }

  /// Of the next step [m].
  [[nodiscard]] double allowed() const {
    if (span_ == 0.0) return error_;
    const auto n = static_cast<double>(steps_);
    const double even = steps_ > 0 ? done_ / (span_ * n) : 0.0;
    return error_ * std::max(even, 0.03 / (n + 1.0));
  }
  /// Counts a step of length h [s].
  void count(double h) {
    done_ += h;
    ++steps_;
  }
  /// Saves or restores the history.
  void exchange_memory(Archive& archive) { archive(done_, steps_); }

 private:
  ErrorBudget(double error, double span) : error_(error), span_(span) {}

  double error_;       // of a step, or of all [m]
  double span_;        // [s]; 0: errors are equal
  double done_ = 0.0;  // [s]
  long steps_ = 0;
};

}  // namespace limber::dynamics
