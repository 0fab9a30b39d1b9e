// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber {

/// Thin wrapper of one HDF5 file. Every dataset has the attributes "unit" and
/// "meaning". Matrices are stored row-major; every failure throws InputError
/// with the file's path.
///
/// Limits     HDF5 checks its data, but not its own structure: verify a
///            digest of an untrusted file before opening it. Concurrent use by
///            threads needs a thread-safe build of HDF5.
class Hdf5File {
 public:
  /// Creates a file, replacing an old one. Its first `user_block` bytes (0, or
  /// a power of two >= 512) are for the caller to write after `close`.
  [[nodiscard]] static Hdf5File create(const std::filesystem::path& file,
                                       std::uint64_t user_block = 0);
  /// Opens an existing file for reading.
  [[nodiscard]] static Hdf5File open(const std::filesystem::path& file);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&&) = delete;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// Names may contain slashes: intermediate groups are created. Values have
  /// the given unit.
  void write(const std::string& name, const MatrixX& values,
             const std::string& unit, const std::string& meaning);
  void write(const std::string& name, const std::vector<std::int64_t>& values,
             const std::string& unit, const std::string& meaning);
  void write(const std::string& name, const std::string& text,
             const std::string& meaning);
  /// The same in single precision, for data that is only drawn.
  void write_single(const std::string& name, const MatrixX& values,
                    const std::string& unit, const std::string& meaning);
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
  /// The unit of a dataset.
  [[nodiscard]] std::string read_unit(const std::string& name) const;
  /// Names directly inside a group, sorted.
  [[nodiscard]] std::vector<std::string> list(const std::string& group) const;

  /// Flushes and closes; the destructor does the same but ignores failures.
  void close();

 private:
  friend class Hdf5Rows;

  Hdf5File(std::int64_t handle, std::filesystem::path file);

  std::int64_t handle_ = -1;
  std::filesystem::path file_;
};

}  // namespace limber
