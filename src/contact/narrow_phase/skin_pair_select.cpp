// SPDX-License-Identifier: BSD-3-Clause Selection by
// SkinPairSearch of the features found: deep and distinct
// ones.
#include <algorithm>
#include <cmath>

#include "limber/contact/narrow_phase/skin_pair_search.hpp"

namespace limber::contact {
namespace {}  // namespace

// Radius of the area around a feature in which both overlap, slightly enlarged;
// flat parts count as round as the whole.
double SkinPairSearch::find_radius(const Feature& feature) const {
  constexpr double kLarger = 1.2;
  constexpr double kLeast = 0.25;  // of an edge
  const double size = std::min(A_.skin.find_ball(A_.eta).radius,
                               B_.skin.find_ball(B_.eta).radius);
  const double curvature = std::max(feature.curvature, 1.0 / size);
  const double depth = std::max(feature.at.depth, 0.0);
  return std::max(kLarger * std::sqrt(2.0 * depth / curvature), kLeast * edge_);
}

// A node within a flat part, or a place along an edge, has no share unless it
// is deeper than the corners of these.
double SkinPairSearch::find_share(const Feature& feature) const {
  constexpr double kSameSide = 0.94;  // cosine of 20 degrees
  // Excess over the depth from which on it counts, and counts fully [-].
  constexpr double kDeeper = 0.3;
  constexpr double kMuchDeeper = 0.6;
  if (feature.is_outer) return 1.0;
  const double depth = feature.at.depth;
  double outer = -kInfinity;
  for (std::size_t i = 0; i < count_; ++i) {
    if (features_[i].is_outer &&
        features_[i].at.normal.dot(feature.at.normal) > kSameSide) {
      outer = std::max(outer, features_[i].at.depth);
    }
  }
  const double deeper = depth - outer - kNoDepth * edge_;
  if (!(deeper > 0.0)) return 0.0;
  if (!(depth > 0.0)) return 1.0;
  return std::clamp((deeper / depth - kDeeper) / (kMuchDeeper - kDeeper), 0.0,
                    1.0);
}

std::size_t SkinPairSearch::select(std::span<Feature> out) const {
  constexpr double kWider = 1.5;
  constexpr double kNoShare = 1e-6;
  // Of equally deep features the outer ones come first.
  constexpr double kOuter = 1e-3;
  Vector3 centre = Vector3::Zero();
  for (std::size_t i = 0; i < count_; ++i) centre += features_[i].middle;
  centre /= std::max<double>(1.0, static_cast<double>(count_));
  double extent = edge_;
  for (std::size_t i = 0; i < count_; ++i) {
    extent = std::max(extent, (features_[i].middle - centre).norm());
  }
  std::array<double, kMostFeatures> shares;
  std::array<double, kMostFeatures> room;  // from those taken, of the extent
  std::array<bool, kMostFeatures> is_left;
  for (std::size_t i = 0; i < count_; ++i) {
    shares[i] = find_share(features_[i]);
    room[i] = (features_[i].middle - centre).norm() / extent;
    is_left[i] = true;
  }
  std::size_t taken = 0;
  while (taken < out.size()) {
    std::size_t best = count_;
    double highest = -kInfinity;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!is_left[i] || shares[i] < kNoShare) continue;
      const double depth = features_[i].at.depth;
      const double score = depth + kOuter * std::abs(depth) * room[i];
      if (!(score > highest)) continue;
      highest = score;
      best = i;
    }
    if (best == count_) break;
    if (!is_genuine(features_[best])) {
      is_left[best] = false;
      continue;
    }
    out[taken] = features_[best];
    const double share = out[taken].share = shares[best];
    ++taken;
    is_left[best] = false;
    const double radius = find_radius(features_[best]);
    for (std::size_t i = 0; i < count_; ++i) {
      const double far = (features_[i].middle - features_[best].middle).norm();
      room[i] = taken == 1 ? far / extent : std::min(room[i], far / extent);
      const double free =
          std::clamp((far / radius - 1.0) / (kWider - 1.0), 0.0, 1.0);
      shares[i] *= 1.0 - share * (1.0 - free);
    }
  }
  if (taken == 0 && deepest() > -kInfinity && !out.empty()) {
    out[taken++] = deepest_;
  }
  return taken;
}

}  // namespace limber::contact
