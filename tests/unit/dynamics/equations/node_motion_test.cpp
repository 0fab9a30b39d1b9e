// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/node_motion.hpp"

#include <gtest/gtest.h>

#include <random>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::node_motion_test {
namespace {

constexpr double kRoundoff = 1e-13;  // of lengths of a few metres
constexpr int kNodes = 12;
constexpr int kModes = 4;

/// A flexible body, the same at level rigid, a rigid frame; and 37 states.
class NodeMotion : public ::testing::Test {
 protected:
  NodeMotion() {
    SystemBuilder builder;
    builder.add_rigid_body("frame", {1.0, Matrix3::Identity()});
    for (const Fidelity level :
         {Fidelity::coupled, Fidelity::rigid, Fidelity::uncoupled}) {
      builder.add_flexible_body(std::string(to_string(level)),
                                testing::share(body_), level, {});
    }
    model_ = builder.build();
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto draw = [&] { return normal(random); };
    for (int i = 0; i < 37; ++i) {
      SystemState state = make_state(model_);
      for (BodyState& b : state.bodies) {
        b.p_WB = Vector3::NullaryExpr(draw);
        b.quat_WB.coeffs() = Eigen::Vector4d::NullaryExpr(draw).normalized();
      }
      state.eta = VectorX::NullaryExpr(state.eta.size(), draw);
      states_.push_back(state);
    }
  }

  /// The definition, node by node.
  [[nodiscard]] Vector3 deformation(std::size_t state, BodyIndex body,
                                    Eigen::Index node) const {
    const int offset = body == 1 ? 0 : kModes;
    Vector3 u = Vector3::Zero();
    if (body == 2) return u;  // rigid
    for (int k = 0; k < kModes; ++k) {
      u += body_.reduced.rows.Phi_B.block<3, 1>(3 * node, k) *
           states_[state].eta[offset + k];
    }
    return u;
  }
  [[nodiscard]] Vector3 position(std::size_t state, BodyIndex body,
                                 Eigen::Index node) const {
    const BodyState& b = states_[state].bodies[static_cast<std::size_t>(body)];
    return b.p_WB + b.quat_WB * (body_.reduced.rows.x_B.col(node) +
                                 deformation(state, body, node));
  }
  [[nodiscard]] MatrixX make_answer() const {
    return MatrixX::Constant(3 * kNodes, std::ssize(states_), 99.0);
  }
  template <typename Expected>
  void expect(const MatrixX& answer, const Expected& expected) const {
    for (std::size_t j = 0; j < states_.size(); ++j) {
      for (Eigen::Index n = 0; n < kNodes; ++n) {
        const auto column = static_cast<Eigen::Index>(j);
        EXPECT_LT((answer.block<3, 1>(3 * n, column) - expected(j, n)).norm(),
                  kRoundoff);
      }
    }
  }

  const testing::PointMassBody body_ =
      testing::make_point_mass_body(kNodes, kModes, 5.0, 1.0, 200.0, 9);
  SystemModel model_;
  std::vector<SystemState> states_;
};

TEST_F(NodeMotion, OfManyStatesIsThatOfEachNodeByItself) {
  for (const BodyIndex body : {BodyIndex(1), BodyIndex(2), BodyIndex(3)}) {
    MatrixX answer = make_answer();
    calc_node_deformations(model_, body, states_, answer);
    expect(answer, [&](std::size_t j, Eigen::Index n) {
      return deformation(j, body, n);
    });
    answer = make_answer();
    calc_node_positions(model_, body, states_, answer);
    expect(answer,
           [&](std::size_t j, Eigen::Index n) { return position(j, body, n); });
  }
}

TEST_F(NodeMotion, DisplacementIsFromTheUndeformedBodyAtItsStart) {
  const Pose start{states_[5].bodies[1].quat_WB.toRotationMatrix(),
                   states_[5].bodies[1].p_WB};
  MatrixX answer = make_answer();
  calc_node_displacements(model_, BodyIndex(1), states_, start, answer);
  expect(answer, [&](std::size_t j, Eigen::Index n) {
    return Vector3(position(j, BodyIndex(1), n) -
                   start * Vector3(body_.reduced.rows.x_B.col(n)));
  });
}

TEST_F(NodeMotion, RefusesABodyWithoutNodesAndAnswersOfOtherSizes) {
  MatrixX answer = make_answer();
  EXPECT_THROW(calc_node_positions(model_, BodyIndex(0), states_, answer),
               ContractError);
  EXPECT_THROW(calc_node_positions(model_, BodyIndex(9), states_, answer),
               ContractError);
  MatrixX narrow = answer.leftCols(3);
  EXPECT_THROW(calc_node_positions(model_, BodyIndex(1), states_, narrow),
               ContractError);
}

}  // namespace
}  // namespace limber::dynamics::node_motion_test
