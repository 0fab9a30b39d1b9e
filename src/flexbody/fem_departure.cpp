// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/fem_departure.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "common/errors.hpp"
#include "flexbody/reduce_krylov.hpp"

namespace limber::flexbody {
namespace {

/// @throws InputError if a load deforms nothing.
MatrixX find_deforming_loads(const MeshedBody& body, const MatrixX& loads) {
  constexpr double kRoundoff = 1e-11;
  if (!loads.allFinite())
    throw InputError(
        fmt::format("{}: a nodal force is not finite; expected numbers [N].",
                    body.mesh.source));
  const MatrixX F = take_rows(loads, body.support.free_nodes);
  MatrixX elastic = body.inverse.project_load(F);
  for (Eigen::Index j = 0; j < F.cols(); ++j)
    if (elastic.col(j).norm() <= kRoundoff * F.col(j).norm())
      throw InputError(fmt::format(
          "{}: load {} of {} deforms nothing, so there is no static state to "
          "depart from. Expected nodal forces that do more than move the body.",
          body.mesh.source, j + 1, F.cols()));
  return elastic;
}

}  // namespace

std::complex<double> SingleInputModel::calc_transfer(
    std::complex<double> s) const {
  const std::complex<double> inertia = m * s * s + d * s;
  return -inertia / (inertia + k);
}

SingleInputModel make_single_input_model(const MeshedBody& body,
                                         const OperatingState& state,
                                         const Friction& friction) {
  LIMBER_EXPECT(state.u.cols() == body.mesh.x.cols());
  if (!(state.strain_energy > 0.0))
    throw InputError(fmt::format(
        "{}: the state has no deformation, so there is nothing to depart "
        "from. Expected a load that deforms the body.",
        body.mesh.source));
  const MatrixX x = take_rows(state.u.reshaped(), body.support.free_nodes);
  const auto quadratic = [&](const MatrixX& image) {
    return x.col(0).dot(image.col(0));
  };
  return {quadratic(fem::multiply_mass(body.support.matrices.M_s, x)),
          quadratic(multiply_damping(body, friction, x)),
          quadratic(fem::multiply_stiffness(body.support.matrices.K, x))};
}

MatrixX DepartureModel::calc_static() const {
  return basis.lambda.cwiseInverse().asDiagonal() * Q;
}

Eigen::MatrixXcd DepartureModel::calc_response(std::complex<double> s) const {
  Eigen::MatrixXcd dynamic = s * C.cast<std::complex<double>>();
  dynamic.diagonal() += basis.lambda.cast<std::complex<double>>();
  dynamic.diagonal().array() += s * s;
  return dynamic.partialPivLu().solve(Q.cast<std::complex<double>>());
}

DepartureModel make_departure_model(const MeshedBody& body,
                                    const MatrixX& loads, int terms,
                                    const Friction& friction) {
  constexpr double kDropTolerance = 1e-8;
  LIMBER_EXPECT(loads.rows() == 3 * body.mesh.x.cols());
  if (terms < 1)
    throw InputError(
        fmt::format("{}: {} terms of the expansion; expected 1 or more.",
                    body.mesh.source, terms));
  const MatrixX F = find_deforming_loads(body, loads);
  const MatrixX vectors =
      find_krylov_vectors(body, body.inverse.solve(F), terms, kDropTolerance);
  const Support& support = body.support;
  DepartureModel model;
  model.basis =
      make_reduced_basis(vectors, support.matrices.M_s, support.matrices.K,
                         support.R, kDropTolerance);
  const MatrixX& Phi = model.basis.Phi;
  model.C = Phi.transpose() * multiply_damping(body, friction, Phi);
  model.Q = Phi.transpose() * F;
  return model;
}

}  // namespace limber::flexbody
