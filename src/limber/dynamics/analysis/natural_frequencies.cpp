// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/natural_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/steady_linearisation.hpp"
#include "limber/dynamics/analysis/stiff_joints.hpp"
#include "limber/dynamics/newton/force_balance.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// x' = u, u' = -S x - D u - E' y, y' = E u - y / tau, without drift; positions
/// of free coordinates are irrelevant, the others are scaled by their
/// frequencies.
struct FirstOrder {
  FirstOrder(const SmallMotion& motion, const PrincipalBasis& basis) {
    const Index n = motion.size() - basis.drift;
    const Index held = motion.size() - basis.free;
    Q = basis.Q.rightCols(n);
    const MatrixX S = motion.project_stiffness(Q);
    const VectorX sizes = S.diagonal().tail(held).cwiseAbs().cwiseSqrt();
    const double least = held > 0 ? 1e-6 * sizes.maxCoeff() : 0.0;
    const VectorX scale = sizes.cwiseMax(least > 0.0 ? least : 1.0);
    const MatrixX E = motion.project_relaxations(Q);
    const Index r = E.rows();
    A = MatrixX::Zero(held + n + r, held + n + r);
    A.block(held, held + n, n, r) = -E.transpose();
    A.block(held + n, held, r, n) = E;
    A.diagonal().tail(r) = -motion.relaxation_rates();
    A.block(0, n, held, held) = scale.asDiagonal();
    A.block(held, 0, n, held) =
        -S.rightCols(held) * scale.cwiseInverse().asDiagonal();
    A.block(held, held, n, n) = -Q.transpose() * motion.D * Q;
  }
  MatrixX Q;  // of velocities
  MatrixX A;
};

/// Fraction of an eigenvector's energy in Maxwell elements: nearly 1 of the
/// material's relaxation, which is not a mode, and small of all others [-].
double find_relaxing_fraction(const Eigen::VectorXcd& x, Index elements) {
  return x.tail(elements).squaredNorm() / x.squaredNorm();
}

/// For velocities u in the basis: (u* i around u) / (u* all u) measures their
/// rotation around an axis, -1 to 1.
struct Orbit {
  MatrixX around;
  MatrixX all;
};

Orbit make_orbit(const SystemModel& model, const SystemState& state,
                 const SteadyMotion& c, const Vector3& spin_W,
                 const MatrixX& Q) {
  const SmallMotion& motion = c.motion;
  const Vector3 e_W = spin_W.normalized();
  const Matrix3 rotation = skew(c.axes.R.transpose() * e_W);
  MatrixX around = MatrixX::Zero(motion.size(), motion.size());
  MatrixX all = around;
  for (const BodyIndex of : motion.bodies) {
    const std::size_t b = index(of);
    const BodyModel& body = model.bodies[b];
    const Index p = motion.places[b];
    if (p >= 0) {
      const double inertia = body.J0.trace() / 3.0;
      around.block<3, 3>(p, p) = -body.mass * rotation;
      around.block<3, 3>(p + 3, p + 3) = -inertia * rotation;
      all.block<3, 3>(p, p).diagonal().setConstant(body.mass);
      all.block<3, 3>(p + 3, p + 3).diagonal().setConstant(inertia);
    }
    const Index m = motion.modes[b];
    const Vector3 e_B = state.bodies[b].quat_WB.conjugate() * e_W;
    for (Index k = 0; k < body.modes; ++k) {
      all(m + k, m + k) = 1.0;
      for (Index l = 0; l < body.modes; ++l) {
        around(m + k, m + l) = e_B.dot(body.inertia->beta(k).row(l));
      }
    }
  }
  return {Q.transpose() * around * Q, Q.transpose() * all * Q};
}

/// Extreme orbits of modes of one eigenvalue over all their combinations, the
/// largest first.
VectorX find_orbits(const Orbit& orbit, const Eigen::MatrixXcd& u) {
  const std::complex<double> i(0.0, 1.0);
  const Eigen::MatrixXcd around = u.adjoint() * (i * (orbit.around * u));
  const Eigen::MatrixXcd all = u.adjoint() * (orbit.all * u);
  const Eigen::MatrixXcd L = dense::find_cholesky(all);
  const Eigen::MatrixXcd half = dense::solve_lower(L, around);
  const Eigen::MatrixXcd form =
      dense::solve_lower(L, Eigen::MatrixXcd(half.adjoint()));
  return dense::find_eigenvalues(form).reverse();
}

/// Modes of one eigenvalue, within round-off, share their orbits.
void add_orbits(const Orbit& orbit, const Eigen::MatrixXcd& u,
                std::vector<NaturalMode>& modes) {
  constexpr double kSame = 1e-7;
  std::vector<Index> left(modes.size());
  std::iota(left.begin(), left.end(), Index{0});
  while (!left.empty()) {
    const std::complex<double> value =
        modes[static_cast<std::size_t>(left.front())].value;
    const auto others =
        std::stable_partition(left.begin(), left.end(), [&](Index i) {
          return std::abs(modes[static_cast<std::size_t>(i)].value - value) <=
                 kSame * std::abs(value);
        });
    const std::vector<Index> group(left.begin(), others);
    const VectorX orbits = find_orbits(orbit, u(Eigen::all, group));
    for (std::size_t i = 0; i < group.size(); ++i) {
      modes[static_cast<std::size_t>(group[i])].orbit =
          orbits[static_cast<Index>(i)];
    }
    left.erase(left.begin(), others);
  }
}

NaturalMode make_mode(std::complex<double> value) {
  NaturalMode mode;
  mode.value = value;
  return mode;
}

void add_oscillations(const SystemModel& model, const SystemState& state,
                      const SteadyMotion& c, std::vector<NaturalMode>& modes) {
  constexpr double kNothing = 1e-11;   // of the group's fastest
  constexpr double kOfTheSpin = 1e-7;  // for double zeros
  constexpr double kRelaxing = 0.5;
  const FirstOrder first(c.motion, c.basis);
  if (first.A.rows() == 0) return;
  const Vector3 spin = find_fastest_spin(state, c.motion.bodies);
  const bool rotates = !spin.isZero(0.0);
  const Index elements = c.motion.relaxation_rates().size();
  const auto eigen =
      dense::find_general_eigenpairs(first.A, rotates || elements > 0);
  const auto& values = eigen.values;
  const double least = std::max(kNothing * values.cwiseAbs().maxCoeff(),
                                kOfTheSpin * spin.norm());
  Index coasting = c.basis.free - c.basis.drift;  // free velocities
  std::vector<NaturalMode> around;
  std::vector<Index> columns;
  for (Index i = 0; i < values.size(); ++i) {
    if (elements > 0 &&
        find_relaxing_fraction(eigen.vectors.col(i), elements) > kRelaxing) {
      continue;
    }
    if (std::abs(values[i]) <= least) {
      if (coasting-- <= 0) modes.emplace_back();
    } else if (values[i].imag() == 0.0 ||
               (!rotates && values[i].imag() > 0.0)) {
      modes.push_back(make_mode(values[i]));
    } else if (values[i].imag() > 0.0) {
      around.push_back(make_mode(values[i]));
      columns.push_back(i);
    }
  }
  if (around.empty()) return;
  add_orbits(make_orbit(model, state, c, spin, first.Q),
             eigen.vectors.middleRows(values.size() - elements - first.Q.cols(),
                                      first.Q.cols())(Eigen::all, columns),
             around);
  modes.insert(modes.end(), around.begin(), around.end());
}

/// At rest and undamped: from the diagonal of the basis.
void add_frequencies(const SteadyMotion& c, std::vector<NaturalMode>& modes) {
  const VectorX squares = c.motion.project_squares(
      c.basis.Q.rightCols(c.motion.size() - c.basis.free));
  for (const double s : squares) {
    const double w = std::sqrt(std::abs(s));
    if (s < 0.0) {
      modes.push_back(make_mode(w));
      modes.push_back(make_mode(-w));
    } else {
      modes.push_back(make_mode({0.0, w}));
    }
  }
}

std::vector<NaturalMode> find_group_modes(const SystemModel& model,
                                          const SystemState& state,
                                          const SteadyMotion& c) {
  std::vector<NaturalMode> modes(static_cast<std::size_t>(c.basis.free));
  const bool is_moving = moves(model, state, c.motion.bodies);
  if (!is_moving && is_conservative(c.motion, c.basis)) {
    add_frequencies(c, modes);
  } else {
    add_oscillations(model, state, c, modes);
  }
  return modes;
}

}  // namespace

double NaturalMode::frequency() const { return std::abs(value) / kTurn; }

double NaturalMode::damping_ratio() const {
  return is_free() ? 0.0 : -value.real() / std::abs(value) + 0.0;
}

NaturalModes find_natural_modes(const SystemModel& model,
                                const SystemState& state) {
  if (const auto stiff = replace_ideal_joints(model)) {
    return find_natural_modes(*stiff, state);
  }
  NaturalModes found;
  found.is_moving = moves(state);
  std::vector<Vector3> spins(model.bodies.size(), Vector3::Zero());
  for (const SteadyMotion& c : linearise_groups(model, state)) {
    const Vector3& w_W = c.axes.w_W;
    if (w_W.norm() > found.axes.w_W.norm()) found.axes = c.axes;
    found.change = std::max(found.change, c.change);
    for (const BodyIndex b : c.motion.bodies) spins[index(b)] = w_W;
    std::vector<NaturalMode> modes = find_group_modes(model, state, c);
    for (NaturalMode& mode : modes) mode.axes_w_W = w_W;
    found.modes.insert(found.modes.end(), modes.begin(), modes.end());
  }
  if (found.modes.empty()) return found;
  found.imbalance = find_imbalance(model, state, spins);
  std::stable_sort(found.modes.begin(), found.modes.end(),
                   [](const NaturalMode& a, const NaturalMode& b) {
                     return std::abs(a.value) < std::abs(b.value);
                   });
  return found;
}

VectorX find_natural_frequencies(const SystemModel& model,
                                 const SystemState& state) {
  const SmallMotion motion = find_small_motion(model, stop(state));
  if (motion.size() == 0) return {};
  const PrincipalBasis basis = find_principal_basis(model, motion);
  VectorX f = motion.project_stiffness(basis.Q).diagonal();
  f.head(basis.free).setZero();
  for (double& x : f) x = std::copysign(std::sqrt(std::abs(x)), x) / kTurn;
  std::sort(f.begin(), f.end());
  return f;
}

}  // namespace limber::dynamics
