// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/group_lengths.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
GroupLengths::GroupLengths(const SystemModel& model, const SystemState& start)
    : group_of_row_(static_cast<std::size_t>(count_unknowns(model)), 0),
      weights_(find_length_weights(model)) {
  const auto groups = find_linked_groups(model);
  extents_.resize(std::ssize(groups));
  masses_.resize(std::ssize(groups));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto place = static_cast<Eigen::Index>(g);
    const GroupExtent extent = find_group_extent(model, start, groups[g]);
    extents_[place] = extent.reach;
    masses_[place] = extent.mass;
    for (const BodyIndex b : groups[g]) include_body(model, b, g);
  }
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const Eigen::Index g = group_of_row_[static_cast<std::size_t>(i)];
    weights_[i] /= std::sqrt(masses_[g]);
  }
}

void GroupLengths::include_body(const SystemModel& model, BodyIndex b,
                                std::size_t group) {
  for (const UnknownRange& range : list_unknowns(model, index(b))) {
    std::fill_n(group_of_row_.begin() + range.row, range.size,
                static_cast<Eigen::Index>(group));
  }
}

VectorX GroupLengths::sum_squares(const VectorX& weighted) const {
  VectorX sums = VectorX::Zero(extents_.size());
  for (Eigen::Index i = 0; i < weighted.size(); ++i) {
    sums[group_of_row_[static_cast<std::size_t>(i)]] +=
        weighted[i] * weighted[i];
  }
  return sums;
}

double GroupLengths::measure(const VectorX& increments) const {
  const VectorX squares = sum_squares(increments.cwiseProduct(weights_));
  // NaN counts as the largest.
  return squares.cwiseSqrt()
      .cwiseQuotient(extents_)
      .maxCoeff<Eigen::PropagateNaN>();
}

double GroupLengths::measure_length(const VectorX& increments) const {
  const VectorX squares = sum_squares(increments.cwiseProduct(weights_));
  return std::sqrt(squares.maxCoeff());
}

double GroupLengths::largest_extent() const { return extents_.maxCoeff(); }

// m r / m for translations, m r / (m r^2) for rotations, sqrt(m) r for modes,
// each times its weight: equal to r over weight.
VectorX GroupLengths::measure_forces(const VectorX& residual) const {
  const VectorX over =
      (weights_.array() > 0.0).select(residual.cwiseQuotient(weights_), 0.0);
  return sum_squares(over).cwiseSqrt();
}

double GroupLengths::measure_acceleration(const VectorX& residual) const {
  return measure_forces(residual)
      .cwiseQuotient(masses_)
      .cwiseQuotient(extents_)
      .maxCoeff();
}

}  // namespace limber::dynamics
