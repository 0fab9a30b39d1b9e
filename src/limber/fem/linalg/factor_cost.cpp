// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/factor_cost.hpp"

#include "limber/fem/linalg/cholmod_view.hpp"

namespace limber::fem {
namespace {

// Operations a second of one core (Xeon of 2.1 to 3 GHz, OpenBLAS 0.3.21, one
// thread): 1.2e10 with 17 292 unknowns and 2.2e10 with 72 990 of a cube (4.2e9
// and 1.0e11 operations), 0.7e10 with 48 765 of a bar (4.5e9). The rate of
// large problems, which are those that take long.
constexpr double kRate = 2e10;

}  // namespace

double estimate_factor_seconds(const SparseMatrix& M_s,
                               const std::vector<int>& nodes) {
  CholmodCommon common;
  const SparseMatrix lower = M_s.triangularView<Eigen::Lower>();
  cholmod_factor* factor = analyze(lower, nodes, common);
  const double operations = 27.0 * common.get()->fl;
  cholmod().free_factor(&factor, common.get());
  return operations / kRate;
}

}  // namespace limber::fem
