// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/smooth_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/jet.hpp"
#include "limber/contact/law/blend.hpp"
#include "limber/contact/potential/hertz_ellipse.hpp"
#include "limber/contact/shapes/ellipsoid_field.hpp"

namespace limber::contact {
namespace {

Matrix3 find_squares(const Vector3& radii, const Matrix3& R) {
  return R * radii.cwiseAbs2().asDiagonal() * R.transpose();
}

// The normal of contact of two ellipsoids that are scaled equally
// [@perram1985]: of the largest a (1 - a) r . [(1 - a) A + a B]^-1 r, concave
// in a.
Vector3 find_way_of_scaled(const Matrix3& A, const Matrix3& B,
                           const Vector3& r) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 30;
  const auto solve = [&](double a) -> Vector3 {
    return Matrix3((1.0 - a) * A + a * B).inverse() * r;
  };
  const auto value = [&](double a) { return a * (1.0 - a) * r.dot(solve(a)); };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kSteps; ++i) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (value(left) > value(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return solve(0.5 * (low + high)).normalized();
}

// h'' of an ellipsoid, about its support point's normal n.
Matrix3 find_bend(const Matrix3& C, const Vector3& n) {
  const Vector3 Cn = C * n;
  const double h = std::sqrt(n.dot(Cn));
  return (C - Cn * Cn.transpose() / (h * h)) / h;
}

/// Symmetric, 2 x 2.
struct Plane2 {
  Jet xx;
  Jet xy;
  Jet yy;

  [[nodiscard]] Jet det() const { return xx * yy - xy * xy; }
  [[nodiscard]] Plane2 inverse() const {
    const Jet by = invert(det());
    return {by * yy, -(by * xy), by * xx};
  }
  [[nodiscard]] Plane2 operator+(const Plane2& b) const {
    return {xx + b.xx, xy + b.xy, yy + b.yy};
  }
};

// h'' along e1 and e2, of C = diag(squares).
Plane2 find_radii(const Vector3& squares, const JetVector& n,
                  const JetVector& e1, const JetVector& e2) {
  const Matrix3 C = squares.asDiagonal();
  const JetVector Cn = C * n;
  const JetVector C1 = C * e1;
  const Jet square = dot(n, Cn);
  const Jet by_h = invert(sqrt(square));
  const Jet by_square = invert(square);
  const Jet a1 = dot(e1, Cn);
  const Jet a2 = dot(e2, Cn);
  return {by_h * (dot(e1, C1) - a1 * a1 * by_square),
          by_h * (dot(e2, C1) - a1 * a2 * by_square),
          by_h * (dot(e2, C * e2) - a2 * a2 * by_square)};
}

/// Of the sum of curvatures.
struct HertzForm {
  Jet radius;     // R_e [m]
  Jet stiffness;  // 4/3 sqrt(R_e) F
};

HertzForm find_form(const Plane2& curvature) {
  constexpr double kStep = 1e-4;
  const Jet root = sqrt(curvature.det());
  const Jet x = 0.5 * ((curvature.xx + curvature.yy) / root);
  const EllipseFactor F = find_ellipse_factor(x.value);
  const double bend =
      (find_ellipse_factor(x.value + kStep).slope - F.slope) / kStep;
  const Jet radius = invert(root);
  return {radius,
          (4.0 / 3.0) * (sqrt(radius) * x.apply(F.value, F.slope, bend))};
}

}  // namespace

/// The touch's values, then its expansion.
class SmoothPair::Touch {
 public:
  Touch(const SmoothPair& pair, const Pose& X_A, const Pose& X_B)
      : A_(pair.other_),
        X_A_(X_A),
        X_B_(X_B),
        C_A_(find_squares(A_.radii, X_A.R)),
        C_B_(find_squares(pair.ellipsoid_.radii, X_B.R)),
        squares_B_(pair.ellipsoid_.radii.cwiseAbs2()),
        axis_(X_A.R.col(2)) {
    if (A_.is_plane) {
      n_ = axis_;
    } else if (A_.radii.x() == A_.radii.y() && A_.radii.x() == A_.radii.z()) {
      find_nearest_on_axis(EllipsoidField(pair.ellipsoid_));
    } else {
      n_ = find_way_of_scaled(C_A_, C_B_, X_B.p - X_A.p);
      polish();
    }
    const Vector3 on_A = X_A_.p + end_ * A_.half_length * axis_ + support(C_A_);
    const Vector3 on_B = X_B_.p - support(C_B_);
    depth_ = n_.dot((A_.is_plane ? X_A_.p : on_A) - on_B);
    place_ = on_B + 0.5 * depth_ * n_;
  }

  [[nodiscard]] double depth() const { return depth_; }
  [[nodiscard]] const Vector3& normal() const { return n_; }
  [[nodiscard]] const Vector3& place() const { return place_; }

  struct Expansion {
    Jet energy;  // over E*
    double radius = 0.0;
  };
  [[nodiscard]] Expansion expand() const {
    const Motion at = follow();
    const JetVector y1 = apply_rotation(at.e1, -1.0);
    const JetVector y2 = apply_rotation(at.e2, -1.0);
    const Matrix3 R = X_B_.R.transpose();
    const Plane2 radii =
        find_radii(squares_B_, R * apply_rotation(at.n, -1.0), R * y1, R * y2);
    const Plane2 own = radii.inverse();
    HertzForm form;
    if (A_.is_plane) {
      form = find_form(own);
    } else {
      const Matrix3 R_A = X_A_.R.transpose();
      form = find_form(own + find_radii(A_.radii.cwiseAbs2(), R_A * at.n,
                                        R_A * at.e1, R_A * at.e2)
                                 .inverse());
    }
    if (A_.half_length > 0.0) form = blend_side(form, own, radii, at);
    const Jet root = sqrt(at.depth);
    return {0.4 * (form.stiffness * at.depth * at.depth * root),
            form.radius.value};
  }

 private:
  /// Of the touch, by the motion.
  struct Motion {
    JetVector n;
    JetVector e1;  // across n, and along the axis of a capsule
    JetVector e2;
    Jet depth;
    Jet place;  // on the axis of a capsule's side [m]
  };

  [[nodiscard]] Vector3 support(const Matrix3& C) const {
    const Vector3 Cn = C * n_;
    const double square = n_.dot(Cn);
    return square > 0.0 ? Vector3(Cn / std::sqrt(square)) : Cn;
  }

  // Of a ball, or where the ellipsoid is deepest along the segment of a
  // capsule.
  void find_nearest_on_axis(const EllipsoidField& field) {
    const Pose X = X_B_.inverse() * X_A_;
    const auto find = [&](double at) {
      return field.find_depth(X * Vector3(0.0, 0.0, at));
    };
    const auto slope = [&](double at) {
      return find(at).gradient.dot(X.R.col(2));
    };
    double at = 0.0;
    const double half = A_.half_length;
    if (half > 0.0) {
      double low = -half;
      double high = half;
      double of_low = slope(low);
      double of_high = slope(high);
      end_ = of_low <= 0.0 ? -1.0 : of_high >= 0.0 ? 1.0 : 0.0;
      at = end_ * half;
      // By the rule of Illinois.
      for (int i = 0, side = 0; i < 100 && end_ == 0.0; ++i) {
        const double fraction = i % 4 == 3 ? 0.5 : of_low / (of_low - of_high);
        at = low + fraction * (high - low);
        if (!(high - low > 1e-15 * half)) break;
        const double now = slope(at);
        if (std::abs(now) < 1e-15) break;
        if (now > 0.0) {
          low = at;
          of_low = now;
          if (side == 1) of_high *= 0.5;
          side = 1;
        } else {
          high = at;
          of_high = now;
          if (side == -1) of_low *= 0.5;
          side = -1;
        }
      }
    }
    n_ = X_B_.R * find(at).gradient;
    if (half > 0.0 && end_ == 0.0) {
      n_ = (n_ - n_.dot(axis_) * axis_).normalized();
      is_on_side_ = true;
    }
  }

  // Newton's method to the least depth.
  void polish() {
    constexpr int kMostIterations = 20;
    for (int i = 0; i < kMostIterations; ++i) {
      const Basis t = find_basis();
      const Vector3 g = support(C_A_) + support(C_B_) - (X_B_.p - X_A_.p);
      const Eigen::Vector2d rest(g.dot(t.e1), g.dot(t.e2));
      const Eigen::Vector2d step = find_slopes(t, g.dot(n_)).inverse() * rest;
      const double most = 0.3 / std::max(step.norm(), 0.3);
      n_ = (n_ - most * (step[0] * t.e1 + step[1] * t.e2)).normalized();
      if (step.norm() < 1e-15) break;
    }
  }

  struct Basis {
    Vector3 e1;
    Vector3 e2;
  };
  [[nodiscard]] Basis find_basis() const {
    constexpr double kAlong = 1e-6;
    Vector3 e1 = axis_ - n_.dot(axis_) * n_;
    if (A_.half_length == 0.0 || e1.norm() < kAlong) e1 = n_.unitOrthogonal();
    e1.normalize();
    return {e1, n_.cross(e1)};
  }
  // Of g . e by a change of n.
  [[nodiscard]] Eigen::Matrix2d find_slopes(const Basis& t,
                                            double depth) const {
    const Matrix3 P = find_bend(C_A_, n_) + find_bend(C_B_, n_);
    Eigen::Matrix2d slopes;
    slopes << t.e1.dot(P * t.e1) - depth, t.e1.dot(P * t.e2),
        t.e1.dot(P * t.e2), t.e2.dot(P * t.e2) - depth;
    return slopes;
  }

  // m = n + a e1 + b e2 normal to both, by as many iterations as derivatives.
  [[nodiscard]] Motion follow() const {
    constexpr int kIterations = 2;
    const Basis t = find_basis();
    const JetVector moved = move(X_B_.p - place_);
    const Vector3 p_A = X_A_.p - place_ + end_ * A_.half_length * axis_;
    const Eigen::Matrix2d slopes =
        A_.is_plane ? Eigen::Matrix2d::Identity() : find_slopes(t, depth_);
    const Eigen::Matrix2d inverse = slopes.inverse();
    Jet a;
    Jet b;
    JetVector m = make_jets(n_);
    JetVector on_B;
    JetVector g;
    const auto evaluate = [&] {
      const JetVector y = apply_rotation(m, -1.0);
      const JetVector Cy = C_B_ * y;
      on_B = apply_rotation(invert(sqrt(dot(y, Cy))) * Cy, 1.0);
      g = on_B - moved + make_jets(p_A);
      if (A_.is_plane) return;
      const JetVector Cm = C_A_ * m;
      g = g + invert(sqrt(dot(m, Cm))) * Cm;
    };
    evaluate();
    for (int i = 0; i < kIterations && !A_.is_plane; ++i) {
      const Jet along = dot(n_, g);
      const Jet rest1 = dot(t.e1, g) - a * along;
      const Jet rest2 = dot(t.e2, g) - b * along;
      if (is_on_side_) {
        b = b - 1.0 / slopes(1, 1) * rest2;
      } else {
        a = a - (inverse(0, 0) * rest1 + inverse(0, 1) * rest2);
        b = b - (inverse(1, 0) * rest1 + inverse(1, 1) * rest2);
      }
      m = make_jets(n_) + a * make_jets(t.e1) + b * make_jets(t.e2);
      evaluate();
    }
    Motion out;
    out.n = invert(sqrt(dot(m, m))) * m;
    out.depth = dot(out.n, g);
    const JetVector e1 = make_jets(t.e1) - dot(t.e1, out.n) * out.n;
    out.e1 = invert(sqrt(dot(e1, e1))) * e1;
    out.e2 = cross(out.n, out.e1);
    out.place = dot(axis_, moved - on_B) - axis_.dot(X_A_.p - place_);
    return out;
  }

  // From the form at an end to that on the side. @param own curvature, and
  // radii, of the ellipsoid
  [[nodiscard]] HertzForm blend_side(const HertzForm& at_end, const Plane2& own,
                                     const Plane2& radii,
                                     const Motion& at) const {
    const double r = A_.radii.x();
    Jet place = at.place;
    if (!is_on_side_) {
      const Jet rest = Jet(r) - at.depth;
      const Plane2 P{radii.xx + rest, radii.xy, radii.yy + rest};
      place = Jet(end_ * A_.half_length) + dot(axis_, at.n) * P.det() / P.yy;
    }
    const Jet by_width = invert(sqrt(at_end.radius * at.depth));
    const auto find_fraction = [&](double end) {
      const Jet x = (end * place - Jet(A_.half_length)) * by_width;
      const Blend b = blend(x.value);
      return x.apply(b.value, b.slope, b.bend);
    };
    const Jet fraction = find_fraction(-1.0) + find_fraction(1.0);
    if (fraction.value == 1.0 && fraction.slope.isZero(0.0)) return at_end;
    const HertzForm on_side =
        find_form(own + Plane2{Jet(0.0), Jet(0.0), Jet(1.0 / r)});
    const auto pass = [&](const Jet& from, const Jet& to) {
      return from + fraction * (to - from);
    };
    return {pass(on_side.radius, at_end.radius),
            pass(on_side.stiffness, at_end.stiffness)};
  }

  const Other& A_;
  Pose X_A_;
  Pose X_B_;
  Matrix3 C_A_;
  Matrix3 C_B_;
  Vector3 squares_B_;
  Vector3 axis_;
  Vector3 n_ = Vector3::UnitX();  // from A to B
  double end_ = 0.0;              // of a capsule that touches, -1 or 1
  bool is_on_side_ = false;       // of a capsule
  double depth_ = 0.0;
  Vector3 place_ = Vector3::Zero();
};

bool SmoothPair::suits(const BodyKind& A, const BodyKind& B) {
  const auto is_other = [](const BodyKind& body) {
    const auto* solid = std::get_if<ConvexSolid>(&body);
    return std::holds_alternative<Sphere>(body) ||
           std::holds_alternative<Capsule>(body) ||
           std::holds_alternative<Ellipsoid>(body) ||
           (solid != nullptr && !solid->is_bounded());
  };
  return (std::holds_alternative<Ellipsoid>(A) && is_other(B)) ||
         (std::holds_alternative<Ellipsoid>(B) && is_other(A));
}

SmoothPair::SmoothPair(const BodyKind& A, const BodyKind& B, double modulus)
    : is_ellipsoid_first_(!std::holds_alternative<Ellipsoid>(B)),
      modulus_(modulus) {
  LIMBER_EXPECT(suits(A, B));
  const BodyKind& other = is_ellipsoid_first_ ? B : A;
  ellipsoid_ = std::get<Ellipsoid>(is_ellipsoid_first_ ? A : B);
  if (const auto* ball = std::get_if<Sphere>(&other)) {
    other_.radii.setConstant(ball->radius);
  } else if (const auto* capsule = std::get_if<Capsule>(&other)) {
    other_.radii.setConstant(capsule->radius);
    other_.half_length = capsule->half_length;
  } else if (const auto* egg = std::get_if<Ellipsoid>(&other)) {
    other_.radii = egg->radii;
  } else {
    other_.is_plane = true;
  }
}

Patch SmoothPair::press(const Pose& X_A, const Pose& X_B) const {
  const Touch touch(*this, X_A, X_B);
  Patch out;
  const double d = touch.depth();
  if (!(d > 0.0) || !std::isfinite(d)) return out;
  const auto [energy, radius] = touch.expand();
  const Vector3& n = touch.normal();
  out.touches = true;
  out.exponent = 1.5;
  out.depth = d;
  out.energy = modulus_ * energy.value;
  out.centre_W = touch.place();
  out.gradient_W = modulus_ * energy.slope;
  out.hessian_W = modulus_ * energy.bend;
  out.spread_W = 0.2 * radius * d * (Matrix3::Identity() - n * n.transpose());
  return out;
}

Patch SmoothPair::evaluate(const Pose& X_A, const Pose& X_B) const {
  if (!is_ellipsoid_first_) return press(X_A, X_B);
  Patch out = press(X_B, X_A);
  out.gradient_W = -out.gradient_W;
  return out;
}

}  // namespace limber::contact
