// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_patches.hpp"

#include <algorithm>
#include <cmath>
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
      std::map<int, double> shares;
      for (const int face : faces)
        add_shares(surface_.faces[index(face)], {x, normal, radius, least},
                   shares);
      if (!shares.empty()) return normalise(shares, normal, radius);
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

  void add_shares(const fem::SurfaceFace& face, const Place& place,
                  std::map<int, double>& shares) {
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
    const VectorX share = rule.shape * pressure;
    for (std::size_t k = 0; k < face.nodes.size(); ++k)
      shares[face.nodes[k]] += share[static_cast<Eigen::Index>(k)];
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

  static ContactPatch normalise(const std::map<int, double>& shares,
                                const Vector3& normal, double radius) {
    ContactPatch patch{
        normal, radius, {}, VectorX(static_cast<Eigen::Index>(shares.size()))};
    for (const auto& [node, share] : shares) {
      patch.weights[static_cast<Eigen::Index>(patch.nodes.size())] = share;
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

}  // namespace

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
