// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For sources of src/fem only: the one header that shows CHOLMOD's types.
#include <cholmod.h>

#include <string>
#include <vector>

#include "fem/matrices.hpp"

namespace limber::fem {

/// CHOLMOD's settings and status, started and finished, silent.
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

/// The matrix's own arrays as CHOLMOD sees them.
[[nodiscard]] cholmod_sparse view_lower(const SparseMatrix& lower);

/// Symbolic factor for a given order.
[[nodiscard]] cholmod_factor* analyze(const SparseMatrix& lower,
                                      const std::vector<int>& order,
                                      CholmodCommon& common);

}  // namespace limber::fem
