// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/contact/patches/patch_cache.hpp"
#include "limber/contact/patches/patch_finder.hpp"
#include "limber/contact/patches/patch_frames.hpp"
#include "limber/contact/patches/series_potential.hpp"

namespace limber::contact {

/// Patches of the convex parts of two bodies, each pair of parts with a
/// potential of its own.
class PartPatches final : public PatchFinder {
 public:
  /// @param modulus E* > 0 [Pa]
  PartPatches(std::vector<PatchPart> parts_A, std::vector<PatchPart> parts_B,
              double modulus);

  [[nodiscard]] std::size_t count() const override {
    return potentials_.size();
  }
  [[nodiscard]] bool is_point() const override;
  [[nodiscard]] double modulus(std::size_t index) const override {
    return potentials_[index].modulus();
  }
  void check(int modes_A, int modes_B) const override;
  [[nodiscard]] PatchTouches find_patches(const joints::PairBodies& bodies,
                                          bool has_derivatives) const override;
  void set_places(const joints::PairBodies& bodies, const PatchTouch& touch,
                  const Vector3& place_W,
                  joints::PairPoint& out) const override;
  [[nodiscard]] Nearest find_nearest(
      const joints::PairBodies& bodies) const override;
  [[nodiscard]] Nearest find_pair(const joints::PairBodies& bodies,
                                  std::size_t index) const override;
  [[nodiscard]] double find_distance(
      const joints::PairBodies& bodies) const override {
    return find_nearest(bodies).gap.distance;
  }

 private:
  [[nodiscard]] SolidGap find_gap(std::size_t index,
                                  const PatchFrames& frames) const;
  [[nodiscard]] Nearest make_nearest(std::size_t index, const SolidGap& gap,
                                     const PatchFrames& frames) const;

  std::vector<PatchPart> parts_A_;
  std::vector<PatchPart> parts_B_;
  std::vector<SeriesPotential> potentials_;  // of all pairs, those of A first
  PatchCache last_patches_;
};

}  // namespace limber::contact
