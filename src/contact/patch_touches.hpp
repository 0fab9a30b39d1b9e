// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "limber/contact/potential/pair_potential.hpp"

/// The patches of a pair at one time, without allocation.
namespace limber::contact {

/// Patches of a pair at one time, at most.
inline constexpr std::size_t kMostPatches = 16;

/// A patch of one part of each side.
struct PatchTouch {
  std::size_t index = 0;  ///< of the pair of parts
  joints::PairBody A;     ///< both parts, as bodies without modes
  joints::PairBody B;
  Patch patch;
};

/// Up to kMostPatches, those of the largest energies, by their indices.
class PatchTouches {
 public:
  void add(const PatchTouch& touch) {
    if (count_ < all_.size()) {
      all_[count_++] = touch;
      return;
    }
    const auto least = std::min_element(
        all_.begin(), all_.end(), [](const PatchTouch& a, const PatchTouch& b) {
          return a.patch.energy < b.patch.energy;
        });
    if (!(touch.patch.energy > least->patch.energy)) return;
    std::move(least + 1, all_.end(), least);
    all_.back() = touch;
  }
  [[nodiscard]] const PatchTouch* begin() const { return all_.data(); }
  [[nodiscard]] const PatchTouch* end() const { return all_.data() + count_; }
  [[nodiscard]] bool is_empty() const { return count_ == 0; }
  /// Or null.
  [[nodiscard]] const PatchTouch* find(std::size_t index) const {
    const PatchTouch* found = std::find_if(
        begin(), end(),
        [index](const PatchTouch& touch) { return touch.index == index; });
    return found == end() ? nullptr : found;
  }

 private:
  std::array<PatchTouch, kMostPatches> all_;
  std::size_t count_ = 0;
};

}  // namespace limber::contact
