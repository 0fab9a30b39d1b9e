// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "common/archive.hpp"

namespace limber::dynamics {

/// A largest value and when it was.
struct Peak {
  double value = 0.0;
  double time = 0.0;  ///< [s]
  void include(double v, double t) {
    if (v > value) *this = {v, t};
  }
};

void exchange(Archive& archive, Peak& peak);

/// Top of the parabola through three values at increasing times. @returns the
/// second where two times agree, or the top is not among them
[[nodiscard]] Peak find_top(const Peak& a, const Peak& b, const Peak& c);

/// Peak of a magnitude that is seen at the ends of steps, or closer: of the
/// parabola through a largest value and those beside it.
///
/// Limits     misses what the steps do not resolve. No more is added than a
///            quarter of what the three values span, where their times are
///            even.
class RefinedPeak {
 public:
  void include(double value, double t);
  [[nodiscard]] const Peak& peak() const { return peak_; }

  void exchange_memory(Archive& archive);

 private:
  std::array<Peak, 2> last_;  // the older one first
  int count_ = 0;             // of values, at most 2
  Peak peak_;
};

}  // namespace limber::dynamics
