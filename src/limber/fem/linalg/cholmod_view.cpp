// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/cholmod_view.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"

namespace limber::fem {

CholmodCommon::CholmodCommon() {
  cholmod().start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;
  common_.final_ll = 1;
  common_.quick_return_if_not_posdef = 1;
}

CholmodCommon::~CholmodCommon() { cholmod().finish(&common_); }

void CholmodCommon::check(const std::string& what) const {
  if (common_.status >= CHOLMOD_OK) return;
  throw NumericalError(fmt::format(
      "{}: {}. Use a coarser mesh or a machine with more memory.", what,
      common_.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory"
      : common_.status == CHOLMOD_TOO_LARGE
          ? "the factor is too large"
          : fmt::format("CHOLMOD reports status {}", common_.status)));
}

cholmod_sparse view_lower(const SparseMatrix& lower) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  // CHOLMOD takes mutable pointers but does not modify the arrays.
  view.p = const_cast<int*>(lower.outerIndexPtr());
  view.i = const_cast<int*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_factor* analyze(const SparseMatrix& lower,
                        const std::vector<int>& order, CholmodCommon& common) {
  cholmod_common* settings = common.get();
  settings->nmethods = 1;
  settings->method[0].ordering = CHOLMOD_GIVEN;
  settings->postorder = 1;
  cholmod_sparse matrix = view_lower(lower);
  cholmod_factor* factor = cholmod().analyze_p(
      &matrix, const_cast<int*>(order.data()), nullptr, 0, settings);
  common.check("symbolic factorisation");
  return factor;
}

}  // namespace limber::fem
