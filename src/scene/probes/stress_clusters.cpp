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

// w of a stress: its norm is the von Mises stress.
Vector6 to_mises(const Vector6& s) {
  Vector6 w;
  w << s[0] - s[1], s[1] - s[2], s[2] - s[0], 0.0, 0.0, 0.0;
  w.head<3>() *= std::sqrt(0.5);
  w.tail<3>() = std::sqrt(3.0) * s.tail<3>();
  return w;
}

}  // namespace

StressClusters::StressClusters(const Matrix3X& p_L, const MatrixX& Sigma_L)
    : order_(static_cast<std::size_t>(p_L.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
  split(order_.begin(), order_.end(), p_L);
  const Eigen::Index m = Sigma_L.cols();
  const auto count = static_cast<Eigen::Index>(ends_.size());
  centers_.setZero(6 * count, m);
  radii_.setZero(count, m);
  int first = 0;
  for (Eigen::Index c = 0; c < count; ++c) {
    const int end = ends_[static_cast<std::size_t>(c)];
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto w_of = [&](int i) {
        const Eigen::Index point = order_[index(i)];
        return to_mises(Sigma_L.block<6, 1>(6 * point, k));
      };
      Vector6 center = Vector6::Zero();
      for (int i = first; i < end; ++i) center += w_of(i) / (end - first);
      centers_.block<6, 1>(6 * c, k) = center;
      for (int i = first; i < end; ++i) {
        radii_(c, k) = std::max(radii_(c, k), (w_of(i) - center).norm());
      }
    }
    first = end;
  }
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

StressClusters::Largest StressClusters::find(
    const MatrixX& Sigma_L, const Eigen::Ref<const VectorX>& eta) const {
  Scratch& s = scratch_;
  s.magnitudes = eta.cwiseAbs();
  s.centers.resize(centers_.rows());
  s.centers.noalias() = centers_ * eta;
  s.bounds.resize(radii_.rows());
  s.bounds.noalias() = radii_ * s.magnitudes;
  s.bounds += s.centers.reshaped(6, radii_.rows()).colwise().norm().transpose();
  if (!s.bounds.allFinite()) {  // a run that diverges
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {0, kNone, Vector6::Constant(kNone)};
  }
  s.next.resize(ends_.size());
  std::iota(s.next.begin(), s.next.end(), 0);
  std::sort(s.next.begin(), s.next.end(),
            [&](int a, int b) { return s.bounds[a] > s.bounds[b]; });
  s.stress.resize(6 * kMostPoints);
  // The bounds' own round-off.
  constexpr double kRoundOff = 1e-12;
  Largest largest;
  for (const int c : s.next) {
    if (s.bounds[c] * (1.0 + kRoundOff) < largest.von_mises) break;
    const int first = c == 0 ? 0 : ends_[index(c - 1)];
    const int count = ends_[index(c)] - first;
    s.stress.head(6 * count).noalias() =
        Sigma_L.middleRows(6 * first, 6 * count) * eta;
    for (int i = 0; i < count; ++i) {
      const Vector6 stress = s.stress.segment<6>(6 * i);
      const double value = flexbody::calc_von_mises(stress);
      if (value > largest.von_mises) largest = {first + i, value, stress};
    }
  }
  return largest;
}

}  // namespace limber::scene
