// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/linear_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/steady_linearisation.hpp"
#include "limber/dynamics/analysis/stiff_joints.hpp"
#include "limber/dynamics/equations/equations.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

/// x = x_of_position (s q), x' = x_of_rate q'.
struct Coordinates {
  MatrixX x_of_position;
  MatrixX x_of_rate;
  Index relaxations = 0;

  /// Rows by all states.
  [[nodiscard]] MatrixX join_columns(const MatrixX& by_position,
                                     const MatrixX& by_rate) const {
    MatrixX rows(by_position.rows(),
                 by_position.cols() + by_rate.cols() + relaxations);
    rows << by_position, by_rate, MatrixX::Zero(rows.rows(), relaxations);
    return rows;
  }
};

MatrixX multiply_blocks(const std::vector<Matrix6>& blocks,
                        const MatrixX& rows) {
  MatrixX product(rows.rows(), rows.cols());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Index row = 6 * static_cast<Index>(i);
    product.middleRows<6>(row) = blocks[i] * rows.middleRows<6>(row);
  }
  return product;
}

/// Frequencies of coordinates, at least 1e-6 of the largest; 1 if free.
VectorX find_scale(const MatrixX& S, Index free) {
  constexpr double kLeast = 1e-6;
  VectorX scale = VectorX::Ones(S.rows());
  const Index held = S.rows() - free;
  if (held == 0) return scale;
  const VectorX sizes = S.diagonal().tail(held).cwiseAbs().cwiseSqrt();
  const double least = kLeast * sizes.maxCoeff();
  if (least > 0.0) scale.tail(held) = sizes.cwiseMax(least);
  return scale;
}

/// Q' S Q, without entries known to be round-off.
MatrixX find_stiffness(const SteadyMotion& steady) {
  const PrincipalBasis& basis = steady.basis;
  MatrixX S = steady.motion.project_stiffness(basis.Q);
  const bool is_still = steady.axes.w_W.isZero(0.0);
  const Index first = is_still ? 0 : basis.drift;
  S.middleCols(first, basis.free - first).setZero();
  if (is_still && is_conservative(steady.motion, basis)) {
    S = MatrixX(S.diagonal().asDiagonal());
  }
  return S;
}

std::vector<LinearSignal> name_system_states(Index free, Index n,
                                             Index relaxations) {
  std::vector<LinearSignal> states;
  for (const char* what : {"", ".rate"}) {
    const bool is_rate = *what != '\0';
    for (Index i = 0; i < n; ++i) {
      const bool is_free = i < free;
      states.push_back({is_free ? fmt::format("free{}{}", i + 1, what)
                                : fmt::format("mode{}{}", i + 1 - free, what),
                        is_free && !is_rate ? "kg^1/2 m" : "kg^1/2 m/s", 0.0});
    }
  }
  for (Index i = 0; i < relaxations; ++i) {
    states.push_back({fmt::format("relaxation{}", i + 1), "kg^1/2 m/s", 0.0});
  }
  return states;
}

void fill_equations(const SteadyMotion& steady, const MatrixX& S,
                    const VectorX& scale, LinearSystem& out) {
  const MatrixX& Q = steady.basis.Q;
  const Index n = Q.cols();
  const MatrixX E = steady.motion.project_relaxations(Q);
  const Index r = E.rows();
  out.A = MatrixX::Zero(2 * n + r, 2 * n + r);
  out.A.block(0, n, n, n) = scale.asDiagonal();
  out.A.block(n, 0, n, n) = -S * scale.cwiseInverse().asDiagonal();
  out.A.block(n, n, n, n) = -Q.transpose() * steady.motion.D * Q;
  out.A.block(n, 2 * n, n, r) = -E.transpose();
  out.A.block(2 * n, n, r, n) = E;
  out.A.diagonal().tail(r) = -steady.motion.relaxation_rates();
  out.B = MatrixX::Zero(2 * n + r, std::ssize(out.inputs));
  for (Index i = 0; i < out.B.cols(); ++i) {
    out.B.col(i).segment(n, n) =
        Q.transpose() * out.inputs[static_cast<std::size_t>(i)].force;
  }
}

void fill_links(const SmallMotion& motion, const Coordinates& c,
                LinearSystem& out) {
  const Index rows = 6 * std::ssize(motion.damping);
  const MatrixX moved = motion.G.topRows(rows) * c.x_of_position;
  out.links = c.join_columns(moved, MatrixX::Zero(rows, moved.cols()));
  out.link_velocities =
      c.join_columns(motion.velocities.topRows(rows) * c.x_of_position,
                     motion.velocities_by_rate.topRows(rows) * c.x_of_rate);
  const std::vector<Matrix6> stiffness(
      motion.K.begin(), motion.K.begin() + std::ssize(motion.damping));
  out.wrenches = -multiply_blocks(stiffness, out.links) -
                 multiply_blocks(motion.damping, out.link_velocities);
  out.wrenches_by_input.resize(rows, std::ssize(out.inputs));
  for (Index i = 0; i < out.wrenches_by_input.cols(); ++i) {
    out.wrenches_by_input.col(i) =
        out.inputs[static_cast<std::size_t>(i)].wrenches.head(rows);
  }
}

void fill_motions(const SystemModel& model, const SmallMotion& motion,
                  const Coordinates& c, LinearSystem& out) {
  const Index n = motion.size();
  out.frames = c.join_columns(motion.frames * c.x_of_position,
                              MatrixX::Zero(motion.frames.rows(), n));
  out.frame_velocities =
      c.join_columns(motion.frame_velocities * c.x_of_position,
                     motion.frame_velocities_by_rate * c.x_of_rate);
  out.modes = MatrixX::Zero(model.modal_count, 2 * n + c.relaxations);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    out.modes.block(body.offset, 0, body.modes, n) =
        c.x_of_position.middleRows(motion.modes[b], body.modes);
  }
  out.stressed_modes = out.modes;
  // y = sqrt(lambda g) d of each element and mode (SmallMotion::Relaxation).
  Index y = 2 * n;
  for (const BodyModel& body : model.bodies) {
    const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
    for (Index j = 0; j < body.maxwell.size(); ++j) {
      for (Index k = 0; k < body.modes; ++k) {
        out.stressed_modes(body.offset + k, y++) =
            std::sqrt(body.maxwell.strengths[j] / lambda[k]);
      }
    }
  }
}

void check_apart(const SystemModel& model, const SystemState& state) {
  if (model.pairs.empty()) return;
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  const auto name = [&](BodyIndex body) {
    return body == kWorld ? std::string("the world")
                          : "'" + model.bodies[index(body)].name + "'";
  };
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const Pair& pair = model.pairs[i];
    if (pair.law->touching() == nullptr) continue;
    for (const joints::PairPoint& point : terms.pairs.responses[i].points()) {
      if (point.force_W.isZero(0.0) && point.stiffness.isZero(0.0)) continue;
      throw InputError(
          fmt::format("{} and {} are in contact at t = {:g} s: a contact that "
                      "opens, slips or rolls has no linear model. Choose a "
                      "time at which they are apart, or join them by a coupler",
                      name(pair.body_A), name(pair.body_B), state.t));
    }
  }
}

}  // namespace

LinearSystem linearise(const SystemModel& model, const SystemState& state,
                       const std::vector<AttachmentIndex>& frames,
                       const DriveNames& names) {
  if (const auto stiff = replace_ideal_joints(model)) {
    return linearise(*stiff, state, frames, names);
  }
  check_apart(model, state);
  const SteadyMotion steady = linearise_steadily(model, state);
  if (steady.motion.size() == 0) {
    throw InputError("no body moves or deforms: there is nothing to linearise");
  }
  const SmallMotion motion =
      find_small_motion(model, state, steady.axes, frames);
  LinearSystem out;
  out.axes = steady.axes;
  out.is_moving = moves(state);
  out.change = steady.change;
  out.imbalance = find_imbalance(
      model, state, std::vector<Vector3>(model.bodies.size(), steady.axes.w_W));
  out.coordinates = motion.size();
  out.free = steady.basis.free;
  const Index relaxations = motion.relaxation_rates().size();
  out.states = name_system_states(out.free, motion.size(), relaxations);
  out.inputs = find_linear_inputs(model, state, motion, names);
  const MatrixX S = find_stiffness(steady);
  const VectorX scale = find_scale(S, out.free);
  const MatrixX& Q = steady.basis.Q;
  fill_equations(steady, S, scale, out);
  const Coordinates c{Q * scale.cwiseInverse().asDiagonal(), Q, relaxations};
  fill_links(motion, c, out);
  fill_motions(model, motion, c, out);
  return out;
}

}  // namespace limber::dynamics
