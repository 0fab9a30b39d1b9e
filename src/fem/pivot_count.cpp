// SPDX-License-Identifier: BSD-3-Clause
#include "fem/pivot_count.hpp"

#include <cmath>

#include "fem/cholmod_view.hpp"

namespace limber::fem {

PivotCount count_negative_pivots(const SparseMatrix& lower,
                                 const std::vector<int>& order) {
  CholmodCommon common;
  common.get()->supernodal = CHOLMOD_SIMPLICIAL;
  common.get()->final_ll = 0;
  common.get()->quick_return_if_not_posdef = 0;
  cholmod_factor* factor = analyze(lower, order, common);
  cholmod_sparse matrix = view_lower(lower);
  cholmod_factorize(&matrix, factor, common.get());
  const bool is_complete = factor->minor >= factor->n;
  PivotCount count;
  count.is_reliable = is_complete;
  // Pivots of indefinite matrices have no lower bound; one this much below
  // its own diagonal entry has lost its digits.
  constexpr double kLost = 1e-12;
  const auto* p = static_cast<const int*>(factor->p);
  const auto* x = static_cast<const double*>(factor->x);
  const auto* permutation = static_cast<const int*>(factor->Perm);
  for (std::size_t j = 0; is_complete && j < factor->n; ++j) {
    const double pivot = x[p[j]];
    const int dof = permutation[j];
    if (std::abs(pivot) < kLost * std::abs(lower.coeff(dof, dof)))
      count.is_reliable = false;
    if (pivot < 0.0) ++count.negative;
  }
  cholmod_free_factor(&factor, common.get());
  common.check("inertia count");
  return count;
}

}  // namespace limber::fem
