// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "limber/common/index.hpp"
#include "limber/flexbody/model/stress_modes.hpp"

namespace limber::scene {
namespace {

constexpr std::ptrdiff_t kMostPoints = 24;  // of a cluster

}  // namespace

StressClusters::StressClusters(const Matrix3X& p_L, const MatrixX& Sigma_L)
    : order_(static_cast<std::size_t>(p_L.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
  split(order_.begin(), order_.end(), p_L);
  const Eigen::Index m = Sigma_L.cols();
  const auto count = static_cast<Eigen::Index>(ends_.size());
  radii_.setZero(count, m);
  int first = 0;
  for (Eigen::Index c = 0; c < count; ++c) {
    const int end = ends_[static_cast<std::size_t>(c)];
    for (int i = first; i < end; ++i) {
      const Eigen::Index point = order_[index(i)];
      for (Eigen::Index k = 0; k < m; ++k) {
        const Vector6 stress = Sigma_L.block<6, 1>(6 * point, k);
        radii_(c, k) = std::max(radii_(c, k), flexbody::calc_von_mises(stress));
      }
    }
    first = end;
  }
  widest_ = radii_.colwise().maxCoeff();
}

// Halves along the longest edge of the bounding box.
void StressClusters::split(std::vector<int>::iterator first,
                           std::vector<int>::iterator last,
                           const Matrix3X& p_L) {
  if (last - first <= kMostPoints) {
    ends_.push_back(static_cast<int>(last - order_.begin()));
    return;
  }
  Vector3 lower = p_L.col(*first);
  Vector3 upper = lower;
  for (auto i = first; i != last; ++i) {
    lower = lower.cwiseMin(p_L.col(*i));
    upper = upper.cwiseMax(p_L.col(*i));
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last,
                   [&](int a, int b) { return p_L(axis, a) < p_L(axis, b); });
  split(first, middle, p_L);
  split(middle, last, p_L);
}

void StressClusters::calc_bounds(const Eigen::Ref<const VectorX>& eta) const {
  Scratch& s = scratch_;
  if (s.references.size() == 0) {
    s.references.setZero(radii_.rows(), radii_.cols());
    s.largest.setZero(radii_.rows());
    s.stress.resize(6 * kMostPoints);
    s.next.reserve(ends_.size());
  }
  s.bounds = s.largest;
  for (Eigen::Index k = 0; k < eta.size(); ++k) {
    s.bounds.array() +=
        radii_.col(k).array() * (s.references.col(k).array() - eta[k]).abs();
  }
}

void StressClusters::evaluate(int cluster, const MatrixX& Sigma_L,
                              const Eigen::Ref<const VectorX>& eta,
                              Largest& found) const {
  Scratch& s = scratch_;
  const int first = cluster == 0 ? 0 : ends_[index(cluster - 1)];
  const int count = ends_[index(cluster)] - first;
  s.stress.head(6 * count).noalias() =
      Sigma_L.middleRows(6 * first, 6 * count) * eta;
  double largest = 0.0;
  for (int i = 0; i < count; ++i) {
    const Vector6 stress = s.stress.segment<6>(6 * Eigen::Index{i});
    const double value = flexbody::calc_von_mises(stress);
    largest = std::max(largest, value);
    const bool is_first = first + i < found.point;
    if (value > found.von_mises || (value == found.von_mises && is_first)) {
      found = {first + i, value, stress};
      s.last = cluster;
    }
  }
  s.references.row(cluster) = eta.transpose();
  s.largest[cluster] = largest;
}

StressClusters::Largest StressClusters::find(
    const MatrixX& Sigma_L, const Eigen::Ref<const VectorX>& eta) const {
  Scratch& s = scratch_;
  calc_bounds(eta);
  if (!s.bounds.allFinite()) {  // a run that diverges
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {0, kNone, Vector6::Constant(kNone)};
  }
  // Round-off of a stress in which modes cancel.
  constexpr double kRoundOff = 1e-13;
  const double slack = kRoundOff * widest_.dot(eta.cwiseAbs());
  Largest found;
  const int begin = s.last;
  evaluate(begin, Sigma_L, eta, found);
  s.next.clear();
  for (int c = 0; c < static_cast<int>(ends_.size()); ++c) {
    if (c != begin && s.bounds[c] + slack >= found.von_mises) {
      s.next.push_back(c);
    }
  }
  std::sort(s.next.begin(), s.next.end(),
            [&](int a, int b) { return s.bounds[a] > s.bounds[b]; });
  for (const int c : s.next) {
    if (s.bounds[c] + slack < found.von_mises) break;
    evaluate(c, Sigma_L, eta, found);
  }
  return found;
}

}  // namespace limber::scene
