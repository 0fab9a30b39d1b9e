// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "limber/common/index.hpp"

namespace limber::fem {

BoxTree::BoxTree(std::vector<Box> boxes)
    : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty()) add_node(0, static_cast<int>(boxes_.size()));
}

int BoxTree::add_node(int begin, int end) {
  constexpr int kLeaf = 4;
  Node node{{}, begin, end};
  for (int i = begin; i < end; ++i)
    node.box.extend(boxes_[index(order_[index(i)])]);
  const int at = static_cast<int>(nodes_.size());
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return at;
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle,
                   order_.begin() + end, [&](int a, int b) {
                     return boxes_[index(a)].center()[axis] <
                            boxes_[index(b)].center()[axis];
                   });
  const int left = add_node(begin, middle);
  const int right = add_node(middle, end);
  nodes_[index(at)].left = left;
  nodes_[index(at)].right = right;
  return at;
}

std::vector<int> BoxTree::find(const Box& box) const {
  std::vector<int> found;
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[index(open.back())];
    open.pop_back();
    if (!node.box.intersects(box)) continue;
    if (node.left >= 0) {
      open.insert(open.end(), {node.left, node.right});
      continue;
    }
    for (int i = node.begin; i < node.end; ++i)
      if (boxes_[index(order_[index(i)])].intersects(box))
        found.push_back(order_[index(i)]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace limber::fem
