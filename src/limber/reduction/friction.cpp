// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/friction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/surface_matrix.hpp"

namespace limber::flexbody {
namespace {

void check(const MeshedBody& body, const Friction& friction) {
  std::vector<std::string> problems;
  const auto check_value = [&](const char* name, double value,
                               const char* unit) {
    if (std::isfinite(value) && value >= 0.0) return;
    problems.push_back(
        fmt::format("{}: the friction's {} is {} {}; expected 0 or more.",
                    body.mesh.source, name, value, unit));
  };
  check_value("mass_rate", friction.mass_rate, "1/s");
  check_value("stiffness_time", friction.stiffness_time, "s");
  check_value("surface", friction.surface, "N s/m^3");
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// alpha M_s + c S on all nodes.
fem::SparseMatrix combine(const MeshedBody& body, const Friction& friction) {
  fem::SparseMatrix drag = friction.mass_rate * body.M_s;
  if (friction.surface > 0.0)
    drag += friction.surface * fem::assemble_surface_matrix(body.mesh);
  return drag;
}

}  // namespace

fem::SparseMatrix make_drag(const MeshedBody& body, const Friction& friction) {
  check(body, friction);
  if (friction.mass_rate == 0.0 && friction.surface == 0.0)
    throw InputError(fmt::format(
        "{}: friction without damping: mass_rate and surface are 0, so nothing "
        "resists rigid motion and no speed is steady (stiffness_time resists "
        "only deformation). Expected one of the two above 0.",
        body.mesh.source));
  return combine(body, friction);
}

MatrixX multiply_damping(const MeshedBody& body, const Friction& friction,
                         const MatrixX& X) {
  check(body, friction);
  const Support& support = body.support;
  MatrixX product =
      friction.stiffness_time * fem::multiply_stiffness(support.matrices, X);
  const fem::SparseMatrix drag = combine(body, friction);
  if (drag.nonZeros() > 0)
    product +=
        fem::multiply_mass(fem::restrict_matrix(drag, support.free_nodes), X);
  return product;
}

}  // namespace limber::flexbody
