// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/surface_tree.hpp"

#include <algorithm>
#include <numeric>

namespace limber::contact {
namespace {

using Face = std::array<int, 6>;

// From one value per node, as columns, the value of a face's control point.
template <class Nodes>
auto find_control(const Nodes& nodes, const Face& face, int i) {
  return (i < 3 ? nodes.col(face[index(i)]).eval()
                : (2.0 * nodes.col(face[index(i)]) -
                   0.5 * (nodes.col(face[index(i - 3)]) +
                          nodes.col(face[index((i - 2) % 3)])))
                      .eval());
}

int count_controls(const Face& face) { return face[3] < 0 ? 3 : 6; }

}  // namespace

// Bounds of control points' coordinates, one column per box: X, then each mode.
struct SurfaceTree::Controls {
  const std::vector<Face>& faces;
  const Matrix3X& X;
  MatrixX rows;  // 3m x n: all modes' motions of a node in its column
};

SurfaceTree::SurfaceTree(const std::vector<Face>& faces, const Matrix3X& X,
                         const MatrixX& Phi) {
  order_.resize(faces.size());
  std::iota(order_.begin(), order_.end(), 0);
  Matrix3X centres(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    centres.col(static_cast<Eigen::Index>(f)) =
        (X.col(face[0]) + X.col(face[1]) + X.col(face[2])) / 3.0;
  }
  build(centres, 0, static_cast<int>(faces.size()));
  Controls controls{faces, X, MatrixX(3 * Phi.cols(), X.cols())};
  for (Eigen::Index n = 0; n < X.cols(); ++n) {
    // Column-major of m x 3: the modes of an axis are adjacent.
    Eigen::Map<MatrixX>(controls.rows.col(n).data(), Phi.cols(), 3) =
        Phi.middleRows(3 * n, 3).transpose();
  }
  set_bounds(controls);
}

int SurfaceTree::build(const Matrix3X& centres, int first, int count) {
  const int me = static_cast<int>(nodes_.size());
  nodes_.push_back({.first = first, .count = count});
  if (count <= kLeafFaces) return me;
  const auto begin = order_.begin() + first;
  Vector3 low = centres.col(*begin);
  Vector3 high = low;
  for (auto face = begin; face != begin + count; ++face) {
    low = low.cwiseMin(centres.col(*face));
    high = high.cwiseMax(centres.col(*face));
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](int a, int b) {
    const double at_a = centres(axis, a);
    const double at_b = centres(axis, b);
    return at_a < at_b || (at_a == at_b && a < b);
  });
  build(centres, first, half);
  const int right = build(centres, first + half, count - half);
  nodes_[index(me)].right = right;
  return me;
}

void SurfaceTree::set_bounds(const Controls& controls) {
  const auto size = static_cast<Eigen::Index>(nodes_.size());
  const Eigen::Index modes = controls.rows.rows();
  Matrix3X low_X(3, size);
  Matrix3X high_X(3, size);
  MatrixX low(modes, size);
  MatrixX high(modes, size);
  for (Eigen::Index i = size - 1; i >= 0; --i) {  // children before parents
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    if (!node.is_leaf()) {
      const Eigen::Index left = i + 1;
      low_X.col(i) = low_X.col(left).cwiseMin(low_X.col(node.right));
      high_X.col(i) = high_X.col(left).cwiseMax(high_X.col(node.right));
      low.col(i) = low.col(left).cwiseMin(low.col(node.right));
      high.col(i) = high.col(left).cwiseMax(high.col(node.right));
      continue;
    }
    const int any = controls.faces[index(find_faces(node)[0])][0];
    low_X.col(i) = high_X.col(i) = controls.X.col(any);
    low.col(i) = high.col(i) = controls.rows.col(any);
    for (const int f : find_faces(node)) {
      const Face& face = controls.faces[index(f)];
      for (int k = 0; k < count_controls(face); ++k) {
        const Vector3 x = find_control(controls.X, face, k);
        low_X.col(i) = low_X.col(i).cwiseMin(x);
        high_X.col(i) = high_X.col(i).cwiseMax(x);
        const VectorX phi = find_control(controls.rows, face, k);
        low.col(i) = low.col(i).cwiseMin(phi);
        high.col(i) = high.col(i).cwiseMax(phi);
      }
    }
  }
  boxes_.resize(nodes_.size());
  for (Eigen::Index i = 0; i < size; ++i) {
    boxes_[static_cast<std::size_t>(i)] = {
        0.5 * (low_X.col(i) + high_X.col(i)),
        0.5 * (high_X.col(i) - low_X.col(i))};
  }
  centres_.resize(modes / 3, 3 * size);
  halves_.resize(modes / 3, 3 * size);
  // The same numbers in the same order, another shape.
  centres_.reshaped() = (0.5 * (low + high)).reshaped();
  halves_.reshaped() = (0.5 * (high - low)).reshaped();
}

SurfaceTree::Box SurfaceTree::find_box(int i, const ModalView& eta) const {
  // Round-off of sums must not move a face out of its box.
  constexpr double kMargin = 1e-12;
  Box box = boxes_[index(i)];
  if (spread_ > 0.0) box.half.array() += spread_ * eta[eta.size() - 1];
  for (int axis = 0; axis < 3 && spread_ == 0.0; ++axis) {
    const Eigen::Index column = 3 * Eigen::Index{i} + axis;
    box.centre[axis] += centres_.col(column).dot(eta);
    box.half[axis] += halves_.col(column).dot(eta.cwiseAbs());
  }
  box.half.array() += kMargin * (box.half.sum() + box.centre.cwiseAbs().sum());
  return box;
}

}  // namespace limber::contact
