// SPDX-License-Identifier: BSD-3-Clause
#include "split.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace limber::bench::trade {
namespace {

/// What singular values beyond the first `vectors` leave of `u`.
double find_bound(const MatrixX& u, Eigen::Index vectors) {
  const MatrixX gram = u.transpose() * u;
  const VectorX squares =
      Eigen::SelfAdjointEigenSolver<MatrixX>(gram, Eigen::EigenvaluesOnly)
          .eigenvalues();
  const Eigen::Index rest = std::max<Eigen::Index>(squares.size() - vectors, 0);
  return std::sqrt(squares.head(rest).cwiseMax(0.0).sum() / squares.sum());
}

}  // namespace

flexbody::ModalLoads project(const FullModes& modes, const StepForces& forces) {
  flexbody::ModalLoads loads;
  loads.steps = {forces.times, modes.Phi.transpose() * forces.forces};
  return loads;
}

MatrixX respond_by_all(const FullModes& modes,
                       const flexbody::ModalLoads& loads,
                       const std::vector<double>& times) {
  const VectorX none = VectorX::Zero(modes.lambda.size());
  return modes.Phi * flexbody::ModalResponse(modes.lambda, none, loads, {})
                         .evaluate(times)
                         .eta;
}

Split split_error(const Outcome& reference, const MatrixX& all,
                  const Outcome& exact, const Outcome* stepped) {
  const MatrixX truth = find_deformation(reference);
  const MatrixX kept = find_deformation(exact);
  const double size = truth.norm();
  Split split;
  split.physics = (all - truth).norm() / size;
  split.truncation = (kept - all).norm() / size;
  split.bound = find_bound(all, exact.run.built.model.modal_count);
  if (stepped != nullptr) {
    split.step = (find_deformation(*stepped) - kept).norm() / size;
  }
  return split;
}

}  // namespace limber::bench::trade
