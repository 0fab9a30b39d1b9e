// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/types.hpp"

namespace limber {

/// A thin, throwing face of one HDF5 file. Every dataset carries the
/// attributes "unit" and "meaning". Matrices are stored row by row as they
/// print; all failures become InputError with the file's path.
///
/// Limits     HDF5 checks its data, but not its own structure: who must not
///            trust a file verifies a digest of its bytes before opening it.
///            Threads may use files at once where HDF5 is built thread-safe.
class Hdf5File {
 public:
  /// Makes a new file, replacing an old one. Its first `user_block` bytes (0,
  /// or a power of two from 512) are left to the caller, after `close`.
  [[nodiscard]] static Hdf5File create(const std::filesystem::path& file,
                                       std::uint64_t user_block = 0);
  /// Opens an existing file for reading.
  [[nodiscard]] static Hdf5File open(const std::filesystem::path& file);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&&) = delete;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// Names may hold slashes: groups in between are made.
  void write(const std::string& name, const MatrixX& values,
             const std::string& unit, const std::string& meaning);
  void write(const std::string& name, const std::vector<std::int64_t>& values,
             const std::string& unit, const std::string& meaning);
  void write(const std::string& name, const std::string& text,
             const std::string& meaning);
  /// Row-major data of any rank.
  void write_array(const std::string& name, const std::vector<double>& values,
                   const std::vector<std::uint64_t>& shape,
                   const std::string& unit, const std::string& meaning);
  void write_array(const std::string& name,
                   const std::vector<std::int64_t>& values,
                   const std::vector<std::uint64_t>& shape,
                   const std::string& unit, const std::string& meaning);

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] MatrixX read_matrix(const std::string& name) const;
  [[nodiscard]] std::vector<std::int64_t> read_integers(
      const std::string& name) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;
  /// Names directly inside a group, sorted.
  [[nodiscard]] std::vector<std::string> list(const std::string& group) const;

  /// Flushes and closes; the destructor does so without a word on failure.
  void close();

 private:
  Hdf5File(std::int64_t handle, std::filesystem::path file);

  std::int64_t handle_ = -1;
  std::filesystem::path file_;
};

}  // namespace limber
