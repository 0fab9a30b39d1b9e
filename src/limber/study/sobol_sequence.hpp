// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace limber::study {

/// Points of Sobol's sequence, whose first 2^k points fill each dimension
/// evenly, for every k.
///
/// Source     Joe, Kuo (2008) [@joe2008], the direction numbers
///            new-joe-kuo-6.21201
/// Limits     20 dimensions, 2^32 points
class SobolSequence {
 public:
  static constexpr int kMostDimensions = 20;

  /// @throws ContractError for other numbers of dimensions than 1 to 20
  explicit SobolSequence(int dimensions);

  /// Point i from 0, each coordinate as a fraction of 2^32.
  [[nodiscard]] std::vector<std::uint32_t> point(std::uint32_t i) const;

 private:
  std::vector<std::vector<std::uint32_t>> directions_;  // a list a dimension
};

}  // namespace limber::study
