// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/kept_modes.hpp"

#include <fmt/format.h>

#include <utility>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

/// The first n columns, where there are any.
template <typename Table>
void keep_columns(Table& table, Eigen::Index n) {
  if (table.cols() > n) table = Table(table.leftCols(n));
}

void keep_integrals(InertiaShapeIntegrals& integrals, std::size_t n) {
  const std::size_t m = integrals.S1.size();
  std::vector<Matrix3> S2;
  for (std::size_t k = 0; k < n; ++k) {
    const auto row = integrals.S2.begin() + static_cast<std::ptrdiff_t>(k * m);
    S2.insert(S2.end(), row, row + static_cast<std::ptrdiff_t>(n));
  }
  integrals.S1.resize(n);
  integrals.S2 = std::move(S2);
  keep_columns(integrals.P, static_cast<Eigen::Index>(n));
}

void keep_stress(StressModes& stress, Eigen::Index n) {
  keep_columns(stress.Sigma_B, n);
  keep_columns(stress.sections.Force, n);
  if (stress.averaging.size() > 0)
    stress.averaging = MatrixX(stress.averaging.topLeftCorner(n, n));
}

}  // namespace

bool has_separable_modes(const ReducedBody& body) {
  return body.contact_surfaces.empty() && !body.manifold &&
         !body.initial.displacement && !body.initial.velocity;
}

ReducedBody keep_lowest_modes(ReducedBody body, int count) {
  if (!has_separable_modes(body) || count < 1) {
    throw InputError(fmt::format(
        "body '{}': {} modes cannot be kept; expected at least one, of a body "
        "without contact surfaces, tables of level nonlinear and initial "
        "deformation",
        body.name, count));
  }
  if (count >= body.mode_count()) return body;
  const Eigen::Index n = count;
  body.lambda = VectorX(body.lambda.head(n));
  keep_integrals(body.integrals, static_cast<std::size_t>(n));
  keep_columns(body.rows.Phi_B, n);
  for (InterfaceTable& table : body.interfaces) {
    keep_columns(table.Phi_B, n);
    keep_columns(table.Psi_B, n);
  }
  if (body.stress) keep_stress(*body.stress, n);
  return body;
}

}  // namespace limber::flexbody
