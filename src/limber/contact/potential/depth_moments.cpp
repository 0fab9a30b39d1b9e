// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/depth_moments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/common/stack_array.hpp"
#include "limber/contact/potential/quadrature.hpp"

namespace limber::contact {
namespace {

/// Sums of weights times 1, r and r r'.
struct Weights {
  double zeroth = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  void add(double weight, const Vector3& r) {
    zeroth += weight;
    first += weight * r;
    second += (weight * r) * r.transpose();
  }
};

/// Of one cell, in which t = h - n . r and g = -sign (n, r x n).
struct CellSums {
  double cubed = 0.0;  ///< int 4 t^3
  Weights squared;     ///< by 12 t^2
  Weights linear;      ///< by 24 t
};

// sum w g
Vector6 sum_gradients(const Weights& w, const Vector3& normal) {
  Vector6 sum;
  sum << -w.zeroth * normal, -w.first.cross(normal);
  return sum;
}

// sum w g g'
Matrix6 sum_squares(const Weights& w, const Vector3& normal) {
  const Matrix3 N = skew(normal);  // r x n = -N r
  Matrix6 sum;
  sum.topLeftCorner<3, 3>() = w.zeroth * normal * normal.transpose();
  sum.topRightCorner<3, 3>() = normal * w.first.cross(normal).transpose();
  sum.bottomLeftCorner<3, 3>() = sum.topRightCorner<3, 3>().transpose();
  sum.bottomRightCorner<3, 3>() = N * w.second * N.transpose();
  return sum;
}

/// The sums of products of 1, 2 and 3 of some numbers, repetitions included.
struct CompleteSums {
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;

  void add(double t) {
    first += t;
    second += t * first;
    third += t * second;
  }
};

/// One face's part of the overlap.
struct Cell {
  const Plane& plane;  // of unit normal, relative to o
  double sign;
  bool has_derivatives;

  // A tetrahedron, exactly: with fractions s_i of its corners the mean of
  // t^n s_i s_j over it is 6 n! / (n + 5)! (1 + d_ij) times the complete sum of
  // degree n of the corners' t and of t_i and t_j again.
  void add(double volume, const std::array<Vector3, 4>& x,
           CellSums& sums) const {
    std::array<double, 4> t;
    CompleteSums all;
    for (std::size_t i = 0; i < 4; ++i) all.add(t[i] = plane.find_depth(x[i]));
    Vector3 X = Vector3::Zero();  // sum x_i
    Vector3 T = Vector3::Zero();  // sum t_i x_i
    Vector3 B = Vector3::Zero();  // sum t_i (S + t_i) x_i, S the first sum
    Matrix3 by_square = Matrix3::Zero();
    Matrix3 by_t = Matrix3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const double b = t[i] * (all.first + t[i]);
      X += x[i];
      T += t[i] * x[i];
      B += b * x[i];
      const Vector3 half = 0.5 * x[i];
      by_square +=
          ((all.second + 2.0 * b + t[i] * t[i]) * half) * x[i].transpose();
      by_t += ((all.first + 2.0 * t[i]) * half) * x[i].transpose();
    }
    sums.cubed += 0.2 * volume * all.third;
    by_square += (0.5 * all.second * X + B) * X.transpose();
    by_square += (0.5 * T) * T.transpose();
    sums.squared.zeroth += 1.2 * volume * all.second;
    sums.squared.first += 0.2 * volume * (all.second * X + B);
    sums.squared.second += volume / 35.0 * (by_square + by_square.transpose());
    if (!has_derivatives) return;
    by_t += (0.5 * all.first * X + T) * X.transpose();
    sums.linear.zeroth += 6.0 * volume * all.first;
    sums.linear.first += 1.2 * volume * (all.first * X + T);
    sums.linear.second += 0.2 * volume * (by_t + by_t.transpose());
  }
};

// By tetrahedra over the facets that do not contain their apex.
void integrate(const Polytope& part, const Cell& cell, CellSums& sums) {
  const Vector3 apex = part.corners().front();
  for (const Facet& facet : part.facets()) {
    const auto corners = facet.corners;
    if (std::find(corners.begin(), corners.end(), apex) != corners.end()) {
      continue;
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const std::array<Vector3, 4> x{apex, corners[0], corners[k],
                                     corners[k + 1]};
      const double volume =
          (x[1] - apex).dot((x[2] - apex).cross(x[3] - apex)) / 6.0;
      if (volume != 0.0) cell.add(volume, x, sums);
    }
  }
}

// Of a facet's points, t their depth below a plane.
// @param density (area, t) of a point
template <class Density>
Weights weigh_facet(const Facet& facet, const Plane& plane,
                    const Density& density) {
  Weights weights;
  const auto corners = facet.corners;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const std::array<Vector3, 3> x{corners[0], corners[k], corners[k + 1]};
    const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
    for (const auto& point : triangle_rule()) {
      const Vector3 r = point.find_place(x);
      const double t = std::max(plane.find_depth(r), 0.0);
      weights.add(density(area * point.weight, t), r);
    }
  }
  return weights;
}

// By 12 t^2.
Weights weigh_square(const Facet& facet, const Plane& plane) {
  return weigh_facet(facet, plane,
                     [](double area, double t) { return 12.0 * area * t * t; });
}

// int 12 t^2 dg dg' / |n_i - n_j| dS, dg = -sign (dn, r x dn)
Matrix6 integrate_interface(const Facet& facet, const Plane& plane,
                            const Vector3& dn) {
  const Weights weights = weigh_square(facet, plane);
  return sum_squares(weights, dn) / dn.norm();
}

void add_cell(const CellSums& sums, const Cell& cell, DepthMoments& out) {
  const Vector3 n = cell.sign * cell.plane.n;
  out.M += sums.cubed;
  out.m1 += sum_gradients(sums.squared, n);
  if (!cell.has_derivatives) return;
  out.m2 += sum_squares(sums.linear, n);
  // n . (theta x (theta x r)), of the true normal
  const Vector3& normal = cell.plane.n;
  const Vector3& a = sums.squared.first;
  out.m2.bottomRightCorner<3, 3>() -=
      0.5 * (normal * a.transpose() + a * normal.transpose()) -
      normal.dot(a) * Matrix3::Identity();
}

// sum w (n, r x n) (m, r x m)'
Matrix6 sum_products(const Weights& w, const Vector3& n, const Vector3& m) {
  const Matrix3 N = skew(n);  // r x n = -N r
  const Matrix3 M = skew(m);
  Matrix6 sum;
  sum.topLeftCorner<3, 3>() = w.zeroth * n * m.transpose();
  sum.topRightCorner<3, 3>() = n * w.first.cross(m).transpose();
  sum.bottomLeftCorner<3, 3>() = w.first.cross(n) * m.transpose();
  sum.bottomRightCorner<3, 3>() = N * w.second * M.transpose();
  return sum;
}

// int 4 t^3 (n, r x n) dS over a facet on which the depth ends without being
// zero, n its normal.
Vector6 integrate_end(const Facet& facet, const Plane& plane,
                      const Vector3& normal) {
  const Weights weights = weigh_facet(facet, plane, [](double area, double t) {
    return 4.0 * area * t * t * t;
  });
  return -sum_gradients(weights, normal);
}

// Of its derivative int 12 t^2 (g (n, r x n)' + (n, r x n) g') dS, without what
// the facet's edges add.
Matrix6 integrate_end_change(const Facet& facet, const Plane& plane,
                             const Vector3& normal) {
  const Weights weights = weigh_square(facet, plane);
  const Matrix6 half = -sum_products(weights, plane.n, normal);
  return half + half.transpose();
}

/// A face to which a part of the overlap is nearest.
struct PressedFace {
  int face = 0;
  Weights squared;  ///< of its part, by 12 t^2
};

/// A ball about corners.
struct Around {
  Vector3 centre = Vector3::Zero();
  double radius = 0.0;

  explicit Around(std::span<const Vector3> corners) {
    for (const Vector3& x : corners) centre += x;
    centre /= static_cast<double>(corners.size());
    for (const Vector3& x : corners) {
      radius = std::max(radius, (x - centre).norm());
    }
  }
};

class Integration {
 public:
  Integration(const ConvexSolid& soft, const Pose& X, const Polytope& overlap,
              int side, bool has_derivatives)
      : soft_(soft),
        X_(X),
        overlap_(overlap),
        side_(side),
        sign_(side == 0 ? 1.0 : -1.0),
        has_derivatives_(has_derivatives) {
    choose_faces();
  }

  [[nodiscard]] DepthMoments run() {
    for (PressedFace& pressed : near_.all()) add_face(pressed);
    add_pressure();
    return out_;
  }

 private:
  [[nodiscard]] const ConvexSolid::Face& face(int i) const {
    return soft_.faces()[index(i)];
  }
  [[nodiscard]] Plane place(const Plane& plane) const {
    const Vector3 n = X_.R * plane.n;
    return {n, plane.h + n.dot(X_.p)};
  }

  // Those that may be nearest to a point of the overlap: all of it is at most
  // as deep as its deepest point below one of them.
  void choose_faces() {
    const Around around(overlap_.corners());
    const Vector3 centre = X_.R.transpose() * (around.centre - X_.p);
    const auto visit = [&](const auto& use) {
      for (std::size_t i = 0; i < soft_.faces().size(); ++i) {
        const ConvexSolid::Face& at = soft_.faces()[i];
        if (at.presses) use(static_cast<int>(i), at.plane.find_depth(centre));
      }
    };
    double least = std::numeric_limits<double>::infinity();
    visit([&](int i, double t) {
      if (!(t < least)) return;
      least = t;
      shallowest_ = i;
    });
    if (shallowest_ < 0) return;
    const Plane shallow = place(face(shallowest_).plane);
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3& x : overlap_.corners()) {
      most = std::max(most, shallow.find_depth(x));
    }
    visit([&](int i, double t) {
      if (t - around.radius > most) return;
      const Plane plane = place(face(i).plane);
      const bool is_near = std::ranges::any_of(
          overlap_.corners(),
          [&](const Vector3& x) { return plane.find_depth(x) <= most; });
      if (is_near) near_.add().face = i;
    });
  }

  // Below it: nearer to face i than to face j.
  [[nodiscard]] Plane find_bisector(int i, int j) const {
    const Plane& own = face(i).plane;
    const Plane& other = face(j).plane;
    return place({other.n - own.n, other.h - own.h});
  }

  // By the face nearest to the overlap's middle, which leaves little of other
  // parts, by the faces beside it, and then by others.
  [[nodiscard]] bool cut_part(int i, Cutter& cutter) const {
    const auto cut = [&](int j) { return cutter.cut(find_bisector(i, j), j); };
    if (i != shallowest_ && !cut(shallowest_)) return false;
    const std::vector<int>& beside = face(i).neighbours;
    for (const int j : beside) {
      if (j != shallowest_ && face(j).presses && !cut(j)) return false;
    }
    Around around(cutter.part().corners());
    for (const PressedFace& other : near_.all()) {
      const int j = other.face;
      if (j == i || j == shallowest_ ||
          std::ranges::find(beside, j) != beside.end()) {
        continue;
      }
      const Plane plane = find_bisector(i, j);
      const double reach = around.radius * plane.n.norm();
      if (plane.find_depth(around.centre) > reach) continue;
      if (!cut(j)) return false;
    }
    return true;
  }

  void add_face(PressedFace& pressed) {
    const int i = pressed.face;
    Cutter cutter(overlap_, scratch_);
    if (!cut_part(i, cutter)) return;
    const Plane plane = place(face(i).plane);
    const Cell cell{plane, sign_, has_derivatives_};
    CellSums sums;
    integrate(cutter.part(), cell, sums);
    add_cell(sums, cell, out_);
    pressed.squared = sums.squared;
    for (const Vector3& x : cutter.part().corners()) {
      out_.depth = std::max(out_.depth, plane.find_depth(x));
    }
    for (const Facet& facet : cutter.part().facets()) {
      add_facet(i, plane, facet);
    }
  }

  void add_facet(int i, const Plane& plane, const Facet& facet) {
    const int end = ConvexSolid::face_of(facet.tag, side_);
    if (end >= 0 && !face(end).presses) {
      const Vector3 n = X_.R * face(end).plane.n;
      out_.m1 -= sign_ * integrate_end(facet, plane, n);
      if (has_derivatives_) out_.m2 -= integrate_end_change(facet, plane, n);
    }
    if (!has_derivatives_ || facet.tag <= i) return;
    out_.m2 -= integrate_interface(facet, plane,
                                   plane.n - X_.R * face(facet.tag).plane.n);
  }

  // Faces beside a flat that slides do not press.
  void add_pressure() {
    const Vector3 resultant = out_.m1.head<3>().normalized();
    for (const PressedFace& pressed : near_.all()) {
      const Vector3 n = sign_ * (X_.R * face(pressed.face).plane.n);
      const double fraction = std::max(-n.dot(resultant), 0.0);
      out_.pressure += fraction * pressed.squared.zeroth;
      out_.first += fraction * pressed.squared.first;
      out_.second += fraction * pressed.squared.second;
    }
  }

  const ConvexSolid& soft_;
  const Pose& X_;
  const Polytope& overlap_;
  int side_;
  double sign_;
  bool has_derivatives_;
  int shallowest_ = -1;  // face at the overlap's middle
  StackArray<PressedFace, ConvexSolid::kMostFaces> near_;
  std::array<Polytope, 2> scratch_;
  DepthMoments out_;
};

}  // namespace

DepthMoments find_depth_moments(const ConvexSolid& soft, const Pose& X,
                                const Polytope& overlap, int side,
                                bool has_derivatives) {
  return Integration(soft, X, overlap, side, has_derivatives).run();
}

}  // namespace limber::contact
