// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/newton_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "dynamics/cayley.hpp"
#include "dynamics/free_rows.hpp"
#include "dynamics/hubs.hpp"
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
    : full_(model.full_bodies.size()),
      ends_of_body_(model.bodies.size()),
      couplers_(model.couplers.size()) {
  const std::size_t links = couplers_ + model.transmissions.size();
  scaled_stiffness_.resize(links);
  rows_.resize(links);
  wrenches_.resize(links);
  gaps_.resize(links);
  bodies_.reserve(model.bodies.size());
  for (const BodyModel& body : model.bodies) bodies_.emplace_back(body.modes);
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
  plan_lu(model, link);
}

// Links that share a body that is eliminated, and hubs with the links that hold
// them.
void NewtonMatrix::plan_lu(const SystemModel& model, int links) {
  std::vector<std::vector<int>> links_of_body(ends_of_body_.size());
  for (const End& end : ends_) {
    links_of_body[index(end.body)].push_back(end.link);
  }
  std::vector<int> blocks;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    blocks.push_back(model.bodies[b].full < 0 ? bodies_[b].block_count() : 0);
  }
  int row = links;
  hub_of_body_.assign(model.bodies.size(), -1);
  for (const int b : choose_hubs(links_of_body, blocks)) {
    hub_of_body_[index(b)] = static_cast<int>(hubs_.size());
    const int size = 6 + model.bodies[index(b)].modes;
    hubs_.push_back({b, row, blocks[index(b)], size});
    row += blocks[index(b)];
  }
  unknowns_.resize(index(row));
  std::vector<std::pair<int, int>> edges;
  for (std::size_t b = 0; b < ends_of_body_.size(); ++b) {
    if (hub_of_body_[b] >= 0) continue;
    for (const int i : links_of_body[b]) {
      for (const int j : links_of_body[b]) {
        if (i < j) edges.emplace_back(i, j);
      }
    }
  }
  for (const Hub& hub : hubs_) {
    for (int i = hub.first; i < hub.first + hub.blocks; ++i) {
      for (const int link : links_of_body[index(hub.body)]) {
        edges.emplace_back(link, i);
      }
      for (int j = hub.first; j < i; ++j) edges.emplace_back(i, j);
    }
  }
  lu_ = BlockLu(row, edges);
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
  if (!attachment.nodal) {
    calc_modal_rows(model, terms, end);
    if (is_on_hub(end)) {
      end.Zt = end.G;
      if (!model.bodies[index(end.body)].has_rigid_motion()) {
        end.Zt.leftCols<6>().setZero();
      }
    } else {
      bodies_[index(end.body)].solve_rows(end.G, end.Zt);
    }
    return;
  }
  const BodyModel& body = model.bodies[index(end.body)];
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

void NewtonMatrix::assemble(const SystemTerms& terms, const Coefficients& c) {
  lu_.set_zero();
  for (std::size_t b = 0; b < ends_of_body_.size(); ++b) {
    if (hub_of_body_[b] >= 0) continue;
    const std::vector<int>& ends = ends_of_body_[b];
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
  for (const Hub& hub : hubs_) assemble_hub(hub);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int row = static_cast<int>(i);
    lu_.scale_row(row, scaled_stiffness_[i]);
    lu_.block(row, row) += rows_[i];
  }
}

// Its equation, and its columns in the links' rows, yet without K.
void NewtonMatrix::assemble_hub(const Hub& hub) {
  for (int i = 0; i < hub.blocks; ++i) {
    for (int j = 0; j < hub.blocks; ++j) {
      lu_.block(hub.first + i, hub.first + j) =
          bodies_[index(hub.body)].block(i, j);
    }
    for (const int e : ends_of_body_[index(hub.body)]) {
      const End& end = ends_[index(e)];
      const Eigen::Index first = Eigen::Index{6} * i;
      const Eigen::Index count =
          std::min<Eigen::Index>(6, end.G.cols() - first);
      lu_.block(end.link, hub.first + i).leftCols(count) +=
          end.G.middleCols(first, count);
      lu_.block(hub.first + i, end.link).topRows(count) -=
          end.Zt.middleCols(first, count).transpose();
    }
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
  if (index(row) >= rows_.size()) {
    const auto hub = std::find_if(
        hubs_.rbegin(), hubs_.rend(),
        [row](const Hub& candidate) { return candidate.first <= row; });
    return fmt::format("body '{}': its inertia, and what holds it, is singular",
                       model.bodies[index(hub->body)].name);
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
    bodies_[b].update(model.bodies[b], terms.bodies[b], state.bodies[b].w_WB_B,
                      end_terms != nullptr ? cayley_jacobian_inverse(turn)
                                           : right_jacobian_inverse(turn),
                      coefficients);
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
    if (hub_of_body_[b] >= 0) continue;
    bodies_[b].solve(increments.data() +
                     first_row(model.bodies[b], static_cast<int>(b)));
  }
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    full_[f].solve(
        full, *terms.full[f].solver,
        increments.segment(first_node_row(model) + full.first, full.dofs()));
  }
  increments = -increments;
  for (Vector6& x : unknowns_) x.setZero();
  for (const End& end : ends_) {
    if (is_on_hub(end)) continue;
    const double* x = increments.data() + end.row;
    Vector6& w = unknowns_[index(end.link)];
    for (Eigen::Index k = 0; k < end.G.cols(); ++k) w -= end.G.col(k) * x[k];
  }
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const Vector6 right =
        scaled_stiffness_[i] * unknowns_[i] + rows_[i] * gaps[i];
    unknowns_[i] = right;
  }
  const auto for_hubs = [&](const auto& visit) {
    for (const Hub& hub : hubs_) {
      double* x = increments.data() +
                  first_row(model.bodies[index(hub.body)], hub.body);
      for (int k = 0; k < hub.size; ++k) {
        visit(unknowns_[index(hub.first + k / 6)][k % 6], x[k]);
      }
    }
  };
  for_hubs([](double& unknown, double& x) { unknown = x; });
  lu_.solve(unknowns_);
  for_hubs([](double& unknown, double& x) { x = unknown; });
  std::copy_n(unknowns_.begin(), wrenches_.size(), wrenches_.begin());
  for (const End& end : ends_) {
    if (is_on_hub(end)) continue;
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
