// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/motion_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace limber::results::motion_shapes_test {
namespace {

/// Of three shapes with independent courses, the third a 1e-3 of the others.
MatrixX make_motion(Eigen::Index times) {
  MatrixX shapes(12, 3);
  for (Eigen::Index i = 0; i < shapes.rows(); ++i) {
    const auto x = static_cast<double>(i);
    shapes.row(i) << std::sin(x), std::cos(2.0 * x), 1e-3 * std::sin(3.0 * x);
  }
  MatrixX u(12, times);
  for (Eigen::Index k = 0; k < times; ++k) {
    const double t = 0.01 * static_cast<double>(k);
    u.col(k) = shapes * Vector3(std::sin(7.0 * t), t * t, std::cos(31.0 * t));
  }
  return u;
}

struct Motion {
  MatrixX shapes;
  MatrixX coordinates;
  double error = 0.0;
};

Motion find(
    const MatrixX& u,
    const std::function<double(const VectorX&)>& size = find_largest_length) {
  const auto column = [&](std::size_t i) {
    return VectorX(u.col(static_cast<Eigen::Index>(i)));
  };
  const auto count = static_cast<std::size_t>(u.cols());
  Motion motion;
  motion.shapes = find_motion_shapes(column, count);
  motion.coordinates.resize(u.cols(), motion.shapes.cols());
  Eigen::Index row = 0;
  motion.error = find_coordinates(
      motion.shapes, column, count,
      [&](const VectorX& q) { motion.coordinates.row(row++) = q; }, size);
  return motion;
}

TEST(MotionShapes, OfThreeShapesAreThree) {
  const MatrixX u = make_motion(400);  // more than the snapshots
  const Motion motion = find(u);
  ASSERT_EQ(motion.shapes.cols(), 3);
  EXPECT_LT(
      (motion.shapes.transpose() * motion.shapes - Matrix3::Identity()).norm(),
      1e-9);
  EXPECT_LT((motion.shapes * motion.coordinates.transpose() - u).norm(),
            1e-8 * u.norm());
  EXPECT_LT(motion.error, 1e-8 * u.cwiseAbs().maxCoeff());
}

TEST(MotionShapes, StateWhatTheyLeaveOut) {
  MatrixX u = make_motion(100);
  u.row(4) += 1e-7 * Eigen::RowVectorXd::Random(100);
  const Motion motion = find(u);
  const MatrixX rest = u - motion.shapes * motion.coordinates.transpose();
  double largest = 0.0;
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    largest = std::max(largest,
                       rest.col(k).reshaped(3, 4).colwise().norm().maxCoeff());
  }
  EXPECT_NEAR(motion.error, largest, 1e-15);
  EXPECT_GT(motion.error, 0.0);
  EXPECT_LT(motion.error, 1e-6);
}

TEST(MotionShapes, OfAnotherFieldStateItsOwnSizeOfWhatTheyLeaveOut) {
  MatrixX field = make_motion(100);
  field.row(7) += 1e-7 * Eigen::RowVectorXd::Random(100);
  const Motion shapes = find(field, [](const VectorX& rest) {
    return rest.segment<6>(6).cwiseAbs().sum();
  });
  const MatrixX rest = field - shapes.shapes * shapes.coordinates.transpose();
  const double largest =
      rest.middleRows<6>(6).cwiseAbs().colwise().sum().maxCoeff();
  EXPECT_GT(largest, 0.0);
  EXPECT_NEAR(shapes.error, largest, 1e-15);
}

TEST(MotionShapes, OfABodyAtRestAreNone) {
  const Motion motion = find(MatrixX::Zero(6, 5));
  EXPECT_EQ(motion.shapes.cols(), 0);
  EXPECT_EQ(motion.coordinates.rows(), 5);
  EXPECT_EQ(motion.error, 0.0);
}

}  // namespace
}  // namespace limber::results::motion_shapes_test
