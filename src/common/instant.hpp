// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// Which side of a jump is meant when a time is exactly on it.
enum class Side { left, right };

/// A time, and the side of it from which what jumps there is seen.
struct Instant {
  double t = 0.0;  ///< [s]
  Side side = Side::right;
};

}  // namespace limber
