// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"

namespace limber::flexbody {

/// Reads datasets and checks sizes and finiteness. Throws InputError.
class BodyFileReader {
 public:
  BodyFileReader(const Hdf5File& in, const std::filesystem::path& file)
      : in_(in), file_(file) {}

  [[nodiscard]] MatrixX matrix(const std::string& name, Eigen::Index rows,
                               Eigen::Index columns) const {
    MatrixX m = in_.read_matrix(name);
    if (m.rows() != rows || m.cols() != columns) {
      fail(fmt::format("'{}' is {} x {}; expected {} x {}", name, m.rows(),
                       m.cols(), rows, columns));
    }
    if (!m.allFinite()) fail(fmt::format("'{}' is not finite", name));
    return m;
  }
  [[nodiscard]] std::int64_t integer(const std::string& name) const {
    const auto values = in_.read_integers(name);
    if (values.size() != 1) fail(fmt::format("'{}' is not one number", name));
    return values[0];
  }
  /// Non-negative integers, `count` of them (any number if `count` < 0).
  [[nodiscard]] std::vector<std::size_t> sizes(const std::string& name,
                                               std::int64_t count) const {
    const auto values = in_.read_integers(name);
    for (const std::int64_t v : values) {
      if (v < 0) fail(fmt::format("'{}' holds {}", name, v));
    }
    if (count >= 0 && static_cast<std::int64_t>(values.size()) != count) {
      fail(fmt::format("'{}' has {} entries; expected {}", name, values.size(),
                       count));
    }
    return {values.begin(), values.end()};
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        fmt::format("'{}': {}; the reduced body is damaged; reduce it again",
                    file_.string(), what));
  }
  [[nodiscard]] const Hdf5File& in() const { return in_; }

 private:
  const Hdf5File& in_;
  const std::filesystem::path& file_;
};

}  // namespace limber::flexbody
