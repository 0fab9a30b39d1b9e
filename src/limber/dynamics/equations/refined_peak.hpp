// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/common/records/archive.hpp"

namespace limber::dynamics {

/// A largest value and its time.
struct Peak {
  double value = 0.0;  ///< [unit of the scalar]
  double time = 0.0;   ///< [s]
  void include(double v, double t) {
    if (v > value) *this = {v, t};
  }
};

void exchange(Archive& archive, Peak& peak);

/// Maximum of the parabola through three values at increasing times. @returns
/// the second value if two times agree, or the maximum is outside
[[nodiscard]] Peak find_top(const Peak& a, const Peak& b, const Peak& c);

/// Peak of a magnitude sampled at the ends of steps, or closer: of the parabola
/// through the largest value and its neighbours.
///
/// Limits     misses motion that the steps do not resolve. The refinement adds
/// at
///            most a quarter of the range of the three values, if their times
///            are equidistant.
class RefinedPeak {
 public:
  /// @param value [unit of the scalar]
  /// @param t time, increasing [s]
  void include(double value, double t);
  [[nodiscard]] const Peak& peak() const { return peak_; }

  void exchange_memory(Archive& archive);

 private:
  std::array<Peak, 2> last_;  // the older one first
  int count_ = 0;             // of values, at most 2
  Peak peak_;
};

inline void exchange(Archive& archive, RefinedPeak& peak) {
  peak.exchange_memory(archive);
}

}  // namespace limber::dynamics
