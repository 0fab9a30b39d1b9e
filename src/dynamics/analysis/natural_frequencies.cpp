// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/natural_frequencies.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/newton/force_balance.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Columns orthogonal to Q's of full rank.
MatrixX find_complement(const MatrixX& Q) {
  if (Q.cols() == 0) return MatrixX::Identity(Q.rows(), Q.rows());
  const Eigen::HouseholderQR<MatrixX> qr(Q);
  const MatrixX all = qr.householderQ() * MatrixX::Identity(Q.rows(), Q.rows());
  return all.rightCols(Q.rows() - Q.cols());
}

/// Null space of the rows, normalised to unit length.
MatrixX find_null_space(MatrixX rows) {
  constexpr double kDependent = 1e-10;
  rows.rowwise().normalize();
  const Index n = rows.cols();
  if (rows.rows() == 0) return MatrixX::Identity(n, n);
  Eigen::ColPivHouseholderQR<MatrixX> qr(rows.transpose());
  qr.setThreshold(kDependent);
  const MatrixX all = qr.householderQ() * MatrixX::Identity(n, n);
  return all.rightCols(n - qr.rank());
}

/// Small motion in coordinates with M = 1, free ones first.
struct Basis {
  MatrixX Q;
  Index free = 0;
  Index drift = 0;  ///< of these, translations of an untied system
};

/// Translations of all bodies together, if nothing ties them to the world.
MatrixX find_drift(const SystemModel& model, const SmallMotion& motion) {
  std::size_t free = 0;
  for (const auto& group : find_free_groups(model)) free += group.size();
  MatrixX drift(motion.size(), 0);
  if (free < model.bodies.size()) return drift;
  drift = MatrixX::Zero(motion.size(), 3);
  for (const Index p : motion.places) {
    if (p >= 0) drift.block<3, 3>(p, 0).setIdentity();
  }
  return drift;
}

/// Separates the null space of S, and diagonalises the symmetric part of S in
/// the rest.
Basis find_basis(const SystemModel& model, const SmallMotion& motion) {
  constexpr double kNothing = 1e-9;
  constexpr double kSafety = 10.0;  // of round-off
  const Index n = motion.size();
  const Eigen::LLT<MatrixX> mass(motion.M);
  LIMBER_EXPECT(mass.info() == Eigen::Success);
  const MatrixX to_x =
      mass.matrixU().solve(MatrixX::Identity(n, n));  // M = U' U
  MatrixX drift = find_drift(model, motion);
  if (drift.cols() > 0) {  // separate: momentum is conserved
    const Eigen::HouseholderQR<MatrixX> qr(mass.matrixU() * drift);
    drift = qr.householderQ() * MatrixX::Identity(n, drift.cols());
  }
  const MatrixX holds = motion.find_holds() * to_x;
  MatrixX rows(holds.rows() + drift.cols(), n);
  rows.topRows(holds.rows()) = holds;
  rows.bottomRows(drift.cols()) = drift.transpose();
  const MatrixX open = find_null_space(rows);
  MatrixX free = drift;
  if (open.cols() > 0) {
    const MatrixX rest = to_x.transpose() * motion.rest * to_x;
    const MatrixX noise = to_x.transpose() * motion.noise * to_x * open;
    const Eigen::BDCSVD<MatrixX> svd(rest * open, Eigen::ComputeFullV);
    const double least = kNothing * rest.norm() + kSafety * noise.norm();
    const Index resisted = (svd.singularValues().array() > least).count();
    const Index loose = open.cols() - resisted;
    free.conservativeResize(n, drift.cols() + loose);
    free.rightCols(loose) = open * svd.matrixV().rightCols(loose);
  }
  if (free.cols() == n) return {to_x * free, n, drift.cols()};
  const MatrixX other = to_x * find_complement(free);
  const MatrixX S = motion.project_stiffness(other);
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(0.5 * (S + S.transpose()));
  Basis basis{MatrixX(n, n), free.cols(), drift.cols()};
  basis.Q << to_x * free, other * eigen.eigenvectors();
  return basis;
}

/// x' = u, u' = -S x - D u without drift; positions of free coordinates are
/// irrelevant, the others are scaled by their frequencies.
struct FirstOrder {
  FirstOrder(const SmallMotion& motion, const Basis& basis) {
    const Index n = motion.size() - basis.drift;
    const Index held = motion.size() - basis.free;
    Q = basis.Q.rightCols(n);
    const MatrixX S = motion.project_stiffness(Q);
    const VectorX sizes = S.diagonal().tail(held).cwiseAbs().cwiseSqrt();
    const double least = held > 0 ? 1e-6 * sizes.maxCoeff() : 0.0;
    const VectorX scale = sizes.cwiseMax(least > 0.0 ? least : 1.0);
    A = MatrixX::Zero(held + n, held + n);
    A.topRightCorner(held, held) = scale.asDiagonal();
    A.block(held, 0, n, held) =
        -S.rightCols(held) * scale.cwiseInverse().asDiagonal();
    A.block(held, held, n, n) = -Q.transpose() * motion.D * Q;
  }
  MatrixX Q;  // of velocities
  MatrixX A;
};

struct Candidate {
  TurningAxes axes;
  SmallMotion motion;
  Basis basis;
  double change = 0.0;
};

/// For velocities u in the basis: (u* i around u) / (u* all u) measures their
/// rotation around an axis, -1 to 1.
struct Orbit {
  MatrixX around;
  MatrixX all;
};

Orbit make_orbit(const SystemModel& model, const SystemState& state,
                 const Candidate& c, const Vector3& spin_W, const MatrixX& Q) {
  const SmallMotion& motion = c.motion;
  const Vector3 e_W = spin_W.normalized();
  const Matrix3 turn = skew(c.axes.R.transpose() * e_W);
  MatrixX around = MatrixX::Zero(motion.size(), motion.size());
  MatrixX all = around;
  for (std::size_t b = 0; b < motion.places.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const Index p = motion.places[b];
    if (p >= 0) {
      const double inertia = body.J0.trace() / 3.0;
      around.block<3, 3>(p, p) = -body.mass * turn;
      around.block<3, 3>(p + 3, p + 3) = -inertia * turn;
      all.block<3, 3>(p, p).diagonal().setConstant(body.mass);
      all.block<3, 3>(p + 3, p + 3).diagonal().setConstant(inertia);
    }
    const Index m = motion.modes[b];
    const Vector3 e_B = state.bodies[b].quat_WB.conjugate() * e_W;
    for (Index k = 0; k < body.modes; ++k) {
      all(m + k, m + k) = 1.0;
      for (Index l = 0; l < body.modes; ++l) {
        around(m + k, m + l) =
            e_B.dot(body.inertia->beta.block<3, 1>(3 * l, k));
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
  const Eigen::MatrixXcd L = all.llt().matrixL();
  const auto lower = L.triangularView<Eigen::Lower>();
  const Eigen::MatrixXcd half = lower.solve(around);
  const Eigen::MatrixXcd form = lower.solve(half.adjoint());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(form,
                                                         Eigen::EigenvaluesOnly)
      .eigenvalues()
      .reverse();
}

/// Largest change from one small motion to another, each term relative to those
/// of its kind in the first at its frequencies and at `spin` [rad/s].
double measure_change(const SmallMotion& a, const SmallMotion& b,
                      const Basis& basis, double spin) {
  const MatrixX& Q = basis.Q;
  const MatrixX S = a.project_stiffness(Q);
  const VectorX slow =
      S.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(spin).cwiseInverse();
  const VectorX root = slow.cwiseSqrt();
  const MatrixX dS =
      slow.asDiagonal() * (b.project_stiffness(Q) - S) * slow.asDiagonal();
  const MatrixX dD =
      root.asDiagonal() * (Q.transpose() * (b.D - a.D) * Q) * root.asDiagonal();
  const MatrixX dM = Q.transpose() * (b.M - a.M) * Q;
  return std::max({dS.cwiseAbs().maxCoeff(), dD.cwiseAbs().maxCoeff(),
                   dM.cwiseAbs().maxCoeff()});
}

Candidate linearise(const SystemModel& model, const SystemState& state,
                    const Vector3& w_W, const Vector3& spin_W) {
  Candidate c;
  c.axes.w_W = w_W;
  c.motion = find_small_motion(model, state, c.axes);
  c.basis = find_basis(model, c.motion);
  if (spin_W.isZero(0.0)) return c;
  const double time = 1.0 / spin_W.norm();
  const TurningAxes later{exp_rotation(time * w_W), w_W};
  const SystemState then = advance_steadily(model, state, c.axes, time);
  c.change = measure_change(c.motion, find_small_motion(model, then, later),
                            c.basis, spin_W.norm());
  return c;
}

Candidate choose(const SystemModel& model, const SystemState& state) {
  constexpr double kSame = 1e-6;
  const Vector3 spin = find_fastest_spin(state);
  Candidate still = linearise(model, state, Vector3::Zero(), spin);
  if (spin.isZero(0.0) || still.change <= kSame) return still;
  Candidate turning = linearise(model, state, spin, spin);
  return turning.change < still.change ? turning : still;
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

void add_oscillations(const SystemModel& model, const SystemState& state,
                      const Candidate& c, NaturalModes& found) {
  constexpr double kNothing = 1e-11;   // of the fastest
  constexpr double kOfTheSpin = 1e-7;  // for double zeros
  const FirstOrder first(c.motion, c.basis);
  if (first.A.rows() == 0) return;
  const Vector3 spin = find_fastest_spin(state);
  const bool turns = !spin.isZero(0.0);
  const Eigen::EigenSolver<MatrixX> eigen(first.A, turns);
  const auto& values = eigen.eigenvalues();
  const double least = std::max(kNothing * values.cwiseAbs().maxCoeff(),
                                kOfTheSpin * spin.norm());
  Index coasting = c.basis.free - c.basis.drift;  // free velocities
  std::vector<NaturalMode> around;
  std::vector<Index> columns;
  for (Index i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= least) {
      if (coasting-- <= 0) found.modes.emplace_back();
    } else if (values[i].imag() == 0.0 || (!turns && values[i].imag() > 0.0)) {
      found.modes.push_back({values[i], 0.0});
    } else if (values[i].imag() > 0.0) {
      around.push_back({values[i], 0.0});
      columns.push_back(i);
    }
  }
  if (around.empty()) return;
  const Eigen::MatrixXcd all = eigen.eigenvectors();
  add_orbits(make_orbit(model, state, c, spin, first.Q),
             all.bottomRows(first.Q.cols())(Eigen::all, columns), around);
  found.modes.insert(found.modes.end(), around.begin(), around.end());
}

/// At rest and undamped: from the diagonal of the basis.
void add_frequencies(const Candidate& c, NaturalModes& found) {
  const VectorX squares = c.motion.project_stiffness(c.basis.Q).diagonal().tail(
      c.motion.size() - c.basis.free);
  for (const double s : squares) {
    const double w = std::sqrt(std::abs(s));
    if (s < 0.0) {
      found.modes.push_back({w, 0.0});
      found.modes.push_back({-w, 0.0});
    } else {
      found.modes.push_back({{0.0, w}, 0.0});
    }
  }
}

bool is_conservative(const Candidate& c) {
  constexpr double kSame = 1e-12;
  const MatrixX S = c.motion.project_stiffness(c.basis.Q);
  return c.motion.D.isZero(0.0) &&
         (S - S.transpose()).norm() <= kSame * S.norm();
}

}  // namespace

double NaturalMode::frequency() const { return std::abs(value) / kTurn; }

double NaturalMode::damping_ratio() const {
  return is_free() ? 0.0 : -value.real() / std::abs(value) + 0.0;
}

NaturalModes find_natural_modes(const SystemModel& model,
                                const SystemState& state) {
  NaturalModes found;
  found.is_moving = moves(state);
  const Candidate c = choose(model, state);
  if (c.motion.size() == 0) return found;
  found.axes = c.axes;
  found.change = c.change;
  found.imbalance = find_imbalance(model, state, c.axes);
  found.modes.resize(static_cast<std::size_t>(c.basis.free));
  if (!found.is_moving && is_conservative(c)) {
    add_frequencies(c, found);
  } else {
    add_oscillations(model, state, c, found);
  }
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
  const Basis basis = find_basis(model, motion);
  VectorX f = motion.project_stiffness(basis.Q).diagonal();
  f.head(basis.free).setZero();
  for (double& x : f) x = std::copysign(std::sqrt(std::abs(x)), x) / kTurn;
  std::sort(f.begin(), f.end());
  return f;
}

}  // namespace limber::dynamics
