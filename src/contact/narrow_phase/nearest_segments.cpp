// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/nearest_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber::contact {
namespace {

double clamp_to(const Segment& segment, double s) {
  return std::clamp(s, -segment.half_length, segment.half_length);
}

double project(const Segment& segment, const Vector3& point) {
  return clamp_to(segment, segment.axis.dot(point - segment.centre));
}

// Keeps the nearest of all candidate pairs of points.
class NearestOfTwo {
 public:
  NearestOfTwo(const Segment& a, const Segment& b) : a_(a), b_(b) {}

  void try_pair(double s, double t) {
    const Vector3 arm = (a_.centre - b_.centre) + (s * a_.axis - t * b_.axis);
    const double square = arm.squaredNorm();
    if (!(square < least_)) return;
    least_ = square;
    best_ = {s, t};
  }
  void try_point_of_a(double s) {
    try_pair(s, project(b_, a_.centre + s * a_.axis));
  }
  void try_point_of_b(double t) {
    try_pair(project(a_, b_.centre + t * b_.axis), t);
  }

  [[nodiscard]] const NearestOfSegments& best() const { return best_; }

 private:
  const Segment& a_;
  const Segment& b_;
  double least_ = std::numeric_limits<double>::infinity();
  NearestOfSegments best_;
};

}  // namespace

NearestOfSegments find_nearest(const Segment& a, const Segment& b) {
  // Axes that differ by no more than round-off are parallel.
  constexpr double kParallel = 1e-24;  // square of the sine
  const Vector3 arm = a.centre - b.centre;
  const double cosine = a.axis.dot(b.axis);
  const double sine_square = a.axis.cross(b.axis).squaredNorm();
  const double along_a = -a.axis.dot(arm);  // of b's centre
  const double along_b = b.axis.dot(arm);   // of a's centre
  NearestOfTwo nearest(a, b);
  if (sine_square < kParallel) {
    const double low = std::max(-a.half_length, along_a - b.half_length);
    const double high = std::min(a.half_length, along_a + b.half_length);
    nearest.try_point_of_a(clamp_to(a, 0.5 * (low + high)));
    return nearest.best();
  }
  const double s = (cosine * along_b + along_a) / sine_square;
  const double t = (cosine * along_a + along_b) / sine_square;
  if (std::abs(s) < a.half_length && std::abs(t) < b.half_length) {
    nearest.try_point_of_a(s);
  }
  nearest.try_point_of_a(-a.half_length);
  nearest.try_point_of_a(a.half_length);
  nearest.try_point_of_b(-b.half_length);
  nearest.try_point_of_b(b.half_length);
  return nearest.best();
}

}  // namespace limber::contact
