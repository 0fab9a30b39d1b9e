// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Internal to src/limber/fem/linalg: the only header that exposes CHOLMOD's
// types.

#include <string>
#include <vector>

#include "limber/fem/linalg/cholmod_library.hpp"
#include "limber/fem/linalg/sparse_matrix.hpp"

namespace limber::fem {

/// RAII wrapper of cholmod_common, with printing disabled.
class CholmodCommon {
 public:
  CholmodCommon();
  ~CholmodCommon();
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  [[nodiscard]] cholmod_common* get() { return &common_; }
  /// @throws NumericalError if the last call failed (memory, size).
  void check(const std::string& what) const;

 private:
  cholmod_common common_{};
};

/// CHOLMOD view of the matrix's arrays, without a copy.
[[nodiscard]] cholmod_sparse view_lower(const SparseMatrix& lower);

/// Symbolic factor for a given order.
[[nodiscard]] cholmod_factor* analyze(const SparseMatrix& lower,
                                      const std::vector<int>& order,
                                      CholmodCommon& common);

}  // namespace limber::fem
