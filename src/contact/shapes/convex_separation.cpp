// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/convex_separation.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/contact/shapes/nearest_cores.hpp"

namespace limber::contact {
namespace {

constexpr double kPi = std::numbers::pi;

// Two unit vectors normal to a unit vector and to each other.
std::array<Vector3, 2> find_basis(const Vector3& u) {
  const Vector3 e = u.unitOrthogonal();
  return {e, u.cross(e)};
}

// Keeps the direction of least depth of all that it is shown.
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
  void try_unit(const Vector3& n) {
    const double depth = evaluate(n);
    if (!(depth < depth_ - none_)) return;
    depth_ = depth;
    best_ = n;
  }
  /// Both ways, of any length.
  void try_both(const Vector3& n) {
    const double length = n.norm();
    if (!(length > 1e-9)) return;
    try_unit(n / length);
    try_unit(-n / length);
  }
  /// All minima on the circle normal to u.
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
      double low = 2.0 * kPi * (i - 1) / kSamples;
      double high = 2.0 * kPi * (i + 1) / kSamples;
      constexpr double kGolden = 0.3819660112501051;
      constexpr int kCuts = 42;
      double a = low + kGolden * (high - low);
      double b = high - kGolden * (high - low);
      double depth_a = evaluate(find_direction(a));
      double depth_b = evaluate(find_direction(b));
      for (int cut = 0; cut < kCuts; ++cut) {
        if (depth_a < depth_b) {
          high = b;
          b = a;
          depth_b = depth_a;
          a = low + kGolden * (high - low);
          depth_a = evaluate(find_direction(a));
        } else {
          low = a;
          a = b;
          depth_a = depth_b;
          b = high - kGolden * (high - low);
          depth_b = evaluate(find_direction(b));
        }
      }
      try_unit(find_direction(0.5 * (low + high)));
    }
  }
  /// A minimum among all directions, by compass search from the best of many.
  void try_sphere() {
    constexpr int kSamples = 200;
    constexpr double kTurn = 2.399963229728653;  // golden angle
    Vector3 n = best_;
    double depth = depth_;
    // Of the bodies, so that the answer turns with them.
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
    for (double step = 0.1; step > 1e-9;) {
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
    try_unit(n);
  }

  [[nodiscard]] const Vector3& best() const { return best_; }
  [[nodiscard]] double depth() const { return depth_; }

 private:
  const ConvexCore& A_;
  const ConvexCore& B_;
  Vector3 arm_;
  double none_;
  double depth_ = std::numeric_limits<double>::infinity();
  Vector3 best_ = Vector3::UnitZ();
};

// Faces of a box and of a disc; two segments of one box span one of its faces.
void try_faces(const ConvexCore& shape, LeastDepth& least) {
  if (shape.segments().size() == 1 && !(shape.disc() > 0.0)) return;
  for (const ConvexCore::Segment& segment : shape.segments()) {
    least.try_both(segment.axis);
  }
}

LeastDepth search(const ConvexCore& A, const ConvexCore& B) {
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
    return {.normal_W = arm / distance,
            .depth = balls - distance,
            .on_A = nearest.on_A,
            .on_B = nearest.on_B,
            .is_apart = true};
  }
  const LeastDepth least = search(A, B);
  return {.normal_W = least.best(), .depth = least.depth() + balls};
}

}  // namespace limber::contact
