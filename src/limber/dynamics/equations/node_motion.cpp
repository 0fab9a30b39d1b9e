// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/node_motion.hpp"

#include <algorithm>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/terms/maxwell.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {
namespace {

// States per block: few enough that the product stays in cache for the
// transformation to the world frame.
constexpr Eigen::Index kBlock = 16;

const BodyModel& find_body(const SystemModel& model, BodyIndex body,
                           std::span<const SystemState> states,
                           const Eigen::Ref<MatrixX>& out) {
  LIMBER_EXPECT(body >= 0 && body < std::ssize(model.bodies));
  const BodyModel& found = model.bodies[static_cast<std::size_t>(body)];
  LIMBER_EXPECT(found.reduced != nullptr);
  LIMBER_EXPECT(out.rows() == 3 * found.reduced->rows.x_B.cols());
  LIMBER_EXPECT(out.cols() == std::ssize(states));
  return found;
}

void set_coordinates(const BodyModel& body, const SystemState& state,
                     double* out) {
  const double* eta = state.eta.data() + body.offset;
  std::copy(eta, eta + body.modes, out);
  flexbody::set_products(paired_of(body), eta, out + body.modes);
}

// Deformations of the nodes block by block, and `finish(j)` on every column
// while it is in cache.
template <typename Finish>
void deform(const BodyModel& body, std::span<const SystemState> states,
            Eigen::Ref<MatrixX> u_B, const Finish& finish) {
  const auto& Phi_B = body.reduced->rows.Phi_B;
  const bool is_nonlinear = body.fidelity == Fidelity::nonlinear;
  MatrixX coordinates(count_coordinates(body), kBlock);
  for (Eigen::Index first = 0; first < u_B.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, u_B.cols() - first);
    for (Eigen::Index j = 0; j < count; ++j) {
      const SystemState& state = states[static_cast<std::size_t>(first + j)];
      set_coordinates(body, state, coordinates.col(j).data());
    }
    const auto now = coordinates.leftCols(count);
    auto u = u_B.middleCols(first, count);
    u.noalias() = Phi_B.leftCols(body.modes) * now.topRows(body.modes);
    if (is_nonlinear) {
      const MatrixX& Theta_B = body.reduced->manifold->Theta_B;
      u.noalias() += Theta_B * now.bottomRows(Theta_B.cols());
    }
    for (Eigen::Index j = first; j < first + count; ++j) finish(j);
  }
}

// column <- R column + p, 3 numbers at a time.
void move_column(const Matrix3& R, const Vector3& p, double* column,
                 Eigen::Index nodes) {
  for (double* node = column; node != column + 3 * nodes; node += 3) {
    const double x = node[0];
    const double y = node[1];
    const double z = node[2];
    node[0] = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + p[0];
    node[1] = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + p[1];
    node[2] = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + p[2];
  }
}

// Positions of an unreduced body's nodes in state j.
void place_full(const SystemModel& model, const BodyModel& body,
                const SystemState& state, Eigen::Ref<VectorX> p_WP) {
  const auto f = static_cast<std::size_t>(body.full);
  const FullModel& full = model.full_bodies[f];
  const Matrix3X x = full.mesh->x_B + nodes_of(full, state.u_H);
  const Pose& X_WH = state.X_WH[f];
  p_WP.reshaped(3, x.cols()) = (X_WH.R * x).colwise() + X_WH.p;
}

}  // namespace

void calc_stress_coordinates(const BodyModel& body, const SystemState& state,
                             VectorX& out) {
  out.resize(count_coordinates(body));
  set_coordinates(body, state, out.data());
  if (body.maxwell.size() == 0) return;
  out.head(body.modes) +=
      maxwell_of(body, state.maxwell) * body.maxwell.strengths;
  out *= body.maxwell.scale;
}

void calc_node_deformations(const SystemModel& model, BodyIndex body,
                            std::span<const SystemState> states,
                            Eigen::Ref<MatrixX> u_B) {
  const BodyModel& b = find_body(model, body, states, u_B);
  if (b.full >= 0) {
    const FullModel& full = model.full_bodies[static_cast<std::size_t>(b.full)];
    Matrix3X deformation(3, full.mesh->node_count());
    for (Eigen::Index j = 0; j < u_B.cols(); ++j) {
      const SystemState& state = states[static_cast<std::size_t>(j)];
      MeanFrame frame;
      calc_mean_frame(model, full, state, frame);
      calc_deformation(full, frame, nodes_of(full, state.u_H), deformation);
      u_B.col(j) = deformation.reshaped();
    }
    return;
  }
  if (b.modes == 0) {
    u_B.setZero();
    return;
  }
  deform(b, states, u_B, [](Eigen::Index) {});
}

void calc_node_positions(const SystemModel& model, BodyIndex body,
                         std::span<const SystemState> states,
                         Eigen::Ref<MatrixX> p_WP) {
  const BodyModel& b = find_body(model, body, states, p_WP);
  if (b.full >= 0) {
    for (Eigen::Index j = 0; j < p_WP.cols(); ++j) {
      place_full(model, b, states[static_cast<std::size_t>(j)], p_WP.col(j));
    }
    return;
  }
  const auto at = static_cast<std::size_t>(body);
  const auto x_B = b.reduced->rows.x_B.reshaped();
  deform(b, states, p_WP, [&](Eigen::Index j) {
    p_WP.col(j) += x_B;
    const BodyState& now = states[static_cast<std::size_t>(j)].bodies[at];
    move_column(now.quat_WB.toRotationMatrix(), now.p_WB, p_WP.col(j).data(),
                p_WP.rows() / 3);
  });
}

void calc_node_displacements(const SystemModel& model, BodyIndex body,
                             std::span<const SystemState> states,
                             const Pose& X_WB0, Eigen::Ref<MatrixX> u_W) {
  const BodyModel& b = find_body(model, body, states, u_W);
  const Matrix3X start = (X_WB0.R * b.reduced->rows.x_B).colwise() + X_WB0.p;
  calc_node_positions(model, body, states, u_W);
  u_W.colwise() -= start.reshaped();
}

}  // namespace limber::dynamics
