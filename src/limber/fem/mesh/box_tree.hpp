// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace limber::fem {

/// Finds those of many axis-aligned boxes that intersect another one.
///
/// Source     bounding volume hierarchy, split at the median of centres
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  explicit BoxTree(std::vector<Box> boxes);

  /// Indices, ascending.
  [[nodiscard]] std::vector<int> find(const Box& box) const;

 private:
  struct Node {
    Box box;
    int begin = 0;  ///< range of order_
    int end = 0;
    int left = -1;  ///< index of a node; -1: a leaf
    int right = -1;
  };
  int add_node(int begin, int end);

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace limber::fem
