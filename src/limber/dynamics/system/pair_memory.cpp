// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/pair_memory.hpp"

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

constexpr std::size_t kBlock = 64;  // numbers

std::size_t count_blocks(std::size_t size) {
  return (size + kBlock - 1) / kBlock;
}

}  // namespace

PairMemory::PairMemory(std::size_t size)
    : numbers_(size, 0.0), is_written_(count_blocks(size), 0) {}

PairMemory& PairMemory::operator=(const PairMemory& other) {
  if (numbers_.size() != other.numbers_.size()) {
    numbers_ = other.numbers_;
    is_written_ = other.is_written_;
    return *this;
  }
  for (std::size_t b = 0; b < is_written_.size(); ++b) {
    if (is_written_[b] == 0 && other.is_written_[b] == 0) continue;
    const std::size_t begin = b * kBlock;
    const std::size_t count = std::min(kBlock, numbers_.size() - begin);
    std::copy_n(other.numbers_.data() + begin, count, numbers_.data() + begin);
    is_written_[b] = other.is_written_[b];
  }
  return *this;
}

std::span<const double> PairMemory::at(std::size_t first,
                                       std::size_t count) const {
  LIMBER_EXPECT(first <= size() && count <= size() - first);
  return std::span(numbers_).subspan(first, count);
}

std::span<double> PairMemory::at(std::size_t first, std::size_t count) {
  LIMBER_EXPECT(first <= size() && count <= size() - first);
  for (std::size_t b = first / kBlock; b < count_blocks(first + count); ++b) {
    is_written_[b] = 1;
  }
  return std::span(numbers_).subspan(first, count);
}

void exchange(Archive& archive, PairMemory& memory) {
  archive(memory.numbers_);
  if (archive.reads()) {
    memory.is_written_.assign(count_blocks(memory.numbers_.size()), 1);
  }
}

void describe(Manifest& out, std::string_view name, const PairMemory& memory) {
  out.add(name, memory.numbers_);
}

}  // namespace limber::dynamics
