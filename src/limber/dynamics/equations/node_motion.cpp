// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/node_motion.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/bodies/modal_coordinates.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {
namespace {

const BodyModel& check_sizes(const SystemModel& model, BodyIndex body,
                             std::span<const SystemState> states,
                             const Eigen::Ref<MatrixX>& out) {
  LIMBER_EXPECT(body >= 0 && body < std::ssize(model.bodies));
  const BodyModel& found = model.bodies[static_cast<std::size_t>(body)];
  LIMBER_EXPECT(found.reduced != nullptr);
  LIMBER_EXPECT(out.rows() == 3 * found.reduced->rows.x_B.cols());
  LIMBER_EXPECT(out.cols() == std::ssize(states));
  return found;
}

}  // namespace

void calc_stress_coordinates(const BodyModel& body, const SystemState& state,
                             VectorX& out) {
  out.resize(count_coordinates(body));
  set_modal_coordinates(body, state, out.data());
  if (body.maxwell.size() == 0) return;
  out.head(body.modes) +=
      maxwell_of(body, state.maxwell) * body.maxwell.strengths;
  out *= body.maxwell.scale;
}

void calc_node_deformations(const SystemModel& model, BodyIndex body,
                            std::span<const SystemState> states,
                            Eigen::Ref<MatrixX> u_B) {
  check_sizes(model, body, states, u_B);
  visit_body(model, index(body),
             [&](const auto& own) { own.deform_nodes(states, u_B); });
}

void calc_node_positions(const SystemModel& model, BodyIndex body,
                         std::span<const SystemState> states,
                         Eigen::Ref<MatrixX> p_WP) {
  check_sizes(model, body, states, p_WP);
  visit_body(model, index(body),
             [&](const auto& own) { own.place_nodes(states, p_WP); });
}

void calc_node_displacements(const SystemModel& model, BodyIndex body,
                             std::span<const SystemState> states,
                             const Pose& X_WB0, Eigen::Ref<MatrixX> u_W) {
  const BodyModel& b = check_sizes(model, body, states, u_W);
  const Matrix3X start = (X_WB0.R * b.reduced->rows.x_B).colwise() + X_WB0.p;
  calc_node_positions(model, body, states, u_W);
  u_W.colwise() -= start.reshaped();
}

}  // namespace limber::dynamics
