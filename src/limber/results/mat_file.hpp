// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::results {

/// Named arrays in MATLAB's format 5, which MATLAB, Octave and SciPy read.
/// Built in memory: the library that writes it does not report a full disk.
class MatFile {
 public:
  /// @throws NumericalError, as each of the others, if memory is exhausted.
  MatFile();
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;
  ~MatFile();

  void add(const std::string& name, const MatrixX& matrix);
  /// A cell column of char rows.
  void add(const std::string& name, const std::vector<std::string>& texts);

  /// All bytes of the file; nothing can be added after it.
  [[nodiscard]] std::string finish();

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace limber::results
