// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace limber {

/// What a dataset of a flat file contains; the numbers are those in the file.
enum class FlatKind : std::uint64_t { doubles, integers, text, singles };

/// Values of a dataset, row-major, little-endian.
struct FlatDataset {
  std::string unit;
  FlatKind kind = FlatKind::doubles;
  std::uint64_t rows = 0;
  std::uint64_t columns = 0;
  std::string bytes;
};

/// The content of an HDF5 file by names of datasets, where there is no HDF5: in
/// the module of the playground. After a user block come "LIMBFLAT" and, for
/// each dataset, its name and unit (length, bytes), kind, rows, columns
/// (lengths and these three are 8 bytes, little-endian) and values.
struct FlatFile {
  std::string user_block;  ///< of any length, not interpreted
  std::map<std::string, FlatDataset> datasets;
};

/// Bytes of a value of a dataset.
[[nodiscard]] std::uint64_t size_of(FlatKind kind);

/// @throws InputError if it cannot be written.
void write_flat(const std::filesystem::path& file, const FlatFile& content);

/// @param user_block its size [bytes]
/// @throws InputError if it cannot be read, or is no flat file.
[[nodiscard]] FlatFile read_flat(const std::filesystem::path& file,
                                 std::size_t user_block);

/// Whether "LIMBFLAT" follows after `user_block` bytes.
[[nodiscard]] bool is_flat(const std::filesystem::path& file,
                           std::size_t user_block);

}  // namespace limber
