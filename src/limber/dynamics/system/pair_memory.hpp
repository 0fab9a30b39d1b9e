// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/common/records/manifest.hpp"

namespace limber::dynamics {

/// Memory of pairs, in their own units, one pair after the other. All values
/// are zero until they are written. States are copied several times a step, and
/// most pairs never touch: a copy to one of the same size copies only blocks
/// that have been written in either.
class PairMemory {
 public:
  PairMemory() = default;
  explicit PairMemory(std::size_t size);
  PairMemory(const PairMemory&) = default;
  PairMemory(PairMemory&&) = default;
  PairMemory& operator=(const PairMemory& other);
  PairMemory& operator=(PairMemory&&) = default;
  ~PairMemory() = default;

  [[nodiscard]] std::size_t size() const { return numbers_.size(); }

  /// @throws ContractError outside of its size; likewise below
  [[nodiscard]] std::span<const double> at(std::size_t first,
                                           std::size_t count) const;
  /// For writing.
  [[nodiscard]] std::span<double> at(std::size_t first, std::size_t count);

  [[nodiscard]] friend bool operator==(const PairMemory& a,
                                       const PairMemory& b) {
    return a.numbers_ == b.numbers_;
  }
  friend void exchange(Archive& archive, PairMemory& memory);
  friend void describe(Manifest& out, std::string_view name,
                       const PairMemory& memory);

 private:
  std::vector<double> numbers_;
  std::vector<char> is_written_;  // of each block
};

}  // namespace limber::dynamics
