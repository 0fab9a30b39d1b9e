// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/displacement_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

// Largest number of nodes in a smallest box: with more, too many are evaluated;
// with fewer, the bounds cost more than they save.
constexpr int kLeaf = 8;

}  // namespace

DisplacementTree::DisplacementTree(const Matrix3X& x, const MatrixX& Phi)
    : rows_(Phi.cols(), Phi.rows()) {
  LIMBER_EXPECT(Phi.rows() == 3 * x.cols());
  if (x.cols() == 0) return;
  std::vector<int> nodes(static_cast<std::size_t>(x.cols()));
  std::iota(nodes.begin(), nodes.end(), 0);
  add_box(x, Phi, nodes, 0, static_cast<int>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    rows_.middleCols<3>(3 * static_cast<Eigen::Index>(i)) =
        Phi.middleRows<3>(Eigen::Index{3} * nodes[i]).transpose();
  }
}

// A box of nodes [first, first + count), halved along its longest edge.
int DisplacementTree::add_box(const Matrix3X& x, const MatrixX& Phi,
                              std::vector<int>& nodes, int first, int count) {
  const auto begin = nodes.begin() + first;
  const auto end = begin + count;
  MatrixX mean = MatrixX::Zero(3, Phi.cols());
  Vector3 lower = x.col(*begin);
  Vector3 upper = lower;
  for (auto n = begin; n != end; ++n) {
    mean += Phi.middleRows<3>(Eigen::Index{3} * *n) / count;
    lower = lower.cwiseMin(x.col(*n));
    upper = upper.cwiseMax(x.col(*n));
  }
  VectorX radii = VectorX::Zero(Phi.cols());
  for (auto n = begin; n != end; ++n) {
    const MatrixX away = Phi.middleRows<3>(Eigen::Index{3} * *n) - mean;
    radii = radii.cwiseMax(away.colwise().norm().transpose());
  }
  const int box = static_cast<int>(boxes_.size());
  boxes_.push_back({first, count});
  bounds_.emplace_back(Phi.cols(), 4);
  bounds_.back() << mean.transpose(), radii;
  if (count <= kLeaf) return box;
  Eigen::Index longest = 0;
  (upper - lower).maxCoeff(&longest);
  const int half = count / 2;
  std::nth_element(begin, begin + half, end, [&](int a, int b) {
    return x(longest, a) < x(longest, b) ||
           (x(longest, a) == x(longest, b) && a < b);
  });
  const int left = add_box(x, Phi, nodes, first, half);
  const int right = add_box(x, Phi, nodes, first + half, count - half);
  boxes_[index(box)].left = left;
  boxes_[index(box)].right = right;
  return box;
}

double DisplacementTree::find_bound(int box, const VectorX& eta) const {
  constexpr double kRoundOff = 1e-12;
  const auto& bound = bounds_[index(box)];
  const Eigen::Index m = eta.size();
  const double* at = bound.data();
  std::array<double, 4> sum{};
  for (Eigen::Index k = 0; k < m; ++k, ++at) {
    sum[0] += at[0] * eta[k];
    sum[1] += at[m] * eta[k];
    sum[2] += at[2 * m] * eta[k];
    sum[3] += at[3 * m] * std::abs(eta[k]);
  }
  const double middle =
      std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  return (1.0 + kRoundOff) * (middle + sum[3]);
}

void DisplacementTree::search_leaf(int box, const VectorX& eta,
                                   Found& found) const {
  const Box& here = boxes_[index(box)];
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * kLeaf, 1> u(3 * here.count);
  u.noalias() =
      rows_.middleCols(Eigen::Index{3} * here.first, u.size()).transpose() *
      eta;
  for (Eigen::Index i = 0; i < u.size(); i += 3) {
    const double length = u.segment<3>(i).norm();
    if (length > found.largest) found = {length, box};
  }
}

// All leaves below a box but the one that was searched before.
void DisplacementTree::search(int box, const VectorX& eta, int searched,
                              Found& found) const {
  const Box& here = boxes_[index(box)];
  if (here.left < 0) {
    if (box != searched) search_leaf(box, eta, found);
    return;
  }
  struct Child {
    int box;
    double bound;
  };
  Child near{here.left, find_bound(here.left, eta)};
  Child far{here.right, find_bound(here.right, eta)};
  if (near.bound < far.bound) std::swap(near, far);
  for (const Child& child : {near, far}) {
    if (child.bound <= found.largest) break;
    search(child.box, eta, searched, found);
  }
}

double DisplacementTree::find_largest(const VectorX& eta, double least,
                                      int& leaf) const {
  if (boxes_.empty() || eta.size() == 0) return least;
  Found found{least, leaf};
  const int first = leaf;
  if (first >= 0) search_leaf(first, eta, found);
  search(0, eta, first, found);
  leaf = found.leaf;
  return found.largest;
}

}  // namespace limber::dynamics
