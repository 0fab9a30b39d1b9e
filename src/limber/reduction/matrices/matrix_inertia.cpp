// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_inertia.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/flexbody/modal/decision_boundary.hpp"
#include "limber/reduction/matrices/nonnegative.hpp"

namespace limber::flexbody {
namespace {

constexpr double kSilentDefect = 1e-2;  // of blocks, where a fit is no better
constexpr double kMostDefect = 0.1;
constexpr double kSilentResidual = 1e-3;
constexpr double kMostResidual = 0.02;

/// Translations by themselves of nodes with rows, 3N x m.
MatrixX take_translations(const MatrixSystem& system, const MatrixX& Phi) {
  MatrixX taken = MatrixX::Zero(
      3 * static_cast<Eigen::Index>(system.tags.size()), Phi.cols());
  for (Eigen::Index i = 0; i < Phi.rows(); ++i) {
    const fem::MatrixRow& row = system.rows[static_cast<std::size_t>(i)];
    if (row.node >= 0 && row.component >= 0 && row.component < 3)
      taken.row(3 * row.node + row.component) = Phi.row(i);
  }
  return taken;
}

Matrix3X by_point(const VectorX& column) {
  return column.reshaped(3, column.size() / 3);
}

/// @param S2 by the blocks
BlockDefects find_defects(const MatrixPart& part, const MatrixX& Phi,
                          const std::vector<Matrix3>& S2) {
  BlockDefects defects;
  defects.inertia = part.block_defect;
  const MatrixX u = take_translations(part.system, Phi);
  const fem::SparseMatrix scalar = find_scalar_mass(part.blocks);
  const auto m = static_cast<std::size_t>(Phi.cols());
  for (std::size_t k = 0; k < m; ++k) {
    const VectorX u_k = u.col(static_cast<Eigen::Index>(k));
    // phi^T M phi = 1
    defects.motion =
        std::max(defects.motion, std::abs(S2[k * m + k].trace() - 1.0));
    const Matrix3X U = by_point(u_k);
    const Matrix3X Wu = by_point(part.blocks.tt * u_k);
    const Matrix3 whole = 0.5 * (U * Wu.transpose() + Wu * U.transpose());
    const Matrix3 isotropic = U * (scalar * U.transpose());
    defects.shape =
        std::max(defects.shape, (whole - isotropic).cwiseAbs().maxCoeff());
  }
  return defects;
}

/// Points with three translations: places from the centre of mass and modes.
struct MassPoints {
  Matrix3X x;
  MatrixX u;  // 3P x m
};

MassPoints list_mass_points(const MatrixPart& part, const MatrixX& fields) {
  const MatrixSystem& system = part.system;
  std::vector<int> nodes;
  for (int n = 0; n < static_cast<int>(system.tags.size()); ++n)
    if (system.is_moving[static_cast<std::size_t>(n)]) nodes.push_back(n);
  MassPoints points{
      Matrix3X(system.x(Eigen::all, nodes)).colwise() - part.inertia.center,
      MatrixX(3 * std::ssize(nodes), fields.cols())};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.u.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        fields.middleRows<3>(field_row(nodes[i], 0));
  return points;
}

VectorX take_upper(const MatrixX& A) {
  VectorX upper(A.rows() * (A.rows() + 1) / 2);
  Eigen::Index at = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i <= j; ++i) upper[at++] = A(i, j);
  return upper;
}

/// Masses of the points whose kinetic energy in rigid motions and modes is most
/// nearly that of M.
NonnegativeFit fit_point_masses(const MatrixPart& part, const MatrixX& Phi,
                                const MassPoints& points) {
  // All columns in metres, of about the same size.
  const double root = std::sqrt(part.inertia.mass);
  const double radius =
      std::sqrt(0.5 * part.inertia.J0.trace() / part.inertia.mass);
  const Eigen::Index m = Phi.cols();
  MatrixX all(Phi.rows(), 6 + m);
  all << part.X.leftCols<3>(), part.X.rightCols<3>() / radius, root * Phi;
  const VectorX energy =
      take_upper(all.transpose() * fem::multiply_mass(part.system.M, all));
  MatrixX each(energy.size(), points.x.cols());
  MatrixX Y(3, 6 + m);
  for (Eigen::Index p = 0; p < points.x.cols(); ++p) {
    Y << Matrix3::Identity(), -skew(Vector3(points.x.col(p))) / radius,
        root * points.u.middleRows<3>(3 * p);
    each.col(p) = take_upper(Y.transpose() * Y);
  }
  return fit_nonnegative(each, energy);
}

fem::SparseMatrix make_diagonal(const VectorX& masses) {
  fem::SparseMatrix M(masses.size(), masses.size());
  M.setIdentity();
  M.diagonal() = masses;
  return M;
}

InertialLevers find_levers_of_points(const MatrixPart& part,
                                     const ReducedBasis& basis,
                                     const MatrixX& Phi,
                                     const MatrixX& fields) {
  const MassPoints points = list_mass_points(part, fields);
  const NonnegativeFit fit = fit_point_masses(part, Phi, points);
  return calc_inertial_levers(make_diagonal(fit.x), points.x, points.u,
                              basis.lambda);
}

/// S1 and S2 of the points; the rest of `integrals` remains.
void sum_points(const MassPoints& points, const VectorX& masses,
                const MatrixX& moments, InertiaShapeIntegrals& integrals) {
  const auto m = static_cast<std::size_t>(points.u.cols());
  const auto weigh = [&](const Matrix3X& u) {
    return Matrix3X(u * masses.asDiagonal());
  };
  for (std::size_t k = 0; k < m; ++k) {
    const Matrix3X mu =
        weigh(by_point(points.u.col(static_cast<Eigen::Index>(k))));
    const Matrix3 S1 = points.x * mu.transpose();
    const Vector3 h = moments.block<3, 1>(3, static_cast<Eigen::Index>(k));
    integrals.S1[k] = 0.5 * (S1 + S1.transpose()) - 0.5 * skew(h);
    for (std::size_t l = 0; l < m; ++l)
      integrals.S2[k * m + l] =
          mu * by_point(points.u.col(static_cast<Eigen::Index>(l))).transpose();
  }
}

/// A^T S_ab B = int a_a b_b dm of two fields.
Matrix3 calc_moment(const MatrixSystem& system, const VectorX& a,
                    const VectorX& b) {
  constexpr std::array<std::array<int, 2>, 6> kPlaces = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  Matrix3 moment;
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const auto [p, q] = kPlaces[i];
    moment(p, q) = a.dot(system.moments[i] * b);
    if (p != q) moment(q, p) = b.dot(system.moments[i] * a);
  }
  return moment;
}

/// S1 and S2 by the second moments of M; the rest of `integrals` remains.
void integrate_moments(const MatrixPart& part, const MatrixX& Phi,
                       InertiaShapeIntegrals& integrals) {
  const auto m = static_cast<std::size_t>(Phi.cols());
  const auto mode = [&](std::size_t k) {
    return VectorX(Phi.col(static_cast<Eigen::Index>(k)));
  };
  for (std::size_t k = 0; k < m; ++k) {
    // e_z x x = (-y, x, 0), and so on: row of x_a in a rotation's moment.
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const VectorX rotation = part.X.col(3 + (a + 2) % 3);
      integrals.S1[k].row(a) =
          calc_moment(part.system, rotation, mode(k)).row(b);
    }
    for (std::size_t l = 0; l < m; ++l)
      integrals.S2[k * m + l] = calc_moment(part.system, mode(k), mode(l));
  }
}

std::string describe_motion(const BlockDefects& defects) {
  if (defects.motion >= kMostDefect || defects.motion == defects.largest())
    return fmt::format(
        "the nodes' blocks of the mass matrix miss the kinetic energy of a "
        "mode "
        "by {:.2g} of it; the rest is in rows without a node, as a "
        "superelement's generalized coordinates",
        defects.motion);
  if (defects.shape == defects.largest())
    return fmt::format(
        "the nodes' blocks of the mass matrix differ by direction, which makes "
        "{:.2g} of a mode's kinetic energy, as if inner nodes had been "
        "condensed (Guyan)",
        defects.shape);
  return fmt::format(
      "moments of inertia by the nodes' blocks of the mass matrix differ by "
      "{:.2g} from those of rigid rotation, as if inner nodes had been "
      "condensed (Guyan), elements are too few, or a mass on an averaging "
      "connection (RBE3) was condensed into many nodes",
      defects.inertia);
}

std::string describe_gap(const MatrixPart& part, const BlockDefects& defects,
                         double residual) {
  const std::string start = fmt::format(
      "{}: {}, so that the matrices do not determine how the mass moves",
      part.system.source, describe_motion(defects));
  if (!part.system.has_recovery)
    return start +
           "; give the recovery rows of inner points (--recovery), or the "
           "matrices of all nodes";
  return start +
         fmt::format(
             ", and no masses at the recovered points have its inertia (their "
             "residual is {:.2g}; at most {:g} is taken); recover points off "
             "the axis, on all sides, and more of them",
             residual, kMostResidual);
}

}  // namespace

double BlockDefects::largest() const {
  return std::max({motion, shape, inertia});
}

MatrixInertia find_matrix_inertia(const MatrixPart& part,
                                  const ReducedBasis& basis, const MatrixX& Phi,
                                  const MatrixX& fields, bool is_clamped) {
  const MatrixSystem& system = part.system;
  MatrixInertia found;
  found.integrals = calc_block_integrals(system, part.blocks, part.X, Phi);
  if (is_clamped) return found;
  const BlockDefects defects = find_defects(part, Phi, found.integrals.S2);
  const double defect = defects.largest();
  const auto find_levers_of_nodes = [&] {
    return calc_inertial_levers(find_scalar_mass(part.blocks),
                                system.x.colwise() - part.inertia.center,
                                take_translations(system, Phi), basis.lambda);
  };
  if (system.has_moments()) {
    found.levers = defect < kMostDefect
                       ? find_levers_of_nodes()
                       : find_levers_of_points(part, basis, Phi, fields);
    integrate_moments(part, Phi, found.integrals);
    return found;
  }
  double residual = 1.0;
  if (defect >= kSilentDefect && system.has_recovery) {
    const MassPoints points = list_mass_points(part, fields);
    const NonnegativeFit fit = fit_point_masses(part, Phi, points);
    residual = fit.residual;
    if (residual < std::min(kMostResidual, defect)) {
      const MatrixX moments =
          part.X.transpose() * fem::multiply_mass(system.M, Phi);
      sum_points(points, fit.x, moments, found.integrals);
      found.levers = calc_inertial_levers(make_diagonal(fit.x), points.x,
                                          points.u, basis.lambda);
      if (residual >= kSilentResidual)
        found.record.notice = fmt::format(
            "{}: masses at the recovered points have the inertia of the mass "
            "matrix to {:.2g}, and the coupling of large rotation and "
            "deformation has an error of some times that size; recover more "
            "points",
            system.source, residual);
      return found;
    }
  }
  if (defect >= kMostDefect) {
    found.record.gap = describe_gap(part, defects, residual);
    for (std::vector<Matrix3>* S : {&found.integrals.S1, &found.integrals.S2})
      std::fill(S->begin(), S->end(), Matrix3::Zero());
    return found;
  }
  found.levers = find_levers_of_nodes();
  if (std::max(defects.motion, defects.shape) >= kSilentDefect)
    found.record.notice = fmt::format(
        "{}: {}; the coupling of large rotation and deformation has an error "
        "of some times that size",
        system.source, describe_motion(defects));
  return found;
}

}  // namespace limber::flexbody
