// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "limber/contact/potential/patch.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// The last patches of pairs of parts, by the poses of both parts: monitors of
/// an accepted step, and the next step, ask at the same poses again.
///
/// Limits     two patches a pair; of more than kMostSets pairs, some replace
///            others. While a thread reads or writes, others do without it.
class PatchCache {
 public:
  /// @param pairs of parts
  explicit PatchCache(std::size_t pairs);

  /// That of pair `index`, which depends on the poses of the parts alone.
  /// @param parts as bodies without modes
  /// @param has_derivatives whether hessian_W is needed
  /// @param find () its patch
  template <typename Find>
  [[nodiscard]] Patch find(std::size_t index, const joints::PairBodies& parts,
                           bool has_derivatives, const Find& find) const {
    const Key key = make_key(index, parts);
    Patch patch;
    if (look_up(key, has_derivatives, patch)) return patch;
    patch = find();
    keep(key, has_derivatives, patch);
    return patch;
  }

 private:
  static constexpr std::size_t kMostSets = 64;

  struct Key {
    std::size_t index = 0;
    std::array<std::uint64_t, 24> poses{};  // their bits

    bool operator==(const Key&) const = default;
  };
  struct Entry {
    Key key;
    bool is_filled = false;
    bool has_derivatives = false;
    Patch patch;
  };
  struct Set {
    std::array<Entry, 2> entries;
    std::size_t newer = 0;
  };

  [[nodiscard]] static Key make_key(std::size_t index,
                                    const joints::PairBodies& parts);
  bool look_up(const Key& key, bool has_derivatives, Patch& out) const;
  void keep(const Key& key, bool has_derivatives, const Patch& patch) const;

  mutable std::vector<Set> sets_;
  mutable std::atomic_flag is_in_use_;
};

}  // namespace limber::contact
