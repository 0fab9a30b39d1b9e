// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace limber {

/// A list of rows of numbers, each of any length, that does not grow in memory:
/// what exceeds a block of 1 MiB goes to a temporary file, and only the place
/// of each block is kept. The file has no name, so that nothing is left of a
/// killed process; it is in TMPDIR, else /var/tmp, which unlike /tmp is not in
/// memory itself, else /tmp. Where it cannot be written, as on a full disk, the
/// rows stay in memory.
///
/// A copy shares the file, and both may grow. Threads may read one list
/// together.
class SpilledNumbers {
 public:
  void append(const std::vector<double>& row);

  [[nodiscard]] std::size_t size() const { return spilled_ + ends_.size(); }
  /// @throws ContractError from size() on; InputError if the file cannot be
  /// read
  [[nodiscard]] std::vector<double> read(std::size_t i) const;

  /// Bytes of rows in memory.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  class File;

  struct Block {
    std::size_t first = 0;    // row
    std::uint64_t place = 0;  // in the file: ends of rows, and then numbers
  };

  static constexpr std::size_t kBlock = std::size_t{1} << 20;  // [bytes]

  void spill();
  [[nodiscard]] std::vector<double> read_spilled(std::size_t i) const;

  std::shared_ptr<File> file_;
  std::vector<Block> blocks_;
  std::size_t spilled_ = 0;  // number of rows in the file
  // The rows after them, and how many are held before the next attempt.
  std::vector<double> numbers_;
  std::vector<std::uint64_t> ends_;
  std::size_t most_ = kBlock;  // [bytes]
};

}  // namespace limber
