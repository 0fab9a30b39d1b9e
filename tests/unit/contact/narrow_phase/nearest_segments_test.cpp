// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/nearest_segments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/common/rotation.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::nearest_segments_test {
namespace {

double find_distance(const Segment& a, const Segment& b, double s, double t) {
  return (a.centre + s * a.axis - b.centre - t * b.axis).norm();
}

double find_least_distance(const Segment& a, const Segment& b) {
  const NearestOfSegments at = find_nearest(a, b);
  EXPECT_LE(std::abs(at.s), a.half_length);
  EXPECT_LE(std::abs(at.t), b.half_length);
  return find_distance(a, b, at.s, at.t);
}

// By a grid over both, made finer about its best point: the square of the
// distance is convex.
double search_distance(const Segment& a, const Segment& b) {
  double s = 0.0;
  double t = 0.0;
  double reach = 1.0;
  for (int level = 0; level < 60; ++level) {
    double best = find_distance(a, b, s, t);
    const double s0 = s;
    const double t0 = t;
    for (int i = -4; i <= 4; ++i) {
      for (int j = -4; j <= 4; ++j) {
        const double s1 = std::clamp(s0 + 0.25 * i * reach * a.half_length,
                                     -a.half_length, a.half_length);
        const double t1 = std::clamp(t0 + 0.25 * j * reach * b.half_length,
                                     -b.half_length, b.half_length);
        const double distance = find_distance(a, b, s1, t1);
        if (!(distance < best)) continue;
        best = distance;
        s = s1;
        t = t1;
      }
    }
    reach *= 0.7;
  }
  return find_distance(a, b, s, t);
}

TEST(NearestSegments, AreNearestOfAllPairsOfPoints) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Segment a{test::draw_point(random, 1.0),
                    test::draw_rotation(random).col(2), 0.8};
    const Segment b{test::draw_point(random, 1.0),
                    test::draw_rotation(random).col(2), 0.5};
    EXPECT_NEAR(find_least_distance(a, b), search_distance(a, b), 1e-7);
  }
}

TEST(NearestSegments, ThatAreParallelMeetInTheMiddleOfWhereTheyLieTogether) {
  const Segment a{{0, 0, 0}, {0, 0, 1}, 1.0};
  const Segment b{{0.3, 0, 1.2}, {0, 0, -1}, 0.6};  // 0.6 to 1.8
  const NearestOfSegments at = find_nearest(a, b);
  EXPECT_NEAR(at.s, 0.8, 1e-15);
  EXPECT_NEAR(at.t, 0.4, 1e-15);
  const Segment beyond{{0.3, 0, 2.0}, {0, 0, 1}, 0.6};
  EXPECT_NEAR(find_nearest(a, beyond).s, 1.0, 1e-15);
  EXPECT_NEAR(find_nearest(a, beyond).t, -0.6, 1e-15);
}

// The distance changes by no more than the ends move; axes as close as 1e-12 to
// parallel count as parallel.
TEST(NearestSegments, DistanceHasNoJumpAsTheyTiltThroughParallel) {
  const Segment a{{0, 0, 0}, {0, 0, 1}, 1.0};
  const auto tilt = [](double angle) {
    return Segment{{0.3, 0.0, 0.4},
                   exp_rotation(angle * Vector3(0.2, 1.0, 0.0)).col(2),
                   1.0};
  };
  for (double scale = 1e-16; scale < 0.1; scale *= 3.0) {
    const double step = scale / 8.0;
    for (int i = -8; i < 8; ++i) {
      const double before = find_least_distance(a, tilt(i * step));
      const double after = find_least_distance(a, tilt((i + 1) * step));
      EXPECT_LE(std::abs(after - before), 1.1 * step + 1e-12) << scale;
    }
  }
}

}  // namespace
}  // namespace limber::contact::nearest_segments_test
