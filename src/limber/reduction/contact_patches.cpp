// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_patches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/mesh/box_tree.hpp"

namespace limber::flexbody {
namespace {

using Box = fem::BoxTree::Box;

Box find_bounds(const fem::Mesh& mesh, const fem::SurfaceFace& face) {
  Box box;
  for (const int node : face.nodes) box.extend(Vector3(mesh.x.col(node)));
  // A curved face bulges beyond its nodes, by less than this.
  const Vector3 margin = Vector3::Constant(0.25 * box.diagonal().norm());
  return {Vector3(box.min() - margin), Vector3(box.max() + margin)};
}

std::vector<Box> list_bounds(const fem::Mesh& mesh,
                             const fem::Surface& surface) {
  std::vector<Box> boxes;
  for (const fem::SurfaceFace& face : surface.faces)
    boxes.push_back(find_bounds(mesh, face));
  return boxes;
}

/// Integrates the pressure of patches over a surface.
class PatchMaker {
 public:
  PatchMaker(const fem::Mesh& mesh, const fem::Surface& surface)
      : mesh_(mesh), surface_(surface), tree_(list_bounds(mesh, surface)) {}

  ContactPatch make(const Vector3& x, const Vector3& normal, double radius) {
    const Vector3 reach = Vector3::Constant(radius);
    const std::vector<int> faces =
        tree_.find({Vector3(x - reach), Vector3(x + reach)});
    // cos 60 degrees; less steep ones only where there is nothing else.
    for (const double least : {0.5, 0.0, -1.0}) {
      std::map<int, double> fractions;
      for (const int face : faces)
        add_contributions(surface_.faces[index(face)],
                          {x, normal, radius, least}, fractions);
      if (!fractions.empty()) return normalise(fractions, normal, radius);
    }
    LIMBER_EXPECT(!"a patch holds a point of its surface");
    return {};
  }

 private:
  struct Place {
    Vector3 x;
    Vector3 normal;
    double radius;        // [m]
    double least_cosine;  // between the surface's normal and the patch's
  };

  void add_contributions(const fem::SurfaceFace& face, const Place& place,
                         std::map<int, double>& fractions) {
    const Matrix3X x = mesh_.x(Eigen::all, face.nodes);
    const fem::FaceTable& rule = find_rule(face, place.radius);
    const Matrix3X points = x * rule.shape;
    const Matrix3X along_u = x * rule.along_u;
    const Matrix3X along_v = x * rule.along_v;
    VectorX pressure = VectorX::Zero(points.cols());
    for (Eigen::Index q = 0; q < points.cols(); ++q) {
      const double r = (points.col(q) - place.x).norm() / place.radius;
      if (r >= 1.0) continue;
      const Vector3 area =
          Vector3(along_u.col(q)).cross(Vector3(along_v.col(q)));
      const double size = area.norm();
      if (area.dot(place.normal) < place.least_cosine * size) continue;
      pressure[q] = rule.weights[q] * size * std::sqrt(1.0 - r * r);
    }
    if (pressure.isZero(0.0)) return;
    const VectorX fraction = rule.shape * pressure;
    for (std::size_t k = 0; k < face.nodes.size(); ++k)
      fractions[face.nodes[k]] += fraction[static_cast<Eigen::Index>(k)];
  }

  /// So fine that four cells lie across the patch's radius.
  const fem::FaceTable& find_rule(const fem::SurfaceFace& face, double radius) {
    constexpr int kLeast = 8;
    constexpr int kMost = 96;
    const double size = (Matrix3X(mesh_.x(Eigen::all, face.nodes)).colwise() -
                         mesh_.x.col(face.nodes[0]))
                            .colwise()
                            .norm()
                            .maxCoeff();
    int divisions = kLeast;
    while (divisions < kMost && divisions * radius < 0.5 * kLeast * size)
      divisions *= 2;
    const auto key = std::make_pair(face.shape, divisions);
    const auto found = rules_.find(key);
    if (found != rules_.end()) return found->second;
    return rules_.emplace(key, surface_.shapes[face.shape].make_rule(divisions))
        .first->second;
  }

  static ContactPatch normalise(const std::map<int, double>& fractions,
                                const Vector3& normal, double radius) {
    ContactPatch patch{normal,
                       radius,
                       {},
                       VectorX(static_cast<Eigen::Index>(fractions.size()))};
    for (const auto& [node, fraction] : fractions) {
      patch.weights[static_cast<Eigen::Index>(patch.nodes.size())] = fraction;
      patch.nodes.push_back(node);
    }
    patch.weights /= patch.weights.sum();
    return patch;
  }

  const fem::Mesh& mesh_;
  const fem::Surface& surface_;
  fem::BoxTree tree_;
  std::map<std::pair<std::size_t, int>, fem::FaceTable> rules_;
};

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

std::vector<ContactPatch> find_patches(const fem::Mesh& mesh,
                                       const fem::Surface& surface,
                                       const Matrix3X& normals,
                                       const VectorX& radii) {
  PatchMaker maker(mesh, surface);
  std::vector<ContactPatch> patches;
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    patches.push_back(
        maker.make(surface.points[p].x, normals.col(i), radii[i]));
  }
  return patches;
}

MatrixX average(const MatrixX& Phi, const std::vector<ContactPatch>& patches) {
  MatrixX mean =
      MatrixX::Zero(3 * static_cast<Eigen::Index>(patches.size()), Phi.cols());
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t i = 0; i < patches[p].nodes.size(); ++i)
      mean.middleRows<3>(3 * static_cast<Eigen::Index>(p)) +=
          patches[p].weights[static_cast<Eigen::Index>(i)] *
          Phi.middleRows<3>(3 * patches[p].nodes[i]);
  return mean;
}

}  // namespace limber::flexbody
