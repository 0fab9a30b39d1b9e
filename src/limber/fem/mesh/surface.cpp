// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/surface.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace limber::fem {
namespace {

std::vector<int> sorted_corners(const int* nodes, std::size_t count) {
  std::vector<int> corners(nodes, nodes + count);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Index of the face's node at `place`, -1 if there is none.
Eigen::Index find_node_at(const FaceShape& shape,
                          const Eigen::Vector2d& place) {
  constexpr double kSame = 1e-6;
  for (Eigen::Index k = 0; k < shape.places().cols(); ++k)
    if ((shape.places().col(k) - place).norm() < kSame) return k;
  return -1;
}

class SurfaceMaker {
 public:
  explicit SurfaceMaker(const Mesh& mesh) : mesh_(mesh) {}

  Surface make(const std::vector<BoundaryFace>& faces) {
    for (const BoundaryFace& face : faces) add_face(face);
    add_corners();
    for (SurfaceFace& face : surface_.faces) add_triangles(face);
    return std::move(surface_);
  }

 private:
  void add_face(const BoundaryFace& face) {
    const auto [at, is_new] =
        shape_of_.try_emplace({face.block, face.face}, surface_.shapes.size());
    if (is_new)
      surface_.shapes.emplace_back(
          *mesh_.blocks[static_cast<std::size_t>(face.block)].element,
          static_cast<std::size_t>(face.face));
    surface_.faces.push_back({at->second, face_nodes(mesh_, face), {}});
  }

  void add_corners() {
    for (const SurfaceFace& face : surface_.faces)
      for (int k = 0; k < surface_.shapes[face.shape].corner_count(); ++k)
        point_of_[face.nodes[static_cast<std::size_t>(k)]] = -1;
    for (auto& [node, point] : point_of_) {
      point = static_cast<int>(surface_.points.size());
      surface_.points.push_back({mesh_.x.col(node), node});
    }
  }

  void add_triangles(SurfaceFace& face) {
    const int corners = surface_.shapes[face.shape].corner_count();
    for (int k = 0; k < corners; ++k)
      face.points.push_back(
          point_of_.at(face.nodes[static_cast<std::size_t>(k)]));
    add_triangle(face, {0, 1, 2});
    if (corners == 4) add_triangle(face, {0, 2, 3});
  }

  void add_triangle(SurfaceFace& face, const std::array<int, 3>& corners) {
    std::array<int, 6> triangle = {-1, -1, -1, -1, -1, -1};
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = face.points[static_cast<std::size_t>(corners[k])];
    if (surface_.shapes[face.shape].order() > 1)
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[3 + k] = find_middle(face, corners[k], corners[(k + 1) % 3]);
        if (std::find(face.points.begin(), face.points.end(),
                      triangle[3 + k]) == face.points.end())
          face.points.push_back(triangle[3 + k]);
      }
    surface_.triangles.push_back(triangle);
  }

  /// The point between two corners of a face.
  int find_middle(const SurfaceFace& face, int a, int b) {
    const FaceShape& shape = surface_.shapes[face.shape];
    std::array<int, 2> ends = {face.points[static_cast<std::size_t>(a)],
                               face.points[static_cast<std::size_t>(b)]};
    std::sort(ends.begin(), ends.end());
    const auto [at, is_new] =
        middle_of_.try_emplace(ends, static_cast<int>(surface_.points.size()));
    if (!is_new) return at->second;
    const Eigen::Vector2d place =
        0.5 * (shape.places().col(a) + shape.places().col(b));
    const Eigen::Index k = find_node_at(shape, place);
    const int node = k < 0 ? -1 : face.nodes[static_cast<std::size_t>(k)];
    const Vector3 x =
        Matrix3X(mesh_.x(Eigen::all, face.nodes)) * shape.tabulate(place).shape;
    surface_.points.push_back({x, node, ends});
    return at->second;
  }

  const Mesh& mesh_;
  Surface surface_;
  std::map<std::pair<int, int>, std::size_t> shape_of_;
  std::map<int, int> point_of_;  // by node
  std::map<std::array<int, 2>, int> middle_of_;
};

}  // namespace

Surface make_surface(const Mesh& mesh, const std::vector<BoundaryFace>& faces) {
  return SurfaceMaker(mesh).make(faces);
}

std::vector<BoundaryFace> find_group_faces(const Mesh& mesh,
                                           const PhysicalGroup& group) {
  std::set<std::vector<int>> in_group;
  for (const ElementBlock& block : group.blocks)
    for (std::size_t e = 0; block.element->dimension == 2 && e < block.size();
         ++e)
      in_group.insert(sorted_corners(
          block.element_nodes(e),
          static_cast<std::size_t>(block.element->corner_count)));
  std::vector<BoundaryFace> found;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const ReferenceElement& element =
        *mesh.blocks[static_cast<std::size_t>(face.block)].element;
    const auto corners = static_cast<std::size_t>(
        element.face_corners[static_cast<std::size_t>(face.face)]);
    if (in_group.contains(
            sorted_corners(face_nodes(mesh, face).data(), corners)))
      found.push_back(face);
  }
  return found;
}

}  // namespace limber::fem
