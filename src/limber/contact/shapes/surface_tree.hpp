// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/common/types.hpp"

namespace limber::contact {

/// View of a body's modal coordinates [kg^1/2 m].
using ModalView = Eigen::Map<const VectorX>;

/// Boxes around the faces of a surface that contain them in any deformation.
///
/// Equation   a face is within the hull of its control points X + Phi eta (of
///            Bezier: a middle node's is 2 X_m - (X_1 + X_2)/2), so along each
///            axis all faces of a node of the tree are within
///            [min X, max X] + c . eta +- h . |eta|, where c +- h are the
///            bounds of each mode's Phi over the node's control points
/// Source     [@james2004], of boxes in place of spheres
class SurfaceTree {
 public:
  struct Box {
    Vector3 centre = Vector3::Zero();  ///< [m]
    Vector3 half = Vector3::Zero();    ///< [m]

    [[nodiscard]] double find_square_distance(const Vector3& p) const {
      return ((p - centre).cwiseAbs() - half).cwiseMax(0.0).squaredNorm();
    }
  };
  struct Node {
    int first = 0;   ///< of its faces in order()
    int count = 0;   ///< of its faces
    int right = -1;  ///< child; the left one is the next node; -1: a leaf
    [[nodiscard]] bool is_leaf() const { return right < 0; }
  };
  /// Deepest nesting: the tree is balanced.
  static constexpr int kMostLevels = 64;

  /// Faces of a leaf, at most.
  static constexpr int kLeafFaces = 2;

  SurfaceTree() = default;
  /// @param faces rows of nodes as those of flexbody::ContactSurface, not none
  /// @param X 3 x n [m]
  /// @param Phi 3n x m [kg^-1/2]
  SurfaceTree(const std::vector<std::array<int, 6>>& faces, const Matrix3X& X,
              const MatrixX& Phi);

  /// For an eta of displacements whose last entry is their largest magnitude:
  /// enlarges the boxes by `spread` times that [-].
  void set_spread(double spread) { spread_ = spread; }

  /// The root is node 0.
  [[nodiscard]] const Node& node(int i) const { return nodes_[index(i)]; }
  [[nodiscard]] std::span<const int> find_faces(const Node& node) const {
    return std::span(order_).subspan(index(node.first), index(node.count));
  }
  /// Box of node i of the deformed surface.
  [[nodiscard]] Box find_box(int i, const ModalView& eta) const;

 private:
  struct Controls;
  int build(const Matrix3X& centres, int first, int count);
  void set_bounds(const Controls& controls);

  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<Box> boxes_;  // undeformed
  MatrixX centres_;         // m x 3 nodes: c of each axis
  MatrixX halves_;          // m x 3 nodes: h
  double spread_ = 0.0;     // > 0: see set_spread
};

}  // namespace limber::contact
