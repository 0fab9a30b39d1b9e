// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::contact {

/// From 0 at x = -1 to 1 at x = 1, with two derivatives.
struct Blend {
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};

inline Blend blend(double x) {
  if (x <= -1.0) return {};
  if (x >= 1.0) return {1.0, 0.0, 0.0};
  const double y = 1.0 - x * x;
  return {0.5 + x * (15.0 - x * x * (10.0 - 3.0 * x * x)) / 16.0,
          15.0 / 16.0 * y * y, -15.0 / 4.0 * x * y};
}

}  // namespace limber::contact
