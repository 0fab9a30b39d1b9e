// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/nodal_frame.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/attachment_jacobian.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
#include "limber/flexbody/model/interface_motion.hpp"
#include "support/spring_network.hpp"

namespace limber::dynamics::nodal_frame_test {
namespace {

using testing::make_full;
using testing::make_lattice;

const Vector3 kAxis = Vector3(0.3, -0.5, 0.7).normalized();
const Vector3 kOrigin(0.05, -0.02, 0.3);  // off the nodes

Matrix3X make_field(Eigen::Index nodes, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  return Matrix3X::NullaryExpr(3, nodes, [&] { return uniform(random); });
}

NodalFrameMotion find_motion(const NodalFrame& frame, const Matrix3X& u,
                             const Matrix3X& udot) {
  NodalFrameMotion motion;
  calc_nodal_frame(frame, ConstNodes(u.data(), 3, u.cols()),
                   ConstNodes(udot.data(), 3, udot.cols()), motion);
  return motion;
}

class NodalFrameOf : public ::testing::TestWithParam<const char*> {
 protected:
  NodalFrame make(const Vector3& origin) const {
    return make_nodal_frame(*body_, find_node_set(*body_, GetParam()), origin);
  }
  /// x + u turned by `rotation` and moved by p, of nodes deformed by
  /// `deformation`.
  Matrix3X displace(const Matrix3& turn, const Vector3& p,
                    const Matrix3X& deformation) const {
    const Matrix3X moved = turn * (body_->x_B + deformation);
    return (moved - body_->x_B).colwise() + p;
  }
  Matrix3X zero() const { return Matrix3X::Zero(3, body_->node_count()); }

  std::shared_ptr<const flexbody::FullBody> body_ = make_full(make_lattice());
};

TEST_P(NodalFrameOf, FollowsARigidMotionOfAnyAngle) {
  const NodalFrame frame = make(kOrigin);
  ASSERT_TRUE(frame.rotates);
  const Vector3 p(3.0, -1.0, 0.5);
  const Vector3 w(2.0, -1.0, 0.4);
  const Vector3 v(0.3, 0.2, -5.0);
  for (const double angle :
       {1e-9, 0.1, 1.5, 3.0, std::numbers::pi, 4.0, 2.0 * std::numbers::pi}) {
    const Matrix3 turn = exp_rotation(angle * kAxis);
    Matrix3X udot = turn * body_->x_B;
    for (auto column : udot.colwise())
      column = Vector3(v + w.cross(Vector3(column)));
    const NodalFrameMotion motion =
        find_motion(frame, displace(turn, p, zero()), udot);
    EXPECT_LT((motion.R_HB - turn).norm(), 1e-13) << angle;
    EXPECT_LT((motion.p_H - (p + turn * kOrigin)).norm(), 1e-14) << angle;
    EXPECT_LT((motion.w_H - w).norm(), 1e-12) << angle;
    EXPECT_LT((motion.v_H - (v + w.cross(turn * kOrigin))).norm(), 1e-13);
  }
}

TEST_P(NodalFrameOf, SpreadsAForceAndAMomentWithoutLoss) {
  const NodalFrame frame = make(kOrigin);
  const Vector3 force(3.0, -2.0, 1.0);
  const Vector3 moment(0.1, 0.5, -0.7);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Matrix3X u = displace(exp_rotation(2.0 * kAxis), {0.2, 0, 0},
                                make_field(body_->node_count(), 0.03, seed));
    const NodalFrameMotion motion = find_motion(frame, u, zero());
    Matrix3X nodal = zero();
    add_nodal_wrench(frame, motion, force, moment, nodal);
    Vector3 about_origin = Vector3::Zero();
    for (Eigen::Index i = 0; i < u.cols(); ++i) {
      const Vector3 arm = body_->x_B.col(i) + u.col(i) - motion.p_H;
      about_origin += arm.cross(Vector3(nodal.col(i)));
    }
    EXPECT_LT((nodal.rowwise().sum() - force).norm(), 1e-12);
    EXPECT_LT((about_origin - moment).norm(), 1e-12);
  }
}

TEST_P(NodalFrameOf, TransmitsThePowerOfItsNodes) {
  const NodalFrame frame = make(kOrigin);
  const Vector3 force(3.0, -2.0, 1.0);
  const Vector3 moment(0.1, 0.5, -0.7);
  const Matrix3X u = displace(exp_rotation(2.0 * kAxis), {0.2, 0, 0},
                              make_field(body_->node_count(), 0.03, 4));
  const Matrix3X udot = make_field(body_->node_count(), 2.0, 5);
  const NodalFrameMotion motion = find_motion(frame, u, udot);
  Matrix3X nodal = zero();
  add_nodal_wrench(frame, motion, force, moment, nodal);
  EXPECT_NEAR(nodal.cwiseProduct(udot).sum(),
              force.dot(motion.v_H) + moment.dot(motion.w_H), 1e-12);
}

TEST_P(NodalFrameOf, JacobianAndVelocitiesAreItsDerivatives) {
  const NodalFrame frame = make(kOrigin);
  const Matrix3 axes = exp_rotation(Vector3(1.0, 0.2, -0.4));
  const Matrix3X u = displace(exp_rotation(2.5 * kAxis), {0.2, 0, 0},
                              make_field(body_->node_count(), 0.03, 6));
  const Matrix3X udot = make_field(body_->node_count(), 1.0, 7);
  const NodalFrameMotion motion = find_motion(frame, u, udot);
  Matrix6X G(6, u.size());
  calc_nodal_jacobian(frame, motion, axes, G);

  constexpr double kStep = 1e-6;  // error of the difference: its square
  const NodalFrameMotion ahead = find_motion(frame, u + kStep * udot, udot);
  const NodalFrameMotion behind = find_motion(frame, u - kStep * udot, udot);
  const Vector3 v = (ahead.p_H - behind.p_H) / (2.0 * kStep);
  const Vector3 w =
      log_rotation(Matrix3(ahead.R_HB * behind.R_HB.transpose())) /
      (2.0 * kStep);
  EXPECT_LT((motion.v_H - v).norm(), 1e-8 * v.norm());
  EXPECT_LT((motion.w_H - w).norm(), 1e-8 * w.norm());
  const Vector6 rates = G * udot.reshaped();
  EXPECT_LT((rates.head<3>() - axes * v).norm(), 1e-8 * v.norm());
  EXPECT_LT((rates.tail<3>() - axes * w).norm(), 1e-8 * w.norm());
}

TEST_P(NodalFrameOf, IsTheMeanOfTheReducedLevelsToSecondOrder) {
  const flexbody::NodeSet& set = find_node_set(*body_, GetParam());
  if (set.nodes.size() < 2) return;  // a node has no rotation there
  const flexbody::InterfaceMotion linear(set.nodes, set.weights, set.moments,
                                         body_->x_B, 0.3);
  // About a line there is none.
  const Matrix3 defined =
      linear.rotation_axes() * linear.rotation_axes().transpose();
  const NodalFrame frame = make(linear.mean_point());
  const Matrix3X shape = make_field(body_->node_count(), 1.0, 8);
  std::vector<double> errors;
  for (const double size : {1e-3, 1e-4}) {
    const Matrix3X u = size * shape;
    const NodalFrameMotion motion = find_motion(frame, u, zero());
    const Vector6 expected = linear.apply(u.reshaped());
    EXPECT_LT((motion.p_H - linear.mean_point() - expected.head<3>()).norm(),
              1e-15);
    errors.push_back(
        (defined * log_rotation(motion.R_HB) - expected.tail<3>()).norm());
  }
  EXPECT_NEAR(std::log10(errors[0] / errors[1]), 2.0, 0.05);
}

// "first" is planar: the matrix of its rotation has rank two. A node turns with
// the body, and so does a line about itself.
INSTANTIATE_TEST_SUITE_P(Sets, NodalFrameOf,
                         ::testing::Values("first", "block", "edge", "node"),
                         [](const auto& i) { return std::string(i.param); });

TEST(NodalFrame, OfOneNodeTurnsWithTheMeanAxisFrame) {
  const testing::SpringNetwork network = make_lattice();
  const auto body = make_full(network);
  SystemBuilder builder;
  builder.add_full_body("lattice", testing::make_reduced(network, 3), body, {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.u_H = make_field(body->node_count(), 0.03, 9).reshaped();
  state.udot_H = make_field(body->node_count(), 1.0, 10).reshaped();
  MeanFrame mean;
  calc_mean_frame(model, model.full_bodies[0], state, mean);
  const NodalFrame frame =
      make_nodal_frame(*body, find_node_set(*body, "node"), kOrigin);
  const NodalFrameMotion motion =
      find_motion(frame, state.u_H.reshaped(3, body->node_count()),
                  state.udot_H.reshaped(3, body->node_count()));
  EXPECT_LT((motion.R_HB - mean.R_HB).norm(), 1e-14);
  EXPECT_LT((motion.w_H - mean.w_H).norm(), 1e-13);
}

/// Its nodes give the line's direction, and about it the rotation is the
/// nearest to all nodes: no rotation nearby is nearer.
TEST(NodalFrame, OfALineFollowsItAndTurnsAboutItWithTheBody) {
  for (const bool is_clamped : {false, true}) {
    const auto body = make_full(make_lattice({.is_clamped = is_clamped}));
    const flexbody::NodeSet& set = find_node_set(*body, "edge");
    const NodalFrame frame = make_nodal_frame(*body, set, kOrigin);
    ASSERT_TRUE(frame.is_line());
    const Matrix3X u = make_field(body->node_count(), 0.03, 9);
    const Matrix3 R = find_motion(frame, u, u).R_HB;
    const Matrix3X d =
        body->x_B(Eigen::all, set.nodes).colwise() - frame.mean_B;
    const Matrix3X p = d + u(Eigen::all, set.nodes);
    const Matrix3 of_line = p * set.weights.asDiagonal() * d.transpose();
    const Matrix3 of_body = (body->x_B + u) * body->first_moment.transpose();
    const auto change = [&](const Matrix3& A, const Vector3& turn) {
      return (A.transpose() * (exp_rotation(turn) - Matrix3::Identity()) * R)
          .trace();
    };
    constexpr double kAngle = 1e-3;
    const Vector3 along = R * (d.col(2) - d.col(0)).normalized();
    const Vector3 across = along.unitOrthogonal();
    for (const Vector3& axis : {across, along.cross(across).eval()}) {
      const double there = change(of_line, kAngle * axis);
      EXPECT_LT(there, 0.0);
      EXPECT_NEAR(change(of_line, -kAngle * axis) / there, 1.0, 1e-9);
    }
    const double there = change(of_body, kAngle * along);
    EXPECT_LT(there, 0.0);
    EXPECT_NEAR(change(of_body, -kAngle * along) / there, 1.0, 1e-9);
  }
}

TEST(NodalFrame, OfOneNodeDoesNotTurnIfItsBodyIsClamped) {
  const auto body = make_full(make_lattice({.is_clamped = true}));
  const flexbody::NodeSet& set = find_node_set(*body, "node");
  const Vector3 at = body->x_B.col(set.nodes[0]);
  const NodalFrame frame = make_nodal_frame(*body, set, at);
  EXPECT_FALSE(frame.rotates);
  const Matrix3X u = make_field(body->node_count(), 0.03, 11);
  const NodalFrameMotion motion = find_motion(frame, u, u);
  EXPECT_EQ(motion.R_HB, Matrix3::Identity());
  EXPECT_EQ(motion.w_H, Vector3::Zero());
  EXPECT_LT((motion.p_H - at - u.col(set.nodes[0])).norm(), 1e-16);
  Matrix3X nodal = Matrix3X::Zero(3, u.cols());
  add_nodal_wrench(frame, motion, {1, 2, 3}, {4, 5, 6}, nodal);
  EXPECT_EQ(nodal.col(set.nodes[0]), Vector3(1, 2, 3));
}

TEST(PolarRotation, MakesAnyMatrixSymmetricAndPositive) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const double angle = i < 10 ? uniform(random) * 3.0
                                : std::numbers::pi - 1e-9 * uniform(random);
    const Matrix3 R = exp_rotation(angle * kAxis);
    Matrix3 square;
    for (double& x : square.reshaped()) x = uniform(random);
    Matrix3 S = square * square.transpose() + 0.1 * Matrix3::Identity();
    EXPECT_LT((find_polar_rotation(R * S) - R).norm(), 1e-14 * 100.0);
    S = Vector3(2.0, 1.0, 0.0).asDiagonal();  // a plane
    EXPECT_LT((find_polar_rotation(R * S) - R).norm(), 1e-14);
  }
}

TEST(PolarRotation, IsARotationAlsoOfAReflection) {
  const Matrix3 R = find_polar_rotation(Vector3(3.0, 2.0, -1.0).asDiagonal());
  EXPECT_LT((R - Matrix3::Identity()).norm(), 1e-15);
}

}  // namespace
}  // namespace limber::dynamics::nodal_frame_test
