// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/types.hpp"

namespace limber {

/// A matrix of a file, of known size, that is written row by row, of which only
/// 128 KiB are in memory. It is read like those that are written whole.
class Hdf5Rows {
 public:
  /// @param out must outlive it
  /// @throws InputError as Hdf5File::write; likewise below
  Hdf5Rows(Hdf5File& out, const std::string& name, Eigen::Index rows,
           Eigen::Index columns, const std::string& unit,
           const std::string& meaning);
  Hdf5Rows(Hdf5Rows&& other) noexcept;
  Hdf5Rows& operator=(Hdf5Rows&&) = delete;
  Hdf5Rows(const Hdf5Rows&) = delete;
  Hdf5Rows& operator=(const Hdf5Rows&) = delete;
  ~Hdf5Rows();

  /// The next row, to be filled before the next call.
  [[nodiscard]] Eigen::Map<Eigen::RowVectorXd> next();

  /// Ends the matrix, of which all rows were filled.
  void close();

 private:
  struct Set;

  void write();

  std::unique_ptr<Set> set_;
  std::vector<double> rows_;  // not yet written
  Eigen::Index columns_;
  std::uint64_t most_;         // rows that are written at a time
  std::uint64_t left_;         // rows to come
  std::uint64_t held_ = 0;     // rows not yet written
  std::uint64_t written_ = 0;  // rows
};

}  // namespace limber
