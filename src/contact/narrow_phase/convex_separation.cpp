// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/convex_separation.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/contact/narrow_phase/nearest_cores.hpp"

namespace limber::contact {
namespace {

constexpr double kPi = std::numbers::pi;
// Distance relative to the sizes below which the nearest points on a rim, found
// by iteration, do not define the direction between them [-].
constexpr double kClose = 1e-3;

// Two unit vectors normal to a unit vector and to each other.
std::array<Vector3, 2> find_basis(const Vector3& u) {
  const Vector3 e = u.unitOrthogonal();
  return {e, u.cross(e)};
}

// Keeps the direction of least depth of all candidates.
class LeastDepth {
 public:
  LeastDepth(const ConvexCore& A, const ConvexCore& B)
      : A_(A),
        B_(B),
        arm_(A.centre() - B.centre()),
        none_(1e-9 * (A.size() + B.size())) {}

  [[nodiscard]] double evaluate(const Vector3& n) const {
    return n.dot(arm_) + A_.find_support(n) + B_.find_support(n);
  }
  /// Gradient of evaluate, which is constant along n [m].
  [[nodiscard]] Vector3 find_gradient(const Vector3& n) const {
    return A_.find_support_point(n) - B_.centre() +
           (B_.find_support_point(n) - B_.centre());
  }
  void try_unit(const Vector3& n) {
    const double depth = evaluate(n);
    if (!(depth < depth_ - none_)) return;
    depth_ = depth;
    best_ = n;
  }
  /// Tries n and -n, of any length.
  void try_both(const Vector3& n) {
    const double length = n.norm();
    if (!(length > 1e-9)) return;
    try_unit(n / length);
    try_unit(-n / length);
  }
  /// Tries all minima on the circle normal to u.
  void try_circle(const Vector3& u) {
    constexpr int kSamples = 32;
    const std::array<Vector3, 2> basis = find_basis(u);
    const auto find_direction = [&basis](double angle) -> Vector3 {
      return std::cos(angle) * basis[0] + std::sin(angle) * basis[1];
    };
    std::array<double, kSamples> depths{};
    for (int i = 0; i < kSamples; ++i) {
      depths[static_cast<std::size_t>(i)] =
          evaluate(find_direction(2.0 * kPi * i / kSamples));
    }
    for (int i = 0; i < kSamples; ++i) {
      const auto at = [&](int k) {
        return depths[static_cast<std::size_t>((k + kSamples) % kSamples)];
      };
      if (at(i) > at(i - 1) || at(i) > at(i + 1)) continue;
      // Bisects the sign of the derivative, exact to round-off; values would
      // give only half of the digits.
      double low = 2.0 * kPi * (i - 1) / kSamples;
      double high = 2.0 * kPi * (i + 1) / kSamples;
      constexpr int kCuts = 52;
      for (int cut = 0; cut < kCuts; ++cut) {
        const double middle = 0.5 * (low + high);
        const Vector3 n = find_direction(middle);
        (find_gradient(n).dot(u.cross(n)) > 0.0 ? high : low) = middle;
      }
      try_unit(find_direction(0.5 * (low + high)));
    }
  }
  /// Tries a minimum among all directions, by compass search_depth from the
  /// best of many, then by Newton's method.
  void try_sphere() {
    constexpr int kSamples = 200;
    constexpr double kTurn = 2.399963229728653;  // golden angle
    Vector3 n = best_;
    double depth = depth_;
    // An axis of the bodies, so that the result rotates with them.
    const Vector3& axis = A_.segments()[0].axis;
    const Vector3 across = axis.cross(B_.segments()[0].axis);
    const Vector3 e1 = across.squaredNorm() > 1e-12 ? across.normalized()
                                                    : axis.unitOrthogonal();
    const Vector3 e2 = axis.cross(e1);
    for (int i = 0; i < kSamples; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kSamples;
      const double side = std::sqrt(1.0 - z * z);
      const Vector3 sample = side * std::cos(kTurn * i) * e1 +
                             side * std::sin(kTurn * i) * e2 + z * axis;
      const double found = evaluate(sample);
      if (found < depth) {
        depth = found;
        n = sample;
      }
    }
    for (double step = 0.1; step > 1e-4;) {
      const auto ways = find_basis(n);
      Vector3 next = n;
      for (const Vector3& way :
           {ways[0], Vector3(-ways[0]), ways[1], Vector3(-ways[1])}) {
        const Vector3 tried = (n + step * way).normalized();
        const double found = evaluate(tried);
        if (!(found < depth)) continue;
        depth = found;
        next = tried;
      }
      if (next == n) step *= 0.5;
      n = next;
    }
    try_unit(polish(n));
  }

  /// The stationary direction near to `start`.
  [[nodiscard]] Vector3 polish(const Vector3& start) const {
    constexpr int kMost = 12;
    Vector3 n = start;
    double slope = find_slope(n).norm();
    for (int i = 0; i < kMost; ++i) {
      const auto ways = find_basis(n);
      Eigen::Matrix<double, 3, 2> P;
      P << ways[0], ways[1];
      const Eigen::Matrix2d curvature =
          P.transpose() * (A_.find_curvature(n) + B_.find_curvature(n)) * P -
          evaluate(n) * Eigen::Matrix2d::Identity();
      const Eigen::Vector2d turn =
          curvature.inverse() * (P.transpose() * find_gradient(n));
      if (!turn.allFinite()) return n;
      const Vector3 next = (n - P * turn).normalized();
      const double next_slope = find_slope(next).norm();
      if (!(next_slope < slope)) return n;
      n = next;
      slope = next_slope;
    }
    return n;
  }

  [[nodiscard]] const Vector3& best() const { return best_; }
  [[nodiscard]] double depth() const { return depth_; }

 private:
  // Gradient of evaluate normal to n.
  [[nodiscard]] Vector3 find_slope(const Vector3& n) const {
    const Vector3 gradient = find_gradient(n);
    return gradient - n.dot(gradient) * n;
  }

  const ConvexCore& A_;
  const ConvexCore& B_;
  Vector3 arm_;
  double none_;
  double depth_ = std::numeric_limits<double>::infinity();
  Vector3 best_ = Vector3::UnitZ();
};

// Tries faces of a box and of a disc; two segments of a box span one face.
void try_faces(const ConvexCore& shape, LeastDepth& least) {
  if (shape.segments().size() == 1 && !(shape.disc() > 0.0)) return;
  for (const ConvexCore::Segment& segment : shape.segments()) {
    least.try_both(segment.axis);
  }
}

LeastDepth search_depth(const ConvexCore& A, const ConvexCore& B) {
  LeastDepth least(A, B);
  try_faces(A, least);
  try_faces(B, least);
  for (const ConvexCore::Segment& a : A.segments()) {
    for (const ConvexCore::Segment& b : B.segments()) {
      least.try_both(a.axis.cross(b.axis));
    }
  }
  if (A.disc() > 0.0 || B.disc() > 0.0) {
    for (const ConvexCore* shape : {&A, &B}) {
      for (const ConvexCore::Segment& segment : shape->segments()) {
        least.try_circle(segment.axis);
      }
    }
  }
  if (A.disc() > 0.0 && B.disc() > 0.0) least.try_sphere();
  return least;
}

}  // namespace

Separation find_separation(const ConvexCore& A, const ConvexCore& B) {
  const double balls = A.ball() + B.ball();
  const NearestOfCores nearest = find_nearest(A, B);
  if (!nearest.overlap) {
    const Vector3 arm = nearest.on_B - nearest.on_A;
    const double distance = arm.norm();
    Separation apart{.normal_W = arm / distance,
                     .depth = balls - distance,
                     .on_A = nearest.on_A,
                     .on_B = nearest.on_B,
                     .is_apart = true};
    const bool has_rim = A.disc() > 0.0 || B.disc() > 0.0;
    if (has_rim && distance < kClose * (A.size() + B.size())) {
      const LeastDepth least = search_depth(A, B);
      if (least.depth() < least.evaluate(apart.normal_W)) {
        apart.normal_W = least.best();
      }
    }
    return apart;
  }
  const LeastDepth least = search_depth(A, B);
  return {.normal_W = least.best(), .depth = least.depth() + balls};
}

}  // namespace limber::contact
