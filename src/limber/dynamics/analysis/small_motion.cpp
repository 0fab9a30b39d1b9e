// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/small_motion.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/stiff_joints.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

// Just after loads that jump at the state's time.
SystemState just_after(const SystemState& state) {
  SystemState after = state;
  after.t = find_time_after(state.t);
  return after;
}

/// Derivatives of the equations of motion by the coordinates of the state:
/// positions in the world frame, rotations in the body frame.
class Derivatives {
 public:
  Derivatives(const SystemModel& model, const SystemState& state,
              const std::vector<AttachmentIndex>& frames, SmallMotion& out)
      : model_(model),
        state_(just_after(state)),
        frames_(frames),
        out_(out),
        terms_(make_terms(model)),
        acceleration_(make_unknowns(model)),
        no_motion_(acceleration_),
        derivative_(model) {
    list_coordinates();
    calc_terms(model, state_, Side::left, terms_);
    solve_accelerations(model, terms_, acceleration_);
  }

  /// Fills C into D, and the rest of K_q.
  void fill() {
    const Index n = std::ssize(rows_);
    out_.M = out_.D = MatrixX::Zero(n, n);
    out_.lambda = VectorX::Zero(n);
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) fill_body(b);
    fill_links();
    const Changes still = differentiate(0.0);
    const Changes moving = differentiate(1.0);
    out_.velocities = -still.laws;
    out_.velocities_by_rate = out_.G - (moving.laws - still.laws);
    out_.rest = still.residual + out_.G.transpose() * damp(out_.velocities);
    out_.D += moving.residual - still.residual +
              out_.G.transpose() * damp(out_.velocities_by_rate);
    out_.frames = still.frames;
    out_.frame_velocities = still.frame_velocities;
    out_.frame_velocities_by_rate =
        moving.frame_velocities - still.frame_velocities;
    fill_noise();
  }

 private:
  void list_coordinates() {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const BodyModel& body = model_.bodies[b];
      const Index row = body.row;
      out_.bodies.emplace_back(b);
      out_.places.push_back(body.has_rigid_motion() ? std::ssize(rows_) : -1);
      for (Index i = body.has_rigid_motion() ? 0 : 6; i < 6 + body.modes; ++i) {
        if (i == 6) break;
        rows_.push_back(row + i);
      }
      out_.modes.push_back(std::ssize(rows_));
      for (Index i = 0; i < body.modes; ++i) rows_.push_back(row + 6 + i);
    }
  }

  void fill_body(std::size_t b) {
    const BodyModel& body = model_.bodies[b];
    const BodyTerms& t = terms_.bodies[b];
    const Index m = out_.modes[b];
    for (Index k = 0; k < body.modes; ++k) {
      out_.M(m + k, m + k) = 1.0;
      out_.D(m + k, m + k) = body.damping[k];
    }
    fill_elasticity(b, m);
    fill_relaxations(body, m);
    const Index p = out_.places[b];
    if (p < 0) return;
    const Vector3& w = state_.bodies[b].w_WB_B;
    out_.M.block<3, 3>(p, p).diagonal().setConstant(body.mass);
    out_.M.block<3, 3>(p + 3, p + 3) = t.J;
    out_.M.block(p + 3, m, 3, body.modes) = t.H();
    out_.M.block(m, p + 3, body.modes, 3) = t.H().transpose();
    out_.D.block<3, 3>(p + 3, p + 3) = skew(w) * t.J - skew(t.J * w);
  }

  void fill_elasticity(std::size_t b, Index m) {
    const BodyModel& body = model_.bodies[b];
    if (!has_dense_modes(body)) {
      out_.lambda.segment(m, body.modes) =
          *flexbody::find_eigenvalues(body.elasticity);
      return;
    }
    MatrixX K(body.modes, body.modes);
    flexbody::calc_elastic_tangent(
        body.elasticity, state_.eta.segment(body.offset, body.modes), K);
    add_geometric_stiffness(model_, b, terms_, K);
    out_.coupled.push_back({m, std::move(K)});
  }

  void fill_relaxations(const BodyModel& body, Index m) {
    const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
    for (Index j = 0; j < body.maxwell.size(); ++j) {
      out_.relaxations.push_back(
          {m, (body.maxwell.strengths[j] * lambda).cwiseSqrt(),
           body.maxwell.times[j]});
    }
  }

  // Laws of unit stiffness change by minus the motions, those of unit damping
  // by minus the velocities.
  void fill_links() {
    for (CouplerTerms& c : terms_.couplers) {
      out_.K.push_back(c.response.stiffness);
      out_.damping.push_back(c.response.damping);
      c.response.stiffness.setIdentity();
    }
    for (TransmissionTerms& t : terms_.transmissions) {
      out_.K.emplace_back(Matrix6::Zero());
      out_.K.back()(0, 0) = t.response.stiffness;
      out_.damping.emplace_back(Matrix6::Zero());
      out_.damping.back()(0, 0) = t.response.damping;
      t.response.stiffness = 1.0;
    }
    NewtonMatrix matrix(model_);
    matrix.factor(model_, state_, terms_, no_motion_, {1.0, 0.0});
    const Index couplers = std::ssize(terms_.couplers);
    const auto links = std::ssize(out_.K);
    add_pair_stiffness();
    out_.G = MatrixX::Zero(6 * std::ssize(out_.K), std::ssize(rows_));
    VectorX changes;
    for (Index j = 0; j < out_.G.cols(); ++j) {
      matrix.find_wrench_changes(terms_, unit(j), changes);
      out_.G.col(j).head(6 * couplers) = -changes.head(6 * couplers);
      for (Index i = 0; i < std::ssize(terms_.transmissions); ++i) {
        out_.G(6 * (couplers + i), j) = -changes[6 * couplers + i];
      }
    }
    fill_pair_motions(6 * links);
    for (CouplerTerms& c : terms_.couplers) c.response.damping.setIdentity();
    for (TransmissionTerms& t : terms_.transmissions) t.response.damping = 1.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(links); ++i) {
      const auto t = static_cast<Index>(i) - couplers;
      if (t < 0) {
        terms_.couplers[i].response.stiffness = out_.K[i];
      } else {
        terms_.transmissions[static_cast<std::size_t>(t)].response.stiffness =
            out_.K[i](0, 0);
      }
    }
  }

  // A point of a pair is a link of three rows, over zeros.
  template <typename Visit>
  void for_each_point(const Visit& visit) const {
    for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
      for (const auto& point : terms_.pairs.responses[i].points()) {
        visit(model_.pairs[i], point);
      }
    }
  }

  // Coupled points count with a bound of all their stiffness.
  void add_pair_stiffness() {
    for (const joints::PairResponse& response : terms_.pairs.responses) {
      for (std::size_t p = 0; p < response.points().size(); ++p) {
        out_.K.emplace_back(Matrix6::Zero());
        out_.K.back().topLeftCorner<3, 3>() = response.find_stiffness_bound(p);
      }
    }
  }

  // The motion of a point by x is the work of a unit force there on x.
  void fill_pair_motions(Index row) {
    VectorX forces(count_unknowns(model_));
    for_each_point([&](const Pair& pair, const joints::PairPoint& point) {
      for (int i = 0; i < 3; ++i) {
        forces.setZero();
        add_residual(model_, pair, point, -Vector3::Unit(i), terms_, forces);
        out_.G.row(row + i) = forces(rows_).transpose();
      }
      row += 6;
    });
  }

  [[nodiscard]] MatrixX damp(const MatrixX& velocities) const {
    MatrixX forces(velocities.rows(), velocities.cols());
    Index row = 0;
    for (const Matrix6& C : out_.damping) {
      forces.middleRows<6>(row) = C * velocities.middleRows<6>(row);
      row += 6;
    }
    for_each_point([&](const Pair& /*pair*/, const joints::PairPoint& point) {
      forces.middleRows<3>(row) = point.damping * velocities.middleRows<3>(row);
      forces.middleRows<3>(row + 3).setZero();
      row += 6;
    });
    return forces;
  }

  // Changes by each coordinate, with velocities changing by `velocity` times
  // the positions: all terms without stiffness that are not yet in M and D,
  // laws as in ResidualDerivative, and the requested frames.
  struct Changes {
    MatrixX residual;
    MatrixX laws;
    MatrixX frames;
    MatrixX frame_velocities;
  };
  Changes differentiate(double velocity) {
    const Index n = std::ssize(rows_);
    Changes out{MatrixX(n, n), MatrixX::Zero(out_.G.rows(), n),
                MatrixX(6 * std::ssize(frames_), n),
                MatrixX(6 * std::ssize(frames_), n)};
    derivative_.set_point(state_, terms_, acceleration_, no_motion_,
                          {0.0, velocity});
    VectorX residual;
    std::vector<Vector6> laws;
    for (Index j = 0; j < n; ++j) {
      derivative_.apply_rest(unit(j), residual, laws);
      out.residual.col(j) = residual(rows_);
      for (std::size_t i = 0; i < laws.size(); ++i) {
        out.laws.block<6, 1>(6 * static_cast<Index>(i), j) = laws[i];
      }
      for (std::size_t i = 0; i < frames_.size(); ++i) {
        const auto& change = derivative_.frame_change(frames_[i]);
        const Index row = 6 * static_cast<Index>(i);
        out.frames.block<6, 1>(row, j) << change.p, change.phi;
        out.frame_velocities.block<6, 1>(row, j) << change.v, change.w;
      }
    }
    return out;
  }

  // Rotating forces are linear in the wrenches.
  void fill_noise() {
    std::vector<Vector6> gaps;
    find_roundoff_gaps(model_, terms_, 0.0, gaps);
    exert(gaps);
    out_.noise = differentiate(0.0).residual;
    for (Vector6& gap : gaps) gap.setZero();
    exert(gaps);
    out_.noise -= differentiate(0.0).residual;
  }

  void exert(const std::vector<Vector6>& wrenches) {
    for (std::size_t c = 0; c < terms_.couplers.size(); ++c) {
      terms_.couplers[c].applied = wrenches[c];
    }
    for (std::size_t i = 0; i < terms_.transmissions.size(); ++i) {
      terms_.transmissions[i].applied = wrenches[terms_.couplers.size() + i][0];
    }
  }

  [[nodiscard]] VectorX unit(Index j) const {
    return VectorX::Unit(count_unknowns(model_),
                         rows_[static_cast<std::size_t>(j)]);
  }

  const SystemModel& model_;
  SystemState state_;
  const std::vector<AttachmentIndex>& frames_;
  SmallMotion& out_;
  SystemTerms terms_;
  VectorX acceleration_;
  VectorX no_motion_;
  ResidualDerivative derivative_;
  std::vector<Index> rows_;  // of NewtonMatrix, one per coordinate
};

void check_levels(const SystemModel& model) {
  for (const FullModel& full : model.full_bodies) {
    throw InputError(fmt::format(
        "body '{}' is at level full, with {} coordinates of nodes: small "
        "motion has dense matrices, which exist only for reduced bodies. Use "
        "--fidelity coupled, with as many eigenmodes as the frequencies of "
        "interest need",
        model.bodies[static_cast<std::size_t>(full.body)].name, full.dofs()));
  }
}

// Directions in which a stiffness is not round-off, as columns.
// @param scale makes it independent of units and of soft directions
template <typename Square>
MatrixX find_held(const Square& K, const VectorX& scale) {
  constexpr double kRoundoff = 1e-13;
  const Index n = K.rows();
  const VectorX inverse =
      (scale.array() > 0.0).select(scale.cwiseInverse(), 0.0);
  const Square scaled =
      inverse.asDiagonal() * (0.5 * (K + K.transpose())) * inverse.asDiagonal();
  const auto eigen = dense::find_eigenpairs(scaled);
  MatrixX held(n, 0);
  for (Index i = 0; i < n; ++i) {
    if (std::abs(eigen.values[i]) <= kRoundoff) continue;
    held.conservativeResize(n, held.cols() + 1);
    held.rightCols<1>() = scale.asDiagonal() * eigen.vectors.col(i);
  }
  return held;
}

template <typename Square>
VectorX root_of_diagonal(const Square& K) {
  return K.diagonal().cwiseAbs().cwiseSqrt();
}

// A tangent that is not positive may have zeros on its diagonal only.
MatrixX find_held_modes(const MatrixX& K) {
  const VectorX scale = root_of_diagonal(K);
  const VectorX largest = K.cwiseAbs().rowwise().maxCoeff().cwiseSqrt();
  return find_held(K, (scale.array() > 0.0).select(scale, largest));
}

}  // namespace

MatrixX SmallMotion::project_stiffness(const MatrixX& Q) const {
  const MatrixX motions = G * Q;
  MatrixX forces(motions.rows(), motions.cols());
  for (std::size_t i = 0; i < K.size(); ++i) {
    const Index row = 6 * static_cast<Index>(i);
    forces.middleRows<6>(row) = K[i] * motions.middleRows<6>(row);
  }
  MatrixX S =
      Q.transpose() * (lambda.asDiagonal() * Q) + motions.transpose() * forces;
  if (!rest.isZero(0.0)) S += Q.transpose() * (rest * Q);
  for (const ModalBlock& block : coupled) {
    const auto rows = Q.middleRows(block.first, block.K.rows());
    S += rows.transpose() * (block.K * rows);
  }
  return S;
}

VectorX SmallMotion::project_strain(const MatrixX& Q) const {
  VectorX strain =
      (lambda.asDiagonal() * Q.cwiseAbs2()).colwise().sum().transpose();
  for (const ModalBlock& block : coupled) {
    const auto rows = Q.middleRows(block.first, block.K.rows());
    strain += rows.cwiseProduct(block.K * rows).colwise().sum().transpose();
  }
  return strain;
}

VectorX SmallMotion::project_squares(const MatrixX& Q) const {
  VectorX squares = project_strain(Q);
  const MatrixX motions = G * Q;
  for (std::size_t i = 0; i < K.size(); ++i) {
    const auto rows = motions.middleRows<6>(6 * static_cast<Index>(i));
    squares += rows.cwiseProduct(K[i] * rows).colwise().sum().transpose();
  }
  if (!rest.isZero(0.0)) {
    squares += Q.cwiseProduct(rest * Q).colwise().sum().transpose();
  }
  return squares;
}

MatrixX SmallMotion::find_holds() const {
  std::vector<VectorX> rows;
  for (Index i = 0; i < size(); ++i) {
    if (lambda[i] != 0.0) rows.emplace_back(VectorX::Unit(size(), i));
  }
  for (const ModalBlock& block : coupled) {
    const MatrixX held = find_held_modes(block.K);
    for (Index k = 0; k < held.cols(); ++k) {
      rows.emplace_back(VectorX::Zero(size()));
      rows.back().segment(block.first, held.rows()) = held.col(k);
    }
  }
  for (std::size_t i = 0; i < K.size(); ++i) {
    const MatrixX held = find_held(K[i], root_of_diagonal(K[i])).transpose() *
                         G.middleRows<6>(6 * static_cast<Index>(i));
    for (Index k = 0; k < held.rows(); ++k) {
      if (!held.row(k).isZero(0.0)) rows.emplace_back(held.row(k));
    }
  }
  MatrixX holds(std::ssize(rows), size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    holds.row(static_cast<Index>(i)) = rows[i];
  }
  return holds;
}

SmallMotion find_small_motion(const SystemModel& model,
                              const SystemState& state, const TurningAxes& axes,
                              const std::vector<AttachmentIndex>& frames) {
  if (const auto stiff = replace_ideal_joints(model)) {
    return find_small_motion(*stiff, state, axes, frames);
  }
  check_levels(model);
  SmallMotion motion;
  Derivatives(model, state, frames, motion).fill();
  motion.express_in(axes, state);
  return motion;
}

}  // namespace limber::dynamics
