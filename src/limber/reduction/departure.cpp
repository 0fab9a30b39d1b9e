// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/departure.hpp"

#include <fmt/format.h>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/reduction/modal/krylov.hpp"

namespace limber::flexbody {
namespace {

constexpr double kDropTolerance = 1e-8;  // as BasisOptions'

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

void check_terms(const MeshedBody& body, int terms, int least) {
  if (terms >= least) return;
  throw InputError(
      fmt::format("{}: {} terms of the expansion; expected {} or more.",
                  body.mesh.source, terms, least));
}

MatrixX find_terms(const MeshedBody& body, const MatrixX& F, int terms) {
  return find_krylov_vectors(body, body.inverse.solve(F), terms,
                             kDropTolerance);
}

/// Lagrange's equations in the span of the vectors.
DepartureModel project(const MeshedBody& body, const MatrixX& F,
                       const MatrixX& vectors, const Friction& friction) {
  const Support& support = body.support;
  DepartureModel model;
  model.basis = make_reduced_basis(vectors, support, kDropTolerance);
  const MatrixX& Phi = model.basis.Phi;
  model.C = Phi.transpose() * multiply_damping(body, friction, Phi);
  model.Q = Phi.transpose() * F;
  return model;
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
          quadratic(fem::multiply_stiffness(body.support.matrices, x))};
}

MatrixX DepartureModel::calc_static() const {
  return basis.lambda.cwiseInverse().asDiagonal() * Q;
}

Eigen::MatrixXcd DepartureModel::calc_response(std::complex<double> s) const {
  Eigen::MatrixXcd dynamic = s * C.cast<std::complex<double>>();
  dynamic.diagonal() += basis.lambda.cast<std::complex<double>>();
  dynamic.diagonal().array() += s * s;
  return dense::solve(dynamic, Q.cast<std::complex<double>>());
}

DepartureModel make_departure_model(const MeshedBody& body,
                                    const MatrixX& loads, int terms,
                                    const Friction& friction) {
  LIMBER_EXPECT(loads.rows() == 3 * body.mesh.x.cols());
  check_terms(body, terms, 1);
  const MatrixX F = find_deforming_loads(body, loads);
  return project(body, F, find_terms(body, F, terms), friction);
}

std::vector<DepartureModel> make_interval_models(const MeshedBody& body,
                                                 const MatrixX& loads,
                                                 int terms, int carried,
                                                 const Friction& friction) {
  LIMBER_EXPECT(loads.rows() == 3 * body.mesh.x.cols());
  check_terms(body, terms, 1);
  check_terms(body, carried, 0);
  const MatrixX F = find_deforming_loads(body, loads);
  std::vector<DepartureModel> models;
  MatrixX before(F.rows(), 0);
  for (Eigen::Index j = 0; j < F.cols(); ++j) {
    const MatrixX own = find_terms(body, F.col(j), terms);
    MatrixX vectors(F.rows(), own.cols() + before.cols());
    vectors << own, before;
    models.push_back(project(body, F.col(j), vectors, friction));
    if (carried > 0) before = find_terms(body, F.col(j), carried);
  }
  return models;
}

CarriedMotion carry_motion(const MeshedBody& body, const DepartureModel& from,
                           const DepartureModel& to,
                           const DepartureMotion& motion) {
  LIMBER_EXPECT(motion.r.size() == from.basis.lambda.size());
  LIMBER_EXPECT(motion.rdot.size() == from.basis.lambda.size());
  const fem::StructuralMatrices& matrices = body.support.matrices;
  const auto calc_energy = [](const DepartureModel& model,
                              const DepartureMotion& at) {
    return 0.5 * (at.rdot.squaredNorm() +
                  at.r.dot(model.basis.lambda.cwiseProduct(at.r)));
  };
  const MatrixX x = from.basis.Phi * motion.r;
  const MatrixX v = from.basis.Phi * motion.rdot;
  const MatrixX& Phi = to.basis.Phi;
  CarriedMotion carried;
  carried.motion.r = to.basis.lambda.cwiseInverse().asDiagonal() *
                     (Phi.transpose() * fem::multiply_stiffness(matrices, x));
  carried.motion.rdot = Phi.transpose() * fem::multiply_mass(matrices.M_s, v);
  carried.lost = calc_energy(from, motion) - calc_energy(to, carried.motion);
  return carried;
}

}  // namespace limber::flexbody
