// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/sobol_sequence.hpp"

#include <array>

#include "limber/common/errors.hpp"

namespace limber::study {
namespace {

constexpr std::size_t kBits = 32;

// A primitive polynomial: its degree, inner coefficients, and first numbers.
struct Row {
  std::size_t degree;
  std::uint32_t inner;
  std::array<std::uint32_t, 7> first;
};

constexpr std::array<Row, SobolSequence::kMostDimensions - 1> kRows = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
}};

std::vector<std::uint32_t> make_directions(const Row& row) {
  std::vector<std::uint32_t> v(kBits);
  const std::size_t s = row.degree;
  for (std::size_t k = 0; k < kBits; ++k) {
    if (k < s) {
      v[k] = row.first.at(k) << (kBits - 1 - k);
      continue;
    }
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (std::size_t j = 1; j < s; ++j) {
      if ((row.inner >> (s - 1 - j)) & 1U) v[k] ^= v[k - j];
    }
  }
  return v;
}

}  // namespace

SobolSequence::SobolSequence(int dimensions) {
  LIMBER_EXPECT(dimensions >= 1 && dimensions <= kMostDimensions);
  std::vector<std::uint32_t> halves;
  for (std::size_t k = 0; k < kBits; ++k) {
    halves.push_back(std::uint32_t{1} << (kBits - 1 - k));
  }
  directions_.push_back(halves);
  for (int d = 1; d < dimensions; ++d) {
    directions_.push_back(
        make_directions(kRows.at(static_cast<std::size_t>(d - 1))));
  }
}

std::vector<std::uint32_t> SobolSequence::point(std::uint32_t i) const {
  std::vector<std::uint32_t> x;
  const std::uint32_t gray = i ^ (i >> 1U);
  for (const auto& v : directions_) {
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < kBits; ++k) {
      if ((gray >> k) & 1U) sum ^= v[k];
    }
    x.push_back(sum);
  }
  return x;
}

}  // namespace limber::study
