// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/nodal_pieces.hpp"

#include <algorithm>
#include <limits>

#include "limber/common/index.hpp"
#include "limber/reduction/slices/slice_motion.hpp"

namespace limber::flexbody {
namespace {

/// Planes about a piece, from the centre of mass.
struct Bounds {
  Matrix3X normals;
  VectorX heights;

  // The least distance within them, < 0 beyond one.
  [[nodiscard]] double find_depth(const Vector3& x) const {
    if (heights.size() == 0) return std::numeric_limits<double>::infinity();
    return (heights - normals.transpose() * x).minCoeff();
  }
};

Bounds find_bounds(const ContactPart& part) {
  const Eigen::Index count = part.corners_B.cols();
  Bounds bounds{Matrix3X(3, count), VectorX(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3 from = part.corners_B.col(i);
    const Vector3 edge = Vector3(part.corners_B.col((i + 1) % count)) - from;
    bounds.normals.col(i) = edge.cross(part.normal_B).normalized();
    bounds.heights[i] = bounds.normals.col(i).dot(from);
  }
  return bounds;
}

std::vector<Bounds> list_bounds(const ContactSurface& contact) {
  std::vector<Bounds> all;
  for (const ContactPart& part : contact.parts) {
    all.push_back(find_bounds(part));
  }
  for (const ContactSlice& slice : contact.slices) {
    all.push_back({slice.normals_B, slice.heights});
  }
  return all;
}

NodalPiece make_piece(const SliceMotion& slice, const fem::Mesh& mesh) {
  const auto count = std::ssize(slice.nodes());
  NodalPiece piece{{}, Matrix3X(3, count), MatrixX(6, 3 * count)};
  for (const auto& [node, fraction] : slice.nodes()) {
    const auto i = std::ssize(piece.nodes);
    piece.nodes.push_back(node);
    piece.x_P.col(i) = Vector3(mesh.x.col(node)) - slice.centre();
    piece.motion.middleCols<3>(3 * i) = fraction;
  }
  return piece;
}

}  // namespace

std::vector<NodalPiece> find_nodal_pieces(const fem::Mesh& mesh,
                                          const fem::Surface& surface,
                                          const ContactSurface& contact,
                                          const Vector3& center) {
  const std::vector<Bounds> bounds = list_bounds(contact);
  if (bounds.empty()) return {};
  const std::vector<SurfaceSample> samples = sample_surface(mesh, surface);
  std::vector<std::vector<const SurfaceSample*>> members(bounds.size());
  for (const SurfaceSample& s : samples) {
    const auto in = std::ranges::max_element(bounds, {}, [&](const Bounds& b) {
      return b.find_depth(s.x - center);
    });
    members[index(in - bounds.begin())].push_back(&s);
  }
  std::vector<NodalPiece> pieces;
  for (const auto& of_piece : members) {
    pieces.push_back(make_piece(SliceMotion(of_piece), mesh));
  }
  return pieces;
}

}  // namespace limber::flexbody
