// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/mode_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/flexbody/model/multiply_mass.hpp"

namespace limber::flexbody {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Unit translations and small rotations about the axes, 3N x 6.
MatrixX rigid_motions(const Matrix3X& x) {
  MatrixX motions = MatrixX::Zero(3 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    motions.block<3, 3>(3 * n, 0) = Matrix3::Identity();
    for (Eigen::Index a = 0; a < 3; ++a)
      motions.block<3, 1>(3 * n, 3 + a) =
          Vector3::Unit(a).cross(Vector3(x.col(n)));
  }
  return motions;
}

std::vector<int> find_order(const VectorX& fractions, SelectionOrder order) {
  std::vector<int> modes(static_cast<std::size_t>(fractions.size()));
  std::iota(modes.begin(), modes.end(), 0);
  if (order == SelectionOrder::largest_first)
    std::stable_sort(modes.begin(), modes.end(),
                     [&](int a, int b) { return fractions[a] > fractions[b]; });
  return modes;
}

/// Roundoff of a sum of m fractions relative to its total.
double roundoff(Eigen::Index count) {
  return 4e-16 * static_cast<double>(count + 1);
}

std::vector<int> select_for_case(const VectorX& fractions, double total,
                                 const SelectionOptions& options) {
  std::vector<int> selected;
  if (total == 0.0) return selected;
  const double target = options.threshold * total;
  const double slack = roundoff(fractions.size()) * total;
  double sum = 0.0;
  for (const int mode : find_order(fractions, options.order)) {
    if (sum >= target - slack) break;
    sum += fractions[mode];
    selected.push_back(mode);
  }
  std::sort(selected.begin(), selected.end());
  return selected;
}

double sum_of(const VectorX& values, const std::vector<int>& modes) {
  double sum = 0.0;
  for (const int mode : modes) {
    LIMBER_EXPECT(mode >= 0 && mode < values.size());
    sum += values[mode];
  }
  return sum;
}

}  // namespace

MatrixX calc_report_effective_mass(const MatrixX& Phi, const VectorX& lambda,
                                   const SparseMatrix& M_s,
                                   const MatrixX& loads) {
  LIMBER_EXPECT(Phi.cols() == lambda.size());
  LIMBER_EXPECT(Phi.rows() == loads.rows());
  LIMBER_EXPECT((lambda.array() > 0.0).all());
  const MatrixX projected = Phi.transpose() * multiply_mass(M_s, loads);
  return lambda.cwiseInverse().asDiagonal() * projected.cwiseAbs();
}

MatrixX calc_modal_compliance(const MatrixX& modal_loads,
                              const VectorX& lambda) {
  LIMBER_EXPECT(modal_loads.rows() == lambda.size());
  LIMBER_EXPECT((lambda.array() > 0.0).all());
  return lambda.cwiseInverse().asDiagonal() * modal_loads.cwiseAbs2();
}

Participation calc_participation(const MatrixX& Phi, const SparseMatrix& M_s,
                                 const Matrix3X& x) {
  LIMBER_EXPECT(x.cols() == M_s.cols() && Phi.rows() == 3 * x.cols());
  return calc_base_participation(Phi, M_s, rigid_motions(x));
}

Participation calc_base_participation(const MatrixX& Phi,
                                      const SparseMatrix& M_s,
                                      const MatrixX& motions) {
  LIMBER_EXPECT(motions.rows() == Phi.rows() && motions.cols() <= 6);
  const MatrixX loads = multiply_mass(M_s, motions);
  Participation participation{Matrix6X::Zero(6, Phi.cols()), {}, {}};
  participation.factors.topRows(motions.cols()) = loads.transpose() * Phi;
  participation.effective_mass = participation.factors.cwiseAbs2();
  participation.rigid_mass.setZero();
  participation.rigid_mass.head(motions.cols()) =
      motions.cwiseProduct(loads).colwise().sum().transpose();
  return participation;
}

ModeSelection select_modes(const MatrixX& fractions, const VectorX& totals,
                           const SelectionOptions& options) {
  LIMBER_EXPECT(fractions.cols() == totals.size());
  LIMBER_EXPECT((fractions.array() >= 0.0).all());
  LIMBER_EXPECT((totals.array() >= 0.0).all());
  if (!(options.threshold >= 0.0 && options.threshold <= 1.0))
    throw InputError(
        fmt::format("mode selection: the threshold is {:g}; it is a fraction "
                    "of the whole, from 0 to 1 (0.9 is 90 %).",
                    options.threshold));
  ModeSelection selection;
  std::set<int> joined;
  for (Eigen::Index k = 0; k < totals.size(); ++k) {
    selection.cases.push_back(
        select_for_case(fractions.col(k), totals[k], options));
    joined.insert(selection.cases.back().begin(), selection.cases.back().end());
  }
  selection.modes.assign(joined.begin(), joined.end());
  selection.reached = VectorX::Ones(totals.size());
  for (Eigen::Index k = 0; k < totals.size(); ++k) {
    if (totals[k] == 0.0) continue;
    selection.reached[k] =
        sum_of(fractions.col(k), selection.modes) / totals[k];
    selection.complete =
        selection.complete &&
        selection.reached[k] >= options.threshold - roundoff(fractions.rows());
  }
  return selection;
}

VectorX calc_static_error(const MatrixX& compliance, const VectorX& totals,
                          const std::vector<int>& modes) {
  LIMBER_EXPECT(compliance.cols() == totals.size());
  VectorX errors = VectorX::Zero(totals.size());
  for (Eigen::Index k = 0; k < totals.size(); ++k) {
    if (totals[k] == 0.0) continue;
    const double missed = 1.0 - sum_of(compliance.col(k), modes) / totals[k];
    errors[k] = std::sqrt(std::max(0.0, missed));  // roundoff
  }
  return errors;
}

HarmonicError calc_harmonic_error(double static_error, double lambda_cut,
                                  double omega) {
  LIMBER_EXPECT(static_error >= 0.0 && lambda_cut > 0.0);
  const double ratio = omega * omega / lambda_cut;
  if (!(ratio < 1.0))
    throw InputError(fmt::format(
        "mode selection: the load vibrates at {:g} rad/s, but modes from {:g} "
        "rad/s on are left out, which it drives near or above resonance. Keep "
        "more modes.",
        omega, std::sqrt(lambda_cut)));
  return {static_error / (1.0 - ratio), static_error * ratio / (1.0 - ratio)};
}

MatrixX calc_mode_displacement(const MatrixX& Phi, const MatrixX& eta) {
  LIMBER_EXPECT(Phi.cols() == eta.rows());
  return Phi * eta;
}

MatrixX calc_mode_acceleration(const MatrixX& Phi, const VectorX& lambda,
                               const MatrixX& eta, const MatrixX& modal_loads,
                               const MatrixX& static_answers) {
  LIMBER_EXPECT(Phi.cols() == lambda.size() && eta.rows() == lambda.size());
  LIMBER_EXPECT(modal_loads.rows() == eta.rows() &&
                modal_loads.cols() == eta.cols());
  LIMBER_EXPECT(static_answers.rows() == Phi.rows() &&
                static_answers.cols() == eta.cols());
  const MatrixX moving = eta - lambda.cwiseInverse().asDiagonal() * modal_loads;
  return static_answers + Phi * moving;
}

ReducedBasis augment_basis(const ReducedBasis& basis, const SparseMatrix& M_s,
                           const VectorX& load, const VectorX& static_answer,
                           double drop_tolerance) {
  const MatrixX& Phi = basis.Phi;
  LIMBER_EXPECT(Phi.cols() == basis.lambda.size());
  LIMBER_EXPECT(load.size() == Phi.rows() &&
                static_answer.size() == Phi.rows());
  const auto square = [&](const VectorX& v) {
    return v.dot(multiply_mass(M_s, v).col(0));
  };
  const VectorX modal_load = Phi.transpose() * load;
  const VectorX x =
      static_answer - Phi * modal_load.cwiseQuotient(basis.lambda);
  const double mass = square(x);
  const double tolerance = drop_tolerance * drop_tolerance;
  if (mass <= tolerance * square(static_answer)) return basis;
  const double energy = x.dot(load);
  if (!(energy > 0.0))
    throw NumericalError(fmt::format(
        "residual vector: its stiffness is {:g} J, not positive. Is the static "
        "answer that of this load, without rigid motion?",
        energy));
  ReducedBasis augmented{VectorX(basis.lambda.size() + 1),
                         MatrixX(Phi.rows(), Phi.cols() + 1)};
  augmented.lambda << basis.lambda, energy / mass;
  augmented.Phi << Phi, x / std::sqrt(mass);
  return augmented;
}

}  // namespace limber::flexbody
