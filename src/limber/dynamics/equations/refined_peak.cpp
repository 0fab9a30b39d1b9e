// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/refined_peak.hpp"

#include <algorithm>

namespace limber::dynamics {

void exchange(Archive& archive, Peak& peak) { archive(peak.value, peak.time); }

Peak find_top(const Peak& a, const Peak& b, const Peak& c) {
  const double left = b.time - a.time;
  const double right = c.time - b.time;
  if (!(left > 0.0) || !(right > 0.0)) return b;
  const double rise = (b.value - a.value) / left;
  const double fall = (c.value - b.value) / right;
  const double slope = (rise * right + fall * left) / (left + right);
  const double bend = (fall - rise) / (left + right);
  if (!(bend < 0.0)) return b;
  const double move = -0.5 * slope / bend;
  if (move < -left || move > right) return b;
  return {b.value + 0.5 * slope * move, b.time + move};
}

void RefinedPeak::include(double value, double t) {
  const Peak now{value, t};
  peak_.include(value, t);
  const auto& [a, b] = last_;
  if (count_ == 2 && b.value >= peak_.value && b.value >= a.value &&
      b.value >= value) {
    const Peak top = find_top(a, b, now);
    peak_.include(top.value, top.time);
  }
  last_ = {last_[1], now};
  count_ = std::min(count_ + 1, 2);
}

void RefinedPeak::exchange_memory(Archive& archive) {
  archive(last_, count_, peak_);
}

}  // namespace limber::dynamics
