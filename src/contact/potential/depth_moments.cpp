// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/depth_moments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/potential/quadrature.hpp"

namespace limber::contact {
namespace {

constexpr std::size_t kMostFaces = 16;

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

/// One face's part of the overlap.
struct Cell {
  const Plane& plane;  // of unit normal, relative to o
  double sign;
  bool has_derivatives;

  void add(double weight, const Vector3& r, CellSums& sums) const {
    const double t = plane.find_depth(r);
    const double by_t = 24.0 * weight * t;
    sums.cubed += 4.0 * weight * t * t * t;
    sums.squared.add(0.5 * by_t * t, r);
    if (has_derivatives) sums.linear.add(by_t, r);
  }
};

// By tetrahedra over the facets that do not contain their apex.
void integrate(const Polytope& part, const Cell& cell, CellSums& sums) {
  const Vector3 apex = part.facets().front().corners().front();
  for (const Facet& facet : part.facets()) {
    const auto corners = facet.corners();
    if (std::find(corners.begin(), corners.end(), apex) != corners.end()) {
      continue;
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const std::array<Vector3, 4> x{apex, corners[0], corners[k],
                                     corners[k + 1]};
      const double volume =
          (x[1] - apex).dot((x[2] - apex).cross(x[3] - apex)) / 6.0;
      if (volume == 0.0) continue;
      for (const auto& point : tetrahedron_rule()) {
        cell.add(volume * point.weight, point.find_place(x), sums);
      }
    }
  }
}

// Of a facet's points, t their depth below a plane.
// @param density (area, t) of a point
template <class Density>
Weights weigh_facet(const Facet& facet, const Plane& plane,
                    const Density& density) {
  Weights weights;
  const auto corners = facet.corners();
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

// The part of the overlap that is nearest to a face.
const Polytope* find_part(const ConvexSolid::Face& face, const Pose& X,
                          const Polytope& overlap,
                          std::array<Polytope, 2>& scratch) {
  const Polytope* part = &overlap;
  std::size_t next = 0;
  for (const ConvexSolid::Bisector& bisector : face.nearest) {
    const Vector3 n = X.R * bisector.plane.n;
    const Polytope& cut = clip(*part, {n, bisector.plane.h + n.dot(X.p)},
                               bisector.other, scratch[next]);
    if (&cut != part) next = 1 - next;
    part = &cut;
    if (part->facets().size() < 4) return nullptr;
  }
  return part;
}

// The own face that has this tag and does not press, or -1.
int find_end(const ConvexSolid& soft, int tag, int side) {
  for (std::size_t i = 0; i < soft.faces().size(); ++i) {
    if (soft.faces()[i].presses) continue;
    if (tag == ConvexSolid::tag_of(static_cast<int>(i), side)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

}  // namespace

DepthMoments find_depth_moments(const ConvexSolid& soft, const Pose& X,
                                const Polytope& overlap, int side,
                                bool has_derivatives) {
  const double sign = side == 0 ? 1.0 : -1.0;
  DepthMoments out;
  std::array<Polytope, 2> scratch;
  std::array<CellSums, kMostFaces> cells;
  const auto place = [&](const Plane& plane) {
    const Vector3 n = X.R * plane.n;
    return Plane{n, plane.h + n.dot(X.p)};
  };
  for (std::size_t i = 0; i < soft.faces().size(); ++i) {
    const ConvexSolid::Face& face = soft.faces()[i];
    if (!face.presses) continue;
    LIMBER_EXPECT(i < cells.size());
    const Polytope* part = find_part(face, X, overlap, scratch);
    if (part == nullptr) continue;
    const Plane plane = place(face.plane);
    const Cell cell{plane, sign, has_derivatives};
    CellSums& sums = cells[i];
    integrate(*part, cell, sums);
    add_cell(sums, cell, out);
    for (const Facet& facet : part->facets()) {
      for (const Vector3& x : facet.corners()) {
        out.depth = std::max(out.depth, plane.find_depth(x));
      }
      const int end = find_end(soft, facet.tag(), side);
      if (end >= 0) {
        const Vector3 n = X.R * soft.faces()[index(end)].plane.n;
        out.m1 -= sign * integrate_end(facet, plane, n);
        if (has_derivatives) {
          out.m2 -= integrate_end_change(facet, plane, n);
        }
      }
      if (!has_derivatives || facet.tag() <= static_cast<int>(i)) continue;
      const Plane& other =
          soft.faces()[static_cast<std::size_t>(facet.tag())].plane;
      out.m2 -= integrate_interface(facet, plane, plane.n - X.R * other.n);
    }
  }
  // Faces beside a flat that slides do not press.
  const Vector3 resultant = out.m1.head<3>().normalized();
  for (std::size_t i = 0; i < soft.faces().size(); ++i) {
    if (!soft.faces()[i].presses) continue;
    const Vector3 n = sign * place(soft.faces()[i].plane).n;
    const double share = std::max(-n.dot(resultant), 0.0);
    out.pressure += share * cells[i].squared.zeroth;
    out.first += share * cells[i].squared.first;
    out.second += share * cells[i].squared.second;
  }
  return out;
}

}  // namespace limber::contact
