// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace limber::results::test {

/// A dataset as read by the HDF5 library directly.
struct RawDataset {
  std::vector<std::uint64_t> shape;               ///< empty: a scalar
  std::vector<double> numbers;                    ///< row by row; if floating
  std::vector<std::int64_t> integers;             ///< row by row; if integer
  std::map<std::string, std::string> attributes;  ///< texts
};

/// All datasets of a file by their full names ("energy/work").
[[nodiscard]] std::map<std::string, RawDataset> read_all_datasets(
    const std::filesystem::path& file);

}  // namespace limber::results::test
