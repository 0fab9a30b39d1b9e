// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/capsule_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/common/stack_array.hpp"
#include "limber/contact/potential/depth_field.hpp"
#include "limber/contact/potential/hertz_ellipse.hpp"
#include "limber/contact/potential/line_rule.hpp"

namespace limber::contact {
namespace {

// Integrals of t^4 and t^5.
constexpr int kPowers = 2;
using Powers = std::array<double, kPowers>;

/// An axis of a capsule.
struct Axis3 {
  Vector3 middle;
  Vector3 way;
  double half;
  double radius;

  Axis3(const Capsule& capsule, const Pose& X)
      : middle(X.p),
        way(X.R.col(2)),
        half(capsule.half_length),
        radius(capsule.radius) {}
  [[nodiscard]] Vector3 at(double s) const { return middle + s * way; }
};

/// Of an end that continues as an arc: int (t - x^2 / (2 R))^n dx over x > -R
/// psi within the lens, psi the sine of the way from it above the plane across
/// it.
struct Arc {
  double value = 0.0;
  double by_t = 0.0;
  double by_psi = 0.0;
};

// int (1 - x^2)^n dx from 0 to x
double integrate_lens(int n, double x) {
  const double s = x * x;
  if (n == 4) {
    return x * (1.0 + s * (-4.0 / 3.0 +
                           s * (6.0 / 5.0 + s * (-4.0 / 7.0 + s / 9.0))));
  }
  return x * (1.0 +
              s * (-5.0 / 3.0 +
                   s * (2.0 + s * (-10.0 / 7.0 + s * (5.0 / 9.0 - s / 11.0)))));
}

Arc find_arc(int n, double t, double psi, double radius) {
  const double width = std::sqrt(2.0 * radius * t);
  const double xi = std::clamp(psi * radius / width, -1.0, 1.0);
  const double fraction = integrate_lens(n, 1.0) + integrate_lens(n, xi);
  const double slope = std::pow(1.0 - xi * xi, n);
  const double power = std::pow(t, n);
  return {width * power * fraction,
          width * power / t * ((n + 0.5) * fraction - 0.5 * xi * slope),
          radius * power * slope};
}

/// Sums over pairs of places, of which p and q are the parts of r along both
/// axes.
class LensSums {
 public:
  LensSums(const Vector3& a, const Vector3& b, const Vector3& o)
      : a_(a), b_(b), o_(o) {}

  /// Of a function of L = |r|, p and q with these derivatives.
  struct Term {
    double value = 0.0;
    double by_L = 0.0;
    double by_p = 0.0;
    double by_q = 0.0;
  };

  void add(double weight, const Vector3& at_a, const Vector3& at_b,
           const std::array<Term, kPowers>& terms, double curvature_sum) {
    const Vector3 r = at_b - at_a;
    const Vector3 from_a = at_a - o_;
    const Vector3 from_b = at_b - o_;
    const Vector3 way = r.normalized();
    for (std::size_t k = 0; k < kPowers; ++k) {
      const Term& term = terms[k];
      const Vector3 on_b = term.by_L * way + term.by_p * a_;
      Vector6 g;
      g << on_b + term.by_q * b_,
          from_b.cross(on_b) + term.by_q * from_a.cross(b_);
      values[k] += weight * term.value;
      gradients[k] += weight * g;
      if (k > 0) continue;
      of_curvature += curvature_sum * weight * term.value;
      by_curvature += curvature_sum * weight * g;
    }
  }
  void add_pressure(double weight, const Vector3& place) {
    const Vector3 x = place - o_;
    load += weight;
    first += weight * x;
    second += (weight * x) * x.transpose();
  }

  Powers values{};  // M_4, M_5
  std::array<Vector6, kPowers> gradients{Vector6::Zero(), Vector6::Zero()};
  double of_curvature = 0.0;  // M_4 times 1 / R_1 + 1 / R_2
  Vector6 by_curvature = Vector6::Zero();
  double load = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

 private:
  Vector3 a_;
  Vector3 b_;
  Vector3 o_;
};

using Terms = std::array<LensSums::Term, kPowers>;

class Lens {
 public:
  Lens(const Axis3& A, const Axis3& B, LensSums& sums)
      : A_(A), B_(B), sums_(sums), reach_(A.radius + B.radius) {}

  void integrate() {
    add_sides(A_, B_, true);
    add_sides(B_, A_, false);
    for (const double end : {-1.0, 1.0}) {
      add_end(A_, end, B_, true);
      add_end(B_, end, A_, false);
      for (const double other : {-1.0, 1.0}) add_ends(end, other);
    }
  }

 private:
  struct Place {
    double L;
    double p;  // along A's axis
    double q;
    double t;
  };

  [[nodiscard]] Place find_place(const Vector3& a, const Vector3& b) const {
    const Vector3 r = b - a;
    const double L = r.norm();
    return {L, A_.way.dot(r), B_.way.dot(r), reach_ - L};
  }

  // The part of an axis within the reach of a point.
  [[nodiscard]] Span find_near(const Axis3& axis, const Vector3& x) const {
    const double foot = axis.way.dot(x - axis.middle);
    const double square = reach_ * reach_ - (axis.at(foot) - x).squaredNorm();
    if (!(square > 0.0)) return {};
    const double half = std::sqrt(square);
    return {std::max(foot - half, -axis.half),
            std::min(foot + half, axis.half)};
  }

  void add(double weight, const Vector3& a, const Vector3& b, const Place& at,
           const Terms& terms, double curvature_sum) {
    sums_.add(weight, a, b, terms, curvature_sum);
    const double depth = 0.5 * at.t;
    sums_.add_pressure(-weight * terms[0].by_L,
                       a + (A_.radius - depth) / at.L * (b - a));
  }

  // Half of the sides' part, with `outer` outside.
  void add_sides(const Axis3& outer, const Axis3& inner, bool is_A) {
    StackArray<double, 8> ends;
    ends.add() = -outer.half;
    ends.add() = outer.half;
    for (const double end : {-inner.half, inner.half}) {
      const Span near = find_near(outer, inner.at(end));
      if (near.is_empty()) continue;
      ends.add() = near.first;
      ends.add() = near.last;
    }
    // Where the whole other axis is within reach.
    const double across = outer.way.cross(inner.way).squaredNorm();
    if (across > 0.0) {
      const Vector3 gap = inner.middle - outer.middle;
      const Vector3 normal = outer.way.cross(inner.way) / std::sqrt(across);
      const double square = reach_ * reach_ - std::pow(gap.dot(normal), 2);
      if (square > 0.0) {
        const double foot =
            (gap - gap.dot(inner.way) * inner.way).dot(outer.way) / across;
        const double half = std::sqrt(square / across);
        for (const double s : {foot - half, foot + half}) {
          ends.add() = std::clamp(s, -outer.half, outer.half);
        }
      }
    }
    std::ranges::sort(ends.all());
    const auto all = ends.all();
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      add_part({all[i], all[i + 1]}, outer, inner, is_A);
    }
  }

  void add_part(const Span& part, const Axis3& outer, const Axis3& inner,
                bool is_A) {
    if (part.is_empty() ||
        find_near(inner, outer.at(part.middle())).is_empty()) {
      return;
    }
    const auto& along = line_rule<12>();
    const auto& across = line_rule<8>();
    for (std::size_t i = 0; i < along.places.size(); ++i) {
      const Vector3 x = outer.at(part.first + along.places[i] * part.length());
      const Span near = find_near(inner, x);
      if (near.is_empty()) continue;
      const double weight = 0.5 * along.weights[i] * part.length();
      for (std::size_t j = 0; j < across.places.size(); ++j) {
        const Vector3 y =
            inner.at(near.first + across.places[j] * near.length());
        is_A ? add_side(weight * across.weights[j] * near.length(), x, y)
             : add_side(weight * across.weights[j] * near.length(), y, x);
      }
    }
  }

  void add_side(double weight, const Vector3& a, const Vector3& b) {
    const Place at = find_place(a, b);
    if (!(at.t > 0.0)) return;
    const double alpha = at.p / at.L;
    const double beta = at.q / at.L;
    const double X = 1.0 - alpha * alpha;
    const double Y = 1.0 - beta * beta;
    Terms terms;
    double power = at.t * at.t * at.t;
    for (int k = 0; k < kPowers; ++k) {
      const double slope = (4 + k) * power;
      power *= at.t;
      terms[static_cast<std::size_t>(k)] = {
          power * X * Y,
          -slope * X * Y +
              2.0 * power / at.L * (alpha * alpha * Y + beta * beta * X),
          -2.0 * power * alpha * Y / at.L, -2.0 * power * beta * X / at.L};
    }
    add(weight, a, b, at, terms, 1.0 / A_.radius + 1.0 / B_.radius);
  }

  // The arc of an end against the other's side.
  void add_end(const Axis3& own, double end, const Axis3& other, bool is_A) {
    const Vector3 x = own.at(end * own.half);
    const Span near = find_near(other, x);
    if (near.is_empty()) return;
    const auto& rule = line_rule<12>();
    for (std::size_t i = 0; i < rule.places.size(); ++i) {
      const double weight = rule.weights[i] * near.length();
      const Vector3 y = other.at(near.first + rule.places[i] * near.length());
      const Vector3& a = is_A ? x : y;
      const Vector3& b = is_A ? y : x;
      const Place at = find_place(a, b);
      if (!(at.t > 0.0)) continue;
      // psi = sign along / L, away from the end towards the other
      const double sign = is_A ? end : -end;
      const double along = is_A ? at.p : at.q;
      const double level = (is_A ? at.q : at.p) / at.L;
      const double psi = sign * along / at.L;
      const double Y = 1.0 - level * level;
      Terms terms;
      for (int k = 0; k < kPowers; ++k) {
        const Arc arc = find_arc(4 + k, at.t, psi, own.radius);
        LensSums::Term& term = terms[static_cast<std::size_t>(k)];
        term.value = arc.value * Y;
        term.by_L = -arc.by_t * Y - arc.by_psi * psi / at.L * Y +
                    2.0 * arc.value * level * level / at.L;
        const double by_along = arc.by_psi * sign / at.L * Y;
        const double by_level = -2.0 * arc.value * level / at.L;
        term.by_p = is_A ? by_along : by_level;
        term.by_q = is_A ? by_level : by_along;
      }
      add(weight, a, b, at, terms, 2.0 / own.radius + 1.0 / other.radius);
    }
  }

  // The arcs of two ends, by the product of their fractions.
  void add_ends(double end_A, double end_B) {
    const Vector3 a = A_.at(end_A * A_.half);
    const Vector3 b = B_.at(end_B * B_.half);
    const Place at = find_place(a, b);
    if (!(at.t > 0.0)) return;
    const double psi = end_A * at.p / at.L;
    const double chi = -end_B * at.q / at.L;
    Terms terms;
    for (int k = 0; k < kPowers; ++k) {
      const int n = 4 + k;
      const Arc of_A = find_arc(n, at.t, psi, A_.radius);
      const Arc of_B = find_arc(n, at.t, chi, B_.radius);
      const double full = 2.0 * integrate_lens(n, 1.0);
      // 2 pi sqrt(R_A R_B) t^(n+1) / (n + 1), over that of both full arcs
      const double by_t =
          std::numbers::pi / (n + 1) / (full * full) / std::pow(at.t, n);
      LensSums::Term& term = terms[static_cast<std::size_t>(k)];
      const double both = of_A.value * of_B.value;
      term.value = by_t * both;
      const double by_psi = by_t * of_A.by_psi * of_B.value;
      const double by_chi = by_t * of_A.value * of_B.by_psi;
      term.by_L = -by_t * (of_A.by_t * of_B.value + of_A.value * of_B.by_t -
                           n * both / at.t) -
                  (by_psi * psi + by_chi * chi) / at.L;
      term.by_p = by_psi * end_A / at.L;
      term.by_q = -by_chi * end_B / at.L;
    }
    add(1.0, a, b, at, terms, 2.0 / A_.radius + 2.0 / B_.radius);
  }

  const Axis3& A_;
  const Axis3& B_;
  LensSums& sums_;
  double reach_;
};

Vector6 move_to(const Vector6& gradient, const Vector3& by) {
  Vector6 moved = gradient;
  moved.tail<3>() -= by.cross(Vector3(gradient.head<3>()));
  return moved;
}

}  // namespace

std::optional<CapsuleTouch> CapsulePair::find_gradient(const Pose& X_A,
                                                       const Pose& X_B) const {
  const Axis3 A(A_, X_A);
  const Axis3 B(B_, X_B);
  const DepthField reach{Capsule{A.radius + B.radius, B.half}};
  const Pose X_BA = X_B.inverse() * X_A;
  const StraightLine line{X_BA.p, X_BA.R.col(2), {-A.half, A.half}};
  const double deepest = reach.find_deepest(line);
  CapsuleTouch out;
  out.depth = reach.find_t(line.at(deepest));
  if (!(out.depth > 0.0)) return {};
  const Vector3 o = A.at(deepest);
  LensSums sums(A.way, B.way, o);
  Lens(A, B, sums).integrate();
  const double M = sums.values[0];
  if (!(M > 0.0)) return {};
  const double radii = A.radius + B.radius;
  const double scale = std::sqrt(A.radius * B.radius) / radii;
  const double depth = 1.2 * sums.values[1] / M;
  const double x =
      1.25 / std::numbers::pi * scale * sums.of_curvature / std::pow(depth, 5);
  const EllipseFactor h = find_ellipse_factor(x);
  out.energy =
      8.0 / 15.0 * std::sqrt(2.5 / std::numbers::pi * scale * M) * h.value;
  const Vector6 log_M = sums.gradients[0] / M;
  const Vector6 log_x = sums.by_curvature / sums.of_curvature -
                        5.0 * (sums.gradients[1] / sums.values[1] - log_M);
  const Vector6 gradient =
      out.energy * (0.5 * log_M + h.slope * x / h.value * log_x);
  const Vector3 centre = sums.first / sums.load;
  out.centre = o + centre;
  out.gradient = move_to(gradient, centre);
  // With that of one pair of places.
  const Vector3 n = out.gradient.head<3>().normalized();
  const double own = 0.2 * depth * A.radius * B.radius / radii;
  out.spread = sums.second / sums.load - centre * centre.transpose() +
               own * (Matrix3::Identity() - n * n.transpose());
  return out;
}

std::optional<CapsuleTouch> CapsulePair::find_touch(
    const Pose& X_A, const Pose& X_B, bool has_derivatives) const {
  constexpr double kStep = 1e-6;  // of the depth, and of the turn that moves so
  auto touch = find_gradient(X_A, X_B);
  if (!touch || !has_derivatives) return touch;
  const double extent = std::sqrt(touch->spread.trace());
  Matrix6 hessian;
  for (int i = 0; i < 6; ++i) {
    const double h = kStep * touch->depth / (i < 3 ? 1.0 : extent);
    const Vector6 by = h * Vector6::Unit(i);
    const Matrix3 turned = exp_rotation(by.tail<3>());
    const Pose X{turned * X_B.R, touch->centre + by.head<3>() +
                                     turned * (X_B.p - touch->centre)};
    const auto at = find_gradient(X_A, X);
    if (!at) return touch;
    hessian.col(i) =
        (move_to(at->gradient, touch->centre - at->centre) - touch->gradient) /
        h;
  }
  touch->hessian = 0.5 * (hessian + hessian.transpose());
  return touch;
}

}  // namespace limber::contact
