// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/newton_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/kernels/column_kernels.hpp"
#include "limber/dynamics/newton/cayley.hpp"
#include "limber/dynamics/newton/link_rows.hpp"

namespace limber::dynamics {
namespace {

std::size_t count_columns(const Matrix6X& matrix) {
  return static_cast<std::size_t>(matrix.cols());
}

}  // namespace

NewtonMatrix::NewtonMatrix(const SystemModel& model)
    : ends_of_body_(model.bodies.size()),
      couplers_(model.couplers.size()),
      pairs_(model) {
  const std::size_t links = couplers_ + model.transmissions.size();
  scaled_stiffness_.resize(links);
  rows_.resize(links);
  yields_.resize(links);
  wrenches_.resize(links);
  gaps_.resize(links);
  graph_.links = static_cast<int>(links);
  graph_.grounded.resize(links, false);
  bodies_.reserve(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    bodies_.emplace_back(model, b);
  }
  const auto add_pair = [&](int link, CouplerIndex coupler, int term) {
    const Coupler& c = model.couplers[index(coupler)];
    add_end(model, link, coupler, term, c.frame_F, false);
    add_end(model, link, coupler, term, c.frame_M, true);
  };
  int link = static_cast<int>(couplers_);
  for (CouplerIndex c(0); c < link; ++c) add_pair(c, c, -1);
  for (const Transmission& transmission : model.transmissions) {
    int term = 0;
    if (const auto* sum = std::get_if<JointSum>(&transmission.coordinate)) {
      for (const JointSum::Term& t : sum->terms) {
        add_pair(link, t.coupler, term++);
      }
    } else {
      for (const AttachmentIndex point :
           std::get<PathCoordinate>(transmission.coordinate).points) {
        add_end(model, link, CouplerIndex(), term++, point, true);
      }
    }
    ++link;
  }
  finish_graph(model);
  plan_ = plan_lu(graph_, {});
  compliances_.resize(links, Matrix6::Zero());
  unknowns_.resize(index(plan_.rows));
}

// All except what add_end() adds.
void NewtonMatrix::finish_graph(const SystemModel& model) {
  graph_.links_of_body.resize(ends_of_body_.size());
  for (const End& end : ends_) {
    graph_.links_of_body[index(end.body)].push_back(end.link);
  }
  graph_.ideal.resize(graph_.grounded.size(), false);
  for (std::size_t c = 0; c < couplers_; ++c) {
    graph_.ideal[c] = joints::is_ideal(model.couplers[c].law);
  }
  graph_.anchored = graph_.grounded;
  for (const End& end : ends_) {
    if (!model.bodies[index(end.body)].has_rigid_motion()) {
      graph_.anchored[index(end.link)] = true;
    }
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    graph_.blocks.push_back(bodies_[b].block_count());
    graph_.sizes.push_back(6 + body.modes);
    graph_.moves.push_back(body.has_rigid_motion());
  }
}

void NewtonMatrix::add_end(const SystemModel& model, int link,
                           CouplerIndex coupler, int term,
                           AttachmentIndex attachment, bool is_M) {
  const BodyIndex b = model.attachments[index(attachment)].body;
  if (b == kWorld) {
    graph_.grounded[index(link)] = true;
    return;
  }
  End end{bodies_[index(b)].make_end(model, attachment)};
  end.link = link;
  end.coupler = coupler;
  end.term = term;
  end.body = b;
  end.is_M = is_M;
  ends_of_body_[index(b)].push_back(static_cast<int>(ends_.size()));
  ends_.push_back(std::move(end));
}

// Rotation to the frame in which an end's motion is expressed: F, or the world.
Matrix3 NewtonMatrix::find_R_FW(const SystemModel& model,
                                const SystemTerms& terms,
                                const End& end) const {
  if (end.coupler < 0) return Matrix3::Identity();
  const Coupler& coupler = model.couplers[index(end.coupler)];
  return terms.attachments[index(coupler.frame_F)].R_WF.transpose();
}

// Turns rows of this end's frame into those of M in F, or of a transmission.
void NewtonMatrix::finish_rows(const SystemTerms& terms, const End& end,
                               Matrix6X& rows) const {
  if (!end.is_M) {
    reflect_rows(terms.couplers[index(end.coupler)].motion.p_FM_F, rows);
  }
  if (end.term < 0) return;
  const auto& transmission = terms.transmissions[index(end.link) - couplers_];
  contract_rows(transmission.gradients[index(end.term)], rows);
}

void NewtonMatrix::calc_rows(const SystemModel& model, const SystemState& state,
                             const SystemTerms& terms, End& end) const {
  bodies_[index(end.body)].calc_rows(model, state, terms,
                                     find_R_FW(model, terms, end), end);
  finish_rows(terms, end, end.G);
}

void NewtonMatrix::factor_end(const SystemModel& model,
                              const SystemState& state,
                              const SystemTerms& terms, End& end) const {
  const BodyFactor& body = bodies_[index(end.body)];
  calc_rows(model, state, terms, end);
  if (!is_retained(end)) {
    body.solve_end(
        model, state, find_R_FW(model, terms, end),
        [&](Matrix6X& rows) { finish_rows(terms, end, rows); }, end);
    return;
  }
  if (plan_.retained[index(plan_.retained_of_body[index(end.body)])]
          .precedes_links) {
    body.dense().solve_rows(end.G, end.Zt);
    end.compliance.noalias() = end.G.lazyProduct(end.Zt.transpose());
  }
  end.Zt = end.G;
  if (!model.bodies[index(end.body)].has_rigid_motion()) {
    end.Zt.leftCols<6>().setZero();
  }
}

void NewtonMatrix::assemble(const SystemModel& model, const SystemTerms& terms,
                            const SystemTerms& end_terms,
                            const Coefficients& c) {
  plan_.lu.set_zero();
  for (std::size_t b = 0; b < ends_of_body_.size(); ++b) {
    if (plan_.retained_of_body[b] >= 0) continue;
    const std::vector<int>& ends = ends_of_body_[b];
    for (const int i : ends) {
      for (const int j : ends) {
        const End& row = ends_[index(i)];
        const End& column = ends_[index(j)];
        kernels::add_outer_products(
            row.G.data(), column.Zt.data(), count_columns(row.G),
            plan_.lu.block(row.link, column.link).data());
      }
    }
  }
  for (const RetainedUnknowns& retained : plan_.retained) {
    if (retained.precedes_links) add_compliances(retained);
  }
  // Rows become T (E + K A), T a rotation scaled to the size of each row, E the
  // identity or, in constrained directions, zero.
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Matrix6 A = compliances_[i] +
                      plan_.lu.block(static_cast<int>(i), static_cast<int>(i));
    compliances_[i].setZero();
    const LinkRows link = find_link_rows(terms, i, c.velocity);
    const Vector6 scale =
        (link.yields + (link.stiffness * A).cwiseAbs().rowwise().maxCoeff())
            .cwiseInverse();
    rows_[i] = scale.asDiagonal() * link.rotation;
    yields_[i] = link.yields;
    scaled_stiffness_[i] = scale.asDiagonal() * link.stiffness;
  }
  for (const RetainedUnknowns& retained : plan_.retained)
    assemble_retained(retained);
  pairs_.add(model, terms, end_terms, c.velocity, plan_);
  plan_.transports.update([&](int body) { return find_pose(terms, body); },
                          [&](int body) { return find_pose(end_terms, body); });
  plan_.transports.transform(plan_.lu);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int row = static_cast<int>(i);
    plan_.lu.scale_row(row, scaled_stiffness_[i]);
    plan_.lu.block(row, row) += yields_[i].asDiagonal() * rows_[i];
  }
}

// From one of the attachments on the body.
Pose NewtonMatrix::find_pose(const SystemTerms& terms, int body) const {
  const End& end = ends_[index(ends_of_body_[index(body)].front())];
  const AttachmentMotion& motion = terms.attachments[index(end.attachment)];
  return {motion.R_WB, motion.p_WF - motion.R_WB * motion.arm_B};
}

// Its fraction of A, which is known only once it is eliminated.
void NewtonMatrix::add_compliances(const RetainedUnknowns& retained) {
  for (const int e : ends_of_body_[index(retained.body)]) {
    const End& end = ends_[index(e)];
    compliances_[index(end.link)] += end.compliance;
  }
}

// Its equation, and its columns in the links' rows, without K yet.
void NewtonMatrix::assemble_retained(const RetainedUnknowns& retained) {
  for (int i = 0; i < retained.blocks; ++i) {
    for (int j = 0; j < retained.blocks; ++j) {
      plan_.lu.block(retained.first + i, retained.first + j) =
          bodies_[index(retained.body)].dense().block(i, j);
    }
    for (const int e : ends_of_body_[index(retained.body)]) {
      const End& end = ends_[index(e)];
      const Eigen::Index first = Eigen::Index{6} * i;
      const Eigen::Index count =
          std::min<Eigen::Index>(6, end.G.cols() - first);
      plan_.lu.block(end.link, retained.first + i).leftCols(count) +=
          end.G.middleCols(first, count);
      plan_.lu.block(retained.first + i, end.link).topRows(count) -=
          end.Zt.middleCols(first, count).transpose();
    }
  }
}

// A value that is not finite is the cause, wherever elimination fails first.
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
    if (find_link_stiffness(terms, link, 1.0).allFinite()) continue;
    return name(link) + ": its stiffness or damping is no longer finite";
  }
  if (index(row) >= rows_.size()) {
    const auto retained =
        std::find_if(plan_.retained.rbegin(), plan_.retained.rend(),
                     [row](const RetainedUnknowns& candidate) {
                       return candidate.first <= row;
                     });
    return fmt::format(
        "body '{}': the matrix of its inertia, couplers and pairs is singular",
        model.bodies[index(retained->body)].name);
  }
  return name(index(row)) +
         ": the matrix of its stiffness and of the bodies' compliance is "
         "singular";
}

void NewtonMatrix::factor(const SystemModel& model, const SystemState& state,
                          SystemTerms& terms, const VectorX& motion,
                          const Coefficients& coefficients, bool renews_all,
                          const SystemTerms* end_terms) {
  if (end_terms == nullptr) calc_stiffness(model, state, terms);
  if (pairs_.update(terms)) {
    plan_ = plan_lu(graph_, pairs_.active(model));
    unknowns_.resize(index(plan_.rows));
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Vector3 rotation = rotation_rows(model.bodies[b], motion);
    const Matrix3 T = end_terms != nullptr ? cayley_jacobian_inverse(rotation)
                                           : right_jacobian_inverse(rotation);
    if (!bodies_[b].update(model, state, terms, T, coefficients, renews_all)) {
      continue;
    }
    for (const int e : ends_of_body_[b]) {
      bodies_[b].renew_end(model, terms, ends_[index(e)]);
    }
  }
  for (End& end : ends_) {
    factor_end(model, state, terms, end);
    if (end_terms != nullptr) calc_rows(model, state, *end_terms, end);
  }
  assemble(model, terms, end_terms != nullptr ? *end_terms : terms,
           coefficients);
  if (const std::optional<int> row = plan_.lu.factor()) {
    throw NumericalError(describe_singular(model, terms, *row));
  }
}

Vector6 NewtonMatrix::find_gap(const SystemTerms& terms, std::size_t link) {
  if (link < terms.couplers.size()) {
    const CouplerTerms& coupler = terms.couplers[link];
    const Vector6 gap = coupler.response.wrench - coupler.applied;
    const joints::ConstraintGap* constraint = find_constraint(terms, link);
    if (constraint == nullptr) return gap;
    return constraint->gap + remove_constrained(*constraint, gap);
  }
  const TransmissionTerms& t =
      terms.transmissions[link - terms.couplers.size()];
  Vector6 gap = Vector6::Zero();
  gap[0] = t.response.force - t.applied;
  return gap;
}

// Constrained directions may have changed since the factors were made: their
// rows take deflections only, and the others forces only.
Vector6 NewtonMatrix::rotate_gap(const SystemTerms& terms, std::size_t link,
                                 const Vector6& gap) const {
  const Matrix6& rotation = rows_[link];
  const joints::ConstraintGap* constraint = find_constraint(terms, link);
  if (constraint == nullptr) return rotation * gap;
  const Vector6 deflection = constraint->directions * gap;
  const Vector6& yields = yields_[link];
  return yields.cwiseProduct(rotation * (gap - deflection)) +
         (Vector6::Ones() - yields).cwiseProduct(rotation * deflection);
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
    if (plan_.retained_of_body[b] >= 0) continue;
    bodies_[b].solve(model, terms, increments);
  }
  increments = -increments;
  for (Vector6& x : unknowns_) x.setZero();
  for (const End& end : ends_) {
    if (is_retained(end)) continue;
    kernels::add_product(end.G.data(), increments.data() + end.row,
                         count_columns(end.G),
                         unknowns_[index(end.link)].data());
  }
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const Vector6 right =
        rotate_gap(terms, i, gaps[i]) - scaled_stiffness_[i] * unknowns_[i];
    unknowns_[i] = right;
  }
  const auto for_kept = [&](const auto& visit) {
    for (const RetainedUnknowns& retained : plan_.retained) {
      double* x = increments.data() + model.bodies[index(retained.body)].row;
      for (int k = 0; k < retained.size; ++k) {
        visit(unknowns_[index(retained.first + k / 6)][k % 6], x[k]);
      }
    }
  };
  for_kept([](double& unknown, double& x) { unknown = x; });
  plan_.transports.transform_right(unknowns_);
  plan_.lu.solve(unknowns_);
  plan_.transports.restore(unknowns_);
  for_kept([](double& unknown, double& x) { x = unknown; });
  std::copy_n(unknowns_.begin(), wrenches_.size(), wrenches_.begin());
  for (const End& end : ends_) {
    if (is_retained(end)) continue;
    kernels::add_transposed_product(
        end.Zt.data(), wrenches_[index(end.link)].data(), count_columns(end.Zt),
        increments.data() + end.row);
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
        -find_link_stiffness(terms, index(link), 0.0) * motions[index(link)];
    const bool is_coupler = index(link) < couplers_;
    changes.segment(row(link), is_coupler ? 6 : 1) =
        change.head(is_coupler ? 6 : 1);
  }
}

}  // namespace limber::dynamics
