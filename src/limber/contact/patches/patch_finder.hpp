// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "limber/contact/patches/patch_touches.hpp"
#include "limber/contact/patches/solid_gap.hpp"

namespace limber::contact {

/// Where two bodies are in contact: the patches of a pair, and the parts that
/// carry them.
class PatchFinder {
 public:
  PatchFinder() = default;
  PatchFinder(const PatchFinder&) = delete;
  PatchFinder& operator=(const PatchFinder&) = delete;
  virtual ~PatchFinder() = default;

  /// Of pairs of parts, of which each may have a patch.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Whether all of them touch at points, as HertzPair.
  [[nodiscard]] virtual bool is_point() const = 0;
  /// E* of a pair of parts [Pa].
  [[nodiscard]] virtual double modulus(std::size_t index) const = 0;
  /// @throws InputError unless it fits bodies of so many modes.
  virtual void check(int modes_A, int modes_B) const = 0;

  /// @param has_derivatives false: hessian_W may be zero. Where the next step
  /// asks for derivatives at the same state, others do too, so that patches are
  /// found once
  [[nodiscard]] virtual PatchTouches find_patches(
      const joints::PairBodies& bodies, bool has_derivatives) const = 0;
  /// The material points of both bodies at a place of the world.
  virtual void set_places(const joints::PairBodies& bodies,
                          const PatchTouch& touch, const Vector3& place_W,
                          joints::PairPoint& out) const = 0;

  struct Nearest {
    std::size_t index = 0;  ///< of the pair of parts
    SolidGap gap;
    joints::PairBody A;  ///< both parts, as bodies without modes
    joints::PairBody B;
  };
  /// The parts that are nearest to each other.
  [[nodiscard]] virtual Nearest find_nearest(
      const joints::PairBodies& bodies) const = 0;
  /// The frames and the gap of one pair of parts.
  [[nodiscard]] virtual Nearest find_pair(const joints::PairBodies& bodies,
                                          std::size_t index) const = 0;
  /// A lower bound of the distance; <= 0 where they touch [m].
  [[nodiscard]] virtual double find_distance(
      const joints::PairBodies& bodies) const = 0;
};

}  // namespace limber::contact
