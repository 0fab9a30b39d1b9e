// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "limber/common/errors.hpp"
#include "limber/common/stack_array.hpp"
#include "limber/contact/potential/mesh_parts.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "limber/contact/shapes/shape.hpp"

/// The patches of a pair at one time, without allocation.
namespace limber::contact {

/// Patches of a pair at one time, at most.
inline constexpr std::size_t kMostPatches = kMostSideBySide;

/// A patch of one part of each side.
struct PatchTouch {
  std::size_t index = 0;  ///< of the pair of parts
  joints::PairBody A;     ///< both parts, as bodies without modes
  joints::PairBody B;
  Patch patch;
  SurfacePlace place = {};  ///< of a ball on a flexible surface
};

/// Up to kMostPatches, by their indices.
class PatchTouches {
 public:
  /// @throws NumericalError beyond kMostPatches.
  void add(const PatchTouch& touch) {
    if (size() == kMostPatches) {
      throw NumericalError(
          "contact: too many parts of two shapes are in contact at one time; "
          "use simpler collision shapes");
    }
    all_.add() = touch;
  }
  [[nodiscard]] const PatchTouch* begin() const { return all_.all().data(); }
  [[nodiscard]] const PatchTouch* end() const { return begin() + size(); }
  [[nodiscard]] std::size_t size() const { return all_.all().size(); }
  [[nodiscard]] bool is_empty() const { return size() == 0; }
  /// Or null.
  [[nodiscard]] const PatchTouch* find(std::size_t index) const {
    const PatchTouch* found = std::find_if(
        begin(), end(),
        [index](const PatchTouch& touch) { return touch.index == index; });
    return found == end() ? nullptr : found;
  }

 private:
  StackArray<PatchTouch, kMostPatches> all_;
};

}  // namespace limber::contact
