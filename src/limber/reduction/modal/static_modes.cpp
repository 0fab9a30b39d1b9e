// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/static_modes.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/flexbody/model/force_directions.hpp"
#include "limber/reduction/modal/krylov.hpp"
#include "limber/reduction/modal/load_cases.hpp"

namespace limber::flexbody {
namespace {

void append(const MatrixX& columns, MatrixX& to) {
  MatrixX joined(columns.rows(), to.cols() + columns.cols());
  joined << to, columns;
  to = std::move(joined);
}

/// Loads of the patterns whose static responses enter the basis, on all nodes.
MatrixX find_pattern_columns(const ElasticBody& body, const Recipe& recipe) {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < recipe.load_patterns.size(); ++i)
    if (recipe.load_patterns[i].static_mode)
      columns.push_back(static_cast<Eigen::Index>(i));
  return find_pattern_loads(body.support.field_rows(), recipe, body.interfaces)(
      Eigen::all, columns);
}

/// Forces that deform the body: omits those that only move it, of which
/// roundoff would remain.
MatrixX find_deforming(const fem::ElasticInverse& inverse, const MatrixX& F) {
  constexpr double kRoundoff = 1e-11;
  MatrixX elastic = inverse.project_load(F);
  for (Eigen::Index i = 0; i < F.cols(); ++i)
    if (elastic.col(i).norm() <= kRoundoff * F.col(i).norm())
      elastic.col(i).setZero();
  return elastic;
}

/// Static responses to a history, the most elastic energy first. With F = Q R,
/// X = K^+ Q and Q^T X = A^T A, the responses X R have the energy Gram matrix
/// (A R)^T (A R); A R R^T A^T = U diag(energy) U^T gives their principal
/// directions X R R^T A^T U.
MatrixX find_force_modes(const ElasticBody& body, const NodalForces& nodal,
                         LoadModesRecord& record) {
  check_rows(nodal, body.support);
  const ForceDirections found =
      find_force_directions(find_deforming(body.inverse, nodal.forces),
                            kForceTolerance, kMostForceDirections);
  record.name = nodal.name;
  record.is_whole = found.is_whole;
  if (found.Q.cols() == 0) return MatrixX(nodal.forces.rows(), 0);
  const MatrixX X = body.inverse.solve(found.Q);
  const MatrixX S = found.Q.transpose() * X;
  const auto compliance =
      dense::find_eigenpairs(MatrixX(0.5 * (S + S.transpose())));
  const MatrixX A_T = compliance.vectors *
                      compliance.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const MatrixX weight = found.R * found.R.transpose() * A_T;
  const auto principal =
      dense::find_eigenpairs(MatrixX(A_T.transpose() * weight));
  const VectorX energy = principal.values.reverse().cwiseMax(0.0);
  const double least = kForceTolerance * kForceTolerance * energy[0];
  const Eigen::Index directions = (energy.array() > least).count();
  const Eigen::Index taken = std::min(directions, kMostForceModes);
  record.directions = static_cast<int>(directions);
  record.taken = static_cast<int>(taken);
  if (taken < directions)
    record.left_out =
        std::sqrt(energy.tail(energy.size() - taken).sum() / energy.sum());
  return X * (weight * principal.vectors.rowwise().reverse().leftCols(taken));
}

/// Unit forces and moments of all interfaces, on the free degrees of freedom.
MatrixX find_unit_loads(const ElasticBody& body) {
  MatrixX loads(body.support.matrices.dof_count(), 0);
  for (const Interface& interface : body.interfaces)
    append(body.support.on_free(
               interface.motion.spread(unit_wrenches(interface.motion))),
           loads);
  return loads;
}

Matrix6 find_mean_motion(const ElasticBody& body, const Interface& interface,
                         const MatrixX& answers) {
  const Matrix6 motion = interface.motion.apply(body.support.on_all(answers)) *
                         unit_wrenches(interface.motion).transpose();
  return 0.5 * (motion + motion.transpose());
}

}  // namespace

StaticModes find_static_modes(const ElasticBody& body, const Recipe& recipe,
                              const fem::Eigenmodes& known) {
  StaticModes modes;
  modes.vectors.resize(body.support.matrices.dof_count(), 0);
  // At once, since the factor is read for every solution.
  const MatrixX responses =
      body.inverse.solve_from(find_unit_loads(body), known.Phi);
  Eigen::Index column = 0;
  for (const Interface& interface : body.interfaces) {
    const Eigen::Index count = unit_wrenches(interface.motion).cols();
    const MatrixX answers = responses.middleCols(column, count);
    modes.flexibility.push_back(find_mean_motion(body, interface, answers));
    if (recipe.basis.interface_modes && interface.static_modes)
      append(answers, modes.vectors);
    column += count;
  }
  if (recipe.basis.load_modes) {
    const MatrixX patterns = find_pattern_columns(body, recipe);
    append(body.inverse.solve_from(body.support.on_free(patterns), known.Phi),
           modes.vectors);
    for (const NodalForces& nodal : recipe.nodal_forces)
      append(find_force_modes(body, nodal, modes.loads.emplace_back()),
             modes.vectors);
  }
  modes.vectors = find_krylov_vectors(body, modes.vectors, recipe.basis.terms,
                                      recipe.basis.drop_tolerance);
  return modes;
}

StaticModes estimate_static_modes(const ElasticBody& body) {
  constexpr int kSteps = 3;
  const fem::SparseMatrix& M_s = body.support.matrices.M_s;
  const MatrixX loads = find_unit_loads(body);
  StaticModes modes;
  modes.vectors = loads;
  if (loads.cols() == 0) return modes;
  modes.vectors = body.inverse.solve_shifted(loads);
  Eigen::Index column = 0;
  for (const Interface& interface : body.interfaces) {
    const Eigen::Index count = unit_wrenches(interface.motion).cols();
    modes.flexibility.push_back(find_mean_motion(
        body, interface, modes.vectors.middleCols(column, count)));
    column += count;
  }
  MatrixX step = modes.vectors;
  for (int i = 1; i < kSteps; ++i) {
    step = body.inverse.solve_shifted(fem::multiply_mass(M_s, step));
    append(step, modes.vectors);
  }
  return modes;
}

ReducedBasis join_basis(const ElasticBody& body,
                        const fem::Eigenmodes& eigenmodes,
                        const StaticModes& modes, double drop_tolerance) {
  const Support& support = body.support;
  MatrixX vectors(support.matrices.dof_count(),
                  eigenmodes.Phi.cols() + modes.vectors.cols());
  vectors << eigenmodes.Phi, modes.vectors;
  return make_reduced_basis(vectors, support, drop_tolerance);
}

}  // namespace limber::flexbody
