// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_radii.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/fem/mesh/box_tree.hpp"

namespace limber::flexbody {
namespace {

/// int n dA over a face [m^2].
Vector3 calc_vector_area(const fem::Mesh& mesh, const fem::SurfaceFace& face,
                         const fem::FaceTable& rule) {
  const Matrix3X x = mesh.x(Eigen::all, face.nodes);
  const Matrix3X along_u = x * rule.along_u;
  const Matrix3X along_v = x * rule.along_v;
  Vector3 area = Vector3::Zero();
  for (Eigen::Index q = 0; q < along_u.cols(); ++q)
    area += rule.weights[q] *
            Vector3(along_u.col(q)).cross(Vector3(along_v.col(q)));
  return area;
}

/// The surface of a whole body, to measure through it.
class Thickness {
 public:
  explicit Thickness(const fem::Mesh& mesh)
      : x_(mesh.x),
        triangles_(fem::boundary_triangles(mesh)),
        tree_(list_boxes()) {}

  /// Distance from `origin` along the unit vector `inward` to where it leaves
  /// the body; infinity if that is farther than `reach` [m].
  [[nodiscard]] double measure(const Vector3& origin, const Vector3& inward,
                               double reach) const {
    fem::BoxTree::Box path(origin);
    path.extend(Vector3(origin + reach * inward));
    double nearest = std::numeric_limits<double>::infinity();
    for (const int t : tree_.find(path)) {
      const double distance = find_exit(triangles_[index(t)], origin, inward);
      if (distance <= reach) nearest = std::min(nearest, distance);
    }
    return nearest;
  }

 private:
  [[nodiscard]] std::vector<fem::BoxTree::Box> list_boxes() const {
    std::vector<fem::BoxTree::Box> boxes;
    for (const std::array<int, 3>& t : triangles_) {
      fem::BoxTree::Box box;
      for (const int node : t) box.extend(Vector3(x_.col(node)));
      boxes.push_back(box);
    }
    return boxes;
  }

  /// [@moller1997]; only through the inner side.
  [[nodiscard]] double find_exit(const std::array<int, 3>& triangle,
                                 const Vector3& origin,
                                 const Vector3& inward) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    constexpr double kGrazing = 1e-3;  // sine
    constexpr double kEdge = 1e-6;     // so that none slips between two
    constexpr double kStart = 1e-6;    // of the triangle's size
    const Vector3 a = x_.col(triangle[0]);
    Matrix3 A;
    A << x_.col(triangle[1]) - a, x_.col(triangle[2]) - a, -inward;
    const Vector3 normal = Vector3(A.col(0)).cross(Vector3(A.col(1)));
    if (normal.dot(inward) < kGrazing * normal.norm()) return kNone;
    const Vector3 answer = A.inverse() * (origin - a);
    const bool is_inside = answer[0] > -kEdge && answer[1] > -kEdge &&
                           answer[0] + answer[1] < 1.0 + kEdge;
    const double least = kStart * std::sqrt(normal.norm());
    return is_inside && answer[2] > least ? answer[2] : kNone;
  }

  const Matrix3X& x_;
  std::vector<std::array<int, 3>> triangles_;
  fem::BoxTree tree_;
};

/// Measures of each corner from the faces there.
struct Corners {
  VectorX edge;     ///< mean length of the edges [m]
  Matrix3X inside;  ///< mean centre of the faces [m]
};

Corners describe_corners(const fem::Surface& surface) {
  const auto n = static_cast<Eigen::Index>(surface.points.size());
  Corners corners{VectorX::Zero(n), Matrix3X::Zero(3, n)};
  VectorX edges = VectorX::Zero(n);
  VectorX faces = VectorX::Zero(n);
  for (const fem::SurfaceFace& face : surface.faces) {
    const int count = surface.shapes[face.shape].corner_count();
    const auto at = [&](int k) -> const Vector3& {
      return surface.points[index(face.points[index(k % count)])].x;
    };
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < count; ++k) centre += at(k) / count;
    for (int k = 0; k < count; ++k) {
      const int p = face.points[index(k)];
      corners.inside.col(p) += centre;
      faces[p] += 1.0;
      for (const int other : {k + 1, k + count - 1}) {
        corners.edge[p] += (at(other) - at(k)).norm();
        edges[p] += 1.0;
      }
    }
  }
  for (Eigen::Index p = 0; p < n; ++p) {
    corners.edge[p] /= std::max(edges[p], 1.0);
    corners.inside.col(p) /= std::max(faces[p], 1.0);
  }
  return corners;
}

}  // namespace

Matrix3X find_normals(const fem::Mesh& mesh, const fem::Surface& surface) {
  constexpr int kDivisions = 2;
  std::vector<fem::FaceTable> rules;
  for (const fem::FaceShape& shape : surface.shapes)
    rules.push_back(shape.make_rule(kDivisions));
  Matrix3X normals =
      Matrix3X::Zero(3, static_cast<Eigen::Index>(surface.points.size()));
  for (const fem::SurfaceFace& face : surface.faces) {
    const Vector3 area = calc_vector_area(mesh, face, rules[face.shape]);
    for (const int p : face.points) normals.col(p) += area;
  }
  normals.colwise().normalize();
  return normals;
}

VectorX find_patch_radii(const fem::Mesh& mesh, const fem::Surface& surface,
                         const Matrix3X& normals) {
  // At the rim of a surface the inward normal may run along the body's side:
  // measure a little inside of the rim.
  constexpr double kInside = 0.1;
  const Thickness thickness(mesh);
  const Corners corners = describe_corners(surface);
  VectorX radii(normals.cols());
  for (Eigen::Index p = 0; p < radii.size(); ++p) {
    const fem::SurfacePoint& point = surface.points[index(static_cast<int>(p))];
    if (!point.is_corner()) {
      radii[p] = 0.5 * (radii[point.ends[0]] + radii[point.ends[1]]);
      continue;
    }
    const Vector3 origin =
        (1.0 - kInside) * point.x + kInside * corners.inside.col(p);
    const double reach = corners.edge[p] / kMostOfThickness;
    const double through = thickness.measure(origin, -normals.col(p), reach);
    radii[p] = std::max(kMostOfThickness * std::min(reach, through),
                        kLeastOfEdge * corners.edge[p]);
  }
  return radii;
}

}  // namespace limber::flexbody
