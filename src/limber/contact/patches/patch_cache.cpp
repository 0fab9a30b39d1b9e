// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_cache.hpp"

#include <algorithm>
#include <bit>

namespace limber::contact {

PatchCache::PatchCache(std::size_t pairs)
    : sets_(std::clamp<std::size_t>(pairs, 1, kMostSets)) {}

PatchCache::Key PatchCache::make_key(std::size_t index,
                                     const joints::PairBodies& parts) {
  std::array<double, 24> poses;
  double* end = poses.data();
  for (const joints::PairBody* part : {&parts.A, &parts.B}) {
    end = std::copy_n(part->R_WB.data(), 9, end);
    end = std::copy_n(part->p_WB.data(), 3, end);
  }
  return {index, std::bit_cast<std::array<std::uint64_t, 24>>(poses)};
}

bool PatchCache::look_up(const Key& key, bool has_derivatives,
                         Patch& out) const {
  if (is_in_use_.test_and_set(std::memory_order_acquire)) return false;
  Set& set = sets_[key.index % sets_.size()];
  bool is_found = false;
  for (const std::size_t i : {set.newer, 1 - set.newer}) {
    const Entry& entry = set.entries[i];
    const bool suffices = entry.is_filled && entry.key == key &&
                          (entry.has_derivatives || !has_derivatives);
    if (!suffices) continue;
    out = entry.patch;
    set.newer = i;
    is_found = true;
    break;
  }
  is_in_use_.clear(std::memory_order_release);
  return is_found;
}

void PatchCache::keep(const Key& key, bool has_derivatives,
                      const Patch& patch) const {
  if (is_in_use_.test_and_set(std::memory_order_acquire)) return;
  Set& set = sets_[key.index % sets_.size()];
  set.newer = 1 - set.newer;
  set.entries[set.newer] = {key, true, has_derivatives, patch};
  is_in_use_.clear(std::memory_order_release);
}

}  // namespace limber::contact
