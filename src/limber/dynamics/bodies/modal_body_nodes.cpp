// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "limber/dynamics/bodies/modal_body.hpp"
#include "limber/dynamics/bodies/modal_coordinates.hpp"

/// Motion of a modal body's stored nodes.
namespace limber::dynamics {
namespace {

// States per block: few enough that the product stays in cache for the
// transformation to the world frame.
constexpr Eigen::Index kBlock = 16;

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
      set_modal_coordinates(body, state, coordinates.col(j).data());
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

}  // namespace

void ModalBody::deform_nodes(std::span<const SystemState> states,
                             Eigen::Ref<MatrixX> u_B) const {
  if (body_.modes == 0) {
    u_B.setZero();
    return;
  }
  deform(body_, states, u_B, [](Eigen::Index) {});
}

void ModalBody::place_nodes(std::span<const SystemState> states,
                            Eigen::Ref<MatrixX> p_WP) const {
  const auto x_B = body_.reduced->rows.x_B.reshaped();
  deform(body_, states, p_WP, [&](Eigen::Index j) {
    p_WP.col(j) += x_B;
    const BodyState& now = states[static_cast<std::size_t>(j)].bodies[b_];
    move_column(now.quat_WB.toRotationMatrix(), now.p_WB, p_WP.col(j).data(),
                p_WP.rows() / 3);
  });
}

}  // namespace limber::dynamics
