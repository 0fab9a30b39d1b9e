// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/newton_matrix.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <limits>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "dynamics/cayley.hpp"
#include "dynamics/nodal_jacobian.hpp"

namespace limber::dynamics {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

Eigen::Index first_row(const BodyModel& body, int b) {
  return 6 * b + body.offset;
}

// Rows of the motion of M in F, from those of the motion of F: p_FM seen from a
// frame that moves itself is minus its motion, plus p x rotation.
void reflect(const Vector3& p, Matrix6X& rows) {
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const Vector3 turn = rows.col(k).tail<3>();
    rows.col(k).head<3>() = p.cross(turn) - rows.col(k).head<3>();
    rows.col(k).tail<3>() = -turn;
  }
}

// The motion of a coordinate, in the first row, from that of a frame.
void contract(const Vector6& gradient, Matrix6X& rows) {
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const double along = gradient.dot(rows.col(k));
    rows.col(k).setZero();
    rows(0, k) = along;
  }
}

// Stiffness and damping per increment of a coupler or, after them all, of a
// transmission.
Matrix6 find_stiffness(const SystemTerms& terms, std::size_t link,
                       double velocity) {
  if (link < terms.couplers.size()) {
    const joints::CouplerResponse& r = terms.couplers[link].response;
    return r.stiffness + velocity * r.damping;
  }
  const joints::ScalarResponse& r =
      terms.transmissions[link - terms.couplers.size()].response;
  Matrix6 K = Matrix6::Zero();
  K(0, 0) = r.stiffness + velocity * r.damping;
  return K;
}

// Of a block's largest row: a smaller one is round-off of the stiffness.
constexpr double kFree = 64.0 * std::numeric_limits<double>::epsilon();

// Q of a QR decomposition, reflection by reflection: householderQ() would
// compile a product by blocks, for seconds, that so small a matrix never takes.
Matrix3 multiply_reflections(const Eigen::Matrix<double, 3, 6>& qr,
                             const Vector3& scale) {
  Matrix3 Q = Matrix3::Identity();
  for (int k = 0; k < 3; ++k) {
    Vector3 v = Vector3::Unit(k);
    for (int i = k + 1; i < 3; ++i) v[i] = qr(i, k);
    Q -= scale[k] * (Q * v) * v.transpose();
  }
  return Q;
}

// Turns K's rows, forces and moments apart, to where those of directions that
// are free vanish. Left among the rows of held ones, what a free direction says
// would be lost in their round-off, and elimination would spread it.
// @returns the turn; its rows are those of the new K
Matrix6 separate_free_rows(Matrix6& K) {
  Matrix6 turn = Matrix6::Zero();
  for (const int first : {0, 3}) {
    const Eigen::Matrix<double, 3, 6> rows = K.middleRows<3>(first);
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, 6>> qr(rows);
    const Matrix3 Q = multiply_reflections(qr.matrixQR(), qr.hCoeffs());
    turn.block<3, 3>(first, first) = Q.transpose();
    K.middleRows<3>(first) = Q.transpose() * rows;
    const double noise = kFree * rows.cwiseAbs().maxCoeff();
    for (int i = first; i < first + 3; ++i) {
      if (K.row(i).cwiseAbs().maxCoeff() <= noise) K.row(i).setZero();
    }
  }
  return turn;
}

// The motion of an end's frame per node, both in body axes: 3N x 6.
MatrixX make_body_columns(const Attachment& attachment,
                          const AttachmentMotion& motion, const Matrix3& R_HB,
                          Eigen::Index dofs) {
  Matrix6X G(6, dofs);
  calc_nodal_jacobian(*attachment.nodal, motion.nodal, R_HB.transpose(), G);
  for (Eigen::Index i = 0; i < dofs; i += 3) {
    G.middleCols<3>(i) = (G.middleCols<3>(i) * R_HB).eval();
  }
  return G.transpose();
}

}  // namespace

NewtonMatrix::NewtonMatrix(const SystemModel& model)
    : bodies_(model.bodies.size()),
      full_(model.full_bodies.size()),
      ends_of_body_(model.bodies.size()),
      couplers_(model.couplers.size()) {
  const std::size_t links = couplers_ + model.transmissions.size();
  scaled_stiffness_.resize(links);
  rows_.resize(links);
  wrenches_.resize(links);
  gaps_.resize(links);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int m = model.bodies[b].modes;
    bodies_[b].coupling = Matrix3X::Zero(3, m);
    bodies_[b].back_coupling = Matrix3X::Zero(3, m);
    bodies_[b].inverse_modes = VectorX::Zero(m);
  }
  const auto add_pair = [&](int link, int coupler, int term) {
    const Coupler& c = model.couplers[index(coupler)];
    add_end(model, link, coupler, term, c.frame_F, false);
    add_end(model, link, coupler, term, c.frame_M, true);
  };
  int link = 0;
  for (; link < static_cast<int>(couplers_); ++link) add_pair(link, link, -1);
  for (const Transmission& transmission : model.transmissions) {
    int term = 0;
    if (const auto* sum = std::get_if<JointSum>(&transmission.coordinate)) {
      for (const JointSum::Term& t : sum->terms) {
        add_pair(link, t.coupler, term++);
      }
    } else {
      for (const AttachmentIndex point :
           std::get<PathCoordinate>(transmission.coordinate).points) {
        add_end(model, link, -1, term++, point, true);
      }
    }
    ++link;
  }
  std::vector<std::pair<int, int>> edges;
  for (const auto& ends : ends_of_body_) {
    for (const int i : ends) {
      for (const int j : ends) {
        const int ci = ends_[index(i)].link;
        const int cj = ends_[index(j)].link;
        if (ci < cj) edges.emplace_back(ci, cj);
      }
    }
  }
  lu_ = BlockLu(link, edges);
}

void NewtonMatrix::add_end(const SystemModel& model, int link, int coupler,
                           int term, int attachment, bool is_M) {
  const int b = model.attachments[index(attachment)].body;
  if (b == kWorld) return;
  const BodyModel& body = model.bodies[index(b)];
  End end{.link = link,
          .coupler = coupler,
          .term = term,
          .attachment = attachment,
          .body = b,
          .is_M = is_M,
          .row = first_row(body, b),
          .G = Matrix6X::Zero(6, 6 + body.modes),
          .Zt = {},
          .Zt_B = {}};
  if (body.full >= 0) {
    const FullModel& full = model.full_bodies[index(body.full)];
    end.row = first_node_row(model) + full.first;
    end.G = Matrix6X::Zero(6, full.dofs());
  }
  end.Zt = end.G;
  ends_of_body_[index(b)].push_back(static_cast<int>(ends_.size()));
  ends_.push_back(std::move(end));
}

void NewtonMatrix::factor_body(const BodyModel& body, const BodyTerms& terms,
                               const Vector3& w, const Matrix3& T,
                               const Coefficients& c,
                               BodyFactor& factor) const {
  factor.inverse_modes.array() =
      (c.acceleration + c.velocity * body.damping.array() + body.lambda.array())
          .inverse();
  if (!body.has_rigid_motion()) return;  // its rigid blocks stay zero
  factor.inverse_mass = 1.0 / (c.acceleration * body.mass);
  // The step's own rotation changes by T times the increments, which are of
  // the end.
  const Matrix3 gyroscopic = skew(w) * terms.J - skew(terms.J * w);
  Matrix3 schur = (c.acceleration * terms.J + c.velocity * gyroscopic) * T;
  for (int k = 0; k < body.modes; ++k) {
    const Vector3 column = c.acceleration * terms.H.col(k);
    const Vector3 row = T.transpose() * column;
    factor.coupling.col(k) = column;
    factor.back_coupling.col(k) = row;
    schur -= factor.inverse_modes[k] * column * row.transpose();
  }
  factor.inverse_rotation = schur.inverse();
  if (!factor.inverse_rotation.allFinite()) {
    throw NumericalError(
        fmt::format("body '{}': its inertia has become singular", body.name));
  }
}

void NewtonMatrix::solve_body(const BodyModel& body, const BodyFactor& factor,
                              double* x) const {
  Eigen::Map<Vector3> translation(x);
  Eigen::Map<Vector3> rotation(x + 3);
  double* modes = x + 6;
  translation *= factor.inverse_mass;
  Vector3 right = rotation;
  for (int k = 0; k < body.modes; ++k) {
    modes[k] *= factor.inverse_modes[k];
    right -= factor.coupling.col(k) * modes[k];
  }
  rotation = factor.inverse_rotation * right;
  const Vector3 turned = rotation;
  for (int k = 0; k < body.modes; ++k) {
    modes[k] -=
        factor.inverse_modes[k] * factor.back_coupling.col(k).dot(turned);
  }
}

// The axes in which an end's motion is told: those of F, or the world's.
Matrix3 NewtonMatrix::find_R_FW(const SystemModel& model,
                                const SystemTerms& terms,
                                const End& end) const {
  if (end.coupler < 0) return Matrix3::Identity();
  const Coupler& coupler = model.couplers[index(end.coupler)];
  return terms.attachments[index(coupler.frame_F)].R_WF.transpose();
}

// Makes of rows of this end's frame those of M in F; of a transmission one row
// is left, in place of six.
void NewtonMatrix::finish_rows(const SystemTerms& terms, const End& end,
                               Matrix6X& rows) const {
  if (!end.is_M) {
    reflect(terms.couplers[index(end.coupler)].motion.p_FM_F, rows);
  }
  if (end.term < 0) return;
  const auto& transmission = terms.transmissions[index(end.link) - couplers_];
  contract(transmission.gradients[index(end.term)], rows);
}

void NewtonMatrix::calc_modal_rows(const SystemModel& model,
                                   const SystemTerms& terms, End& end) const {
  const auto i = index(end.attachment);
  calc_modal_jacobian(model.attachments[i], terms.attachments[i],
                      find_R_FW(model, terms, end), end.G);
  finish_rows(terms, end, end.G);
}

void NewtonMatrix::factor_end(const SystemModel& model,
                              const SystemState& state,
                              const SystemTerms& terms, End& end) const {
  const Attachment& attachment = model.attachments[index(end.attachment)];
  const AttachmentMotion& motion = terms.attachments[index(end.attachment)];
  const BodyModel& body = model.bodies[index(end.body)];
  if (!attachment.nodal) {
    calc_modal_rows(model, terms, end);
    solve_end(body, end);
    return;
  }
  const Matrix3 R_FW = find_R_FW(model, terms, end);
  const Pose& X_WH = state.X_WH[index(body.full)];
  calc_nodal_jacobian(*attachment.nodal, motion.nodal, R_FW * X_WH.R, end.G);
  finish_rows(terms, end, end.G);
  const Matrix3& R_HB = full_[index(body.full)].R_HB();
  const Matrix3 R_FB = R_FW * X_WH.R * R_HB;
  for (Eigen::Index i = 0; i < end.Zt.cols(); i += 3) {
    end.Zt.block<3, 3>(0, i) =
        R_FB * end.Zt_B.block<3, 3>(0, i) * R_HB.transpose();
    end.Zt.block<3, 3>(3, i) =
        R_FB * end.Zt_B.block<3, 3>(3, i) * R_HB.transpose();
  }
  finish_rows(terms, end, end.Zt);
}

// Columns of D^-1 G', a row of G at a time, through D's arrow shape.
void NewtonMatrix::solve_end(const BodyModel& body, End& end) const {
  const BodyFactor& f = bodies_[index(end.body)];
  end.Zt.leftCols<3>() = f.inverse_mass * end.G.leftCols<3>();
  Eigen::Matrix<double, 6, 3> right = end.G.middleCols<3>(3);
  for (int k = 0; k < body.modes; ++k) {
    end.Zt.col(6 + k) = f.inverse_modes[k] * end.G.col(6 + k);
    right.noalias() -= end.Zt.col(6 + k) * f.coupling.col(k).transpose();
  }
  const Eigen::Matrix<double, 6, 3> turned =
      right * f.inverse_rotation.transpose();
  end.Zt.middleCols<3>(3) = turned;
  for (int k = 0; k < body.modes; ++k) {
    end.Zt.col(6 + k) -= f.inverse_modes[k] * (turned * f.back_coupling.col(k));
  }
}

void NewtonMatrix::assemble(const SystemTerms& terms, const Coefficients& c) {
  lu_.set_zero();
  for (const auto& ends : ends_of_body_) {
    for (const int i : ends) {
      for (const int j : ends) {
        const End& row = ends_[index(i)];
        const End& column = ends_[index(j)];
        Matrix6& block = lu_.block(row.link, column.link);
        for (Eigen::Index k = 0; k < row.G.cols(); ++k) {
          block.noalias() += row.G.col(k) * column.Zt.col(k).transpose();
        }
      }
    }
  }
  // Rows become T (I + K A), T a turn that is scaled to the size of each row.
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Matrix6& A = lu_.block(static_cast<int>(i), static_cast<int>(i));
    Matrix6 K = find_stiffness(terms, i, c.velocity);
    const Matrix6 turn = separate_free_rows(K);
    const Vector6 scale =
        (Vector6::Ones() + (K * A).cwiseAbs().rowwise().maxCoeff())
            .cwiseInverse();
    rows_[i] = scale.asDiagonal() * turn;
    scaled_stiffness_[i] = scale.asDiagonal() * K;
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int row = static_cast<int>(i);
    lu_.scale_row(row, scaled_stiffness_[i]);
    lu_.block(row, row) += rows_[i];
  }
}

// Sparse factors in body axes, and what they answer to each end's wrenches.
void NewtonMatrix::factor_full(const SystemModel& model,
                               const SystemState& state, SystemTerms& terms,
                               const Coefficients& c, bool renews) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    if (!full_[f].update(model, f, state, terms, c, renews)) continue;
    const FullModel& full = model.full_bodies[f];
    for (End& end : ends_) {
      if (end.body != full.body) continue;
      const auto i = index(end.attachment);
      MatrixX columns =
          make_body_columns(model.attachments[i], terms.attachments[i],
                            full_[f].R_HB(), full.dofs());
      full_[f].solve_columns(full, *terms.full[f].solver, columns);
      end.Zt_B = columns.transpose();
    }
  }
}

// What is not finite is the cause, wherever the elimination meets it first.
std::string NewtonMatrix::describe_singular(const SystemModel& model,
                                            const SystemTerms& terms,
                                            int row) const {
  const auto name = [&](std::size_t link) {
    return link < couplers_
               ? fmt::format("coupler '{}'", model.couplers[link].name)
               : fmt::format("transmission '{}'",
                             model.transmissions[link - couplers_].name);
  };
  for (std::size_t link = 0; link < rows_.size(); ++link) {
    if (find_stiffness(terms, link, 1.0).allFinite()) continue;
    return name(link) + ": its stiffness or damping is no longer finite";
  }
  return name(index(row)) +
         ": the matrix of what it holds, and bodies give way, is singular";
}

void NewtonMatrix::factor(const SystemModel& model, const SystemState& state,
                          SystemTerms& terms,
                          const std::vector<Vector3>& rotation_increments,
                          const Coefficients& coefficients, bool renews_full,
                          const SystemTerms* end_terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Vector3& turn = rotation_increments[b];
    factor_body(model.bodies[b], terms.bodies[b], state.bodies[b].w_WB_B,
                end_terms != nullptr ? cayley_jacobian_inverse(turn)
                                     : right_jacobian_inverse(turn),
                coefficients, bodies_[b]);
  }
  factor_full(model, state, terms, coefficients, renews_full);
  for (End& end : ends_) {
    factor_end(model, state, terms, end);
    if (end_terms != nullptr) calc_modal_rows(model, *end_terms, end);
  }
  assemble(terms, coefficients);
  if (const std::optional<int> row = lu_.factor()) {
    throw NumericalError(describe_singular(model, terms, *row));
  }
}

Vector6 NewtonMatrix::find_gap(const SystemTerms& terms, std::size_t link) {
  if (link < terms.couplers.size()) {
    const CouplerTerms& coupler = terms.couplers[link];
    return coupler.response.wrench - coupler.applied;
  }
  const TransmissionTerms& t =
      terms.transmissions[link - terms.couplers.size()];
  Vector6 gap = Vector6::Zero();
  gap[0] = t.response.force - t.applied;
  return gap;
}

void NewtonMatrix::solve(const SystemModel& model, const SystemTerms& terms,
                         const VectorX& residual, VectorX& increments) {
  for (std::size_t i = 0; i < gaps_.size(); ++i) gaps_[i] = find_gap(terms, i);
  solve(model, terms, residual, gaps_, increments);
}

void NewtonMatrix::solve(const SystemModel& model, const SystemTerms& terms,
                         const VectorX& residual,
                         const std::vector<Vector6>& gaps,
                         VectorX& increments) {
  ++solves_;
  increments = residual;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    solve_body(body, bodies_[b],
               increments.data() + first_row(body, static_cast<int>(b)));
  }
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    full_[f].solve(
        full, *terms.full[f].solver,
        increments.segment(first_node_row(model) + full.first, full.dofs()));
  }
  for (Vector6& w : wrenches_) w.setZero();
  for (const End& end : ends_) {
    const double* x = increments.data() + end.row;
    Vector6& w = wrenches_[index(end.link)];
    for (Eigen::Index k = 0; k < end.G.cols(); ++k) w += end.G.col(k) * x[k];
  }
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const Vector6 right =
        scaled_stiffness_[i] * wrenches_[i] + rows_[i] * gaps[i];
    wrenches_[i] = right;
  }
  lu_.solve(wrenches_);
  increments = -increments;
  for (const End& end : ends_) {
    double* x = increments.data() + end.row;
    const Vector6& w = wrenches_[index(end.link)];
    for (Eigen::Index k = 0; k < end.Zt.cols(); ++k) {
      x[k] += end.Zt.col(k).dot(w);
    }
  }
}

void NewtonMatrix::find_wrench_changes(const SystemTerms& terms,
                                       const VectorX& increments,
                                       VectorX& changes) const {
  const auto row = [this](int link) {
    const auto couplers = static_cast<Eigen::Index>(couplers_);
    return link < couplers ? 6 * link : 6 * couplers + (link - couplers);
  };
  std::vector<Vector6> motions(rows_.size(), Vector6::Zero());
  for (const End& end : ends_) {
    motions[index(end.link)] +=
        end.G * increments.segment(end.row, end.G.cols());
  }
  changes.resize(row(static_cast<int>(rows_.size())));
  for (int link = 0; link < static_cast<int>(rows_.size()); ++link) {
    const Vector6 change =
        -find_stiffness(terms, index(link), 0.0) * motions[index(link)];
    const bool is_coupler = index(link) < couplers_;
    changes.segment(row(link), is_coupler ? 6 : 1) =
        change.head(is_coupler ? 6 : 1);
  }
}

}  // namespace limber::dynamics
