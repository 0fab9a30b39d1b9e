// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_clusters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace limber::scene::stress_clusters_test {
namespace {

/// Written out, apart from the library's.
double mises(const Vector6& s) {
  return std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2] - s[0] * s[1] -
                   s[1] * s[2] - s[2] * s[0] +
                   3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Points on a box's surface with stress that varies smoothly, and some that
/// does not.
struct Field {
  explicit Field(int count, double rough) : p(3, count), Sigma(6 * count, 7) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto draw = [&] { return uniform(random); };
    const MatrixX slopes = MatrixX::NullaryExpr(6 * 7, 3, draw);
    for (Eigen::Index i = 0; i < count; ++i) {
      p.col(i) = Vector3(draw(), draw(), draw());
      p(i % 3, i) = i % 2 == 0 ? 1.0 : -1.0;
      const VectorX smooth = (slopes * p.col(i)).array().sin();
      Sigma.middleRows(6 * i, 6) =
          smooth.reshaped(6, 7) + rough * MatrixX::NullaryExpr(6, 7, draw);
    }
  }
  VectorX draw_eta() {
    std::normal_distribution<double> normal;
    return VectorX::NullaryExpr(7, [&] { return normal(random); });
  }
  std::mt19937 random{7};
  Matrix3X p;
  MatrixX Sigma;
};

class Clusters : public ::testing::TestWithParam<std::pair<int, double>> {};

TEST_P(Clusters, FindTheLargestOfAllPoints) {
  Field field(GetParam().first, GetParam().second);
  const StressClusters clusters(field.p, field.Sigma);
  const auto& order = clusters.order();
  ASSERT_EQ(order.size(), static_cast<std::size_t>(field.p.cols()));
  MatrixX ordered(field.Sigma.rows(), 7);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ordered.middleRows(6 * static_cast<Eigen::Index>(i), 6) =
        field.Sigma.middleRows(6 * order[i], 6);
  }
  for (int trial = 0; trial < 50; ++trial) {
    const VectorX eta = field.draw_eta();
    const auto found = clusters.find(ordered, eta);
    double largest = 0.0;
    Eigen::Index at = 0;
    for (Eigen::Index i = 0; i < field.p.cols(); ++i) {
      const double value =
          mises(Vector6(field.Sigma.middleRows(6 * i, 6) * eta));
      if (value > largest) {
        largest = value;
        at = i;
      }
    }
    EXPECT_NEAR(found.von_mises, largest, 1e-12 * largest);
    EXPECT_EQ(order[static_cast<std::size_t>(found.point)], at);
    EXPECT_LT((found.stress - field.Sigma.middleRows(6 * at, 6) * eta).norm(),
              1e-12 * largest);
  }
}

// What an earlier call has seen bounds the stress of the next: steps of a
// motion, with jumps, back to what was, and to nothing.
TEST_P(Clusters, FindTheLargestOfASlowMotion) {
  Field field(GetParam().first, GetParam().second);
  const StressClusters clusters(field.p, field.Sigma);
  MatrixX ordered(field.Sigma.rows(), 7);
  for (std::size_t i = 0; i < clusters.order().size(); ++i) {
    ordered.middleRows(6 * static_cast<Eigen::Index>(i), 6) =
        field.Sigma.middleRows(6 * clusters.order()[i], 6);
  }
  const VectorX a = field.draw_eta();
  const VectorX b = field.draw_eta();
  for (int step = 0; step < 400; ++step) {
    const double angle = (step % 150) * 0.03;
    VectorX eta = std::sin(angle) * a + std::cos(7.0 * angle) * b;
    if (step % 97 == 0) eta.setZero();
    if (step % 101 == 0) eta *= 1e6;
    const auto found = clusters.find(ordered, eta);
    // A search without memory.
    const auto anew = StressClusters(field.p, field.Sigma).find(ordered, eta);
    ASSERT_EQ(found.point, anew.point) << step;
    ASSERT_EQ(found.von_mises, anew.von_mises) << step;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < field.p.cols(); ++i) {
      largest =
          std::max(largest, mises(Vector6(ordered.middleRows(6 * i, 6) * eta)));
    }
    ASSERT_NEAR(found.von_mises, largest, 1e-12 * largest) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fields, Clusters,
    ::testing::Values(std::pair(1, 0.1), std::pair(24, 0.1), std::pair(25, 0.0),
                      std::pair(700, 0.0), std::pair(700, 0.05),
                      std::pair(700, 2.0)));

TEST(StressClusters, OfNoDeformationHaveNoStress) {
  Field field(100, 0.1);
  const StressClusters clusters(field.p, field.Sigma);
  EXPECT_EQ(clusters.find(field.Sigma, VectorX::Zero(7)).von_mises, 0.0);
}

TEST(StressClusters, OfADivergingRunAreNotANumber) {
  Field field(100, 0.1);
  const StressClusters clusters(field.p, field.Sigma);
  VectorX eta = VectorX::Ones(7);
  eta[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(clusters.find(field.Sigma, eta).von_mises));
  eta.setConstant(1e308);
  EXPECT_TRUE(std::isnan(clusters.find(field.Sigma, eta).von_mises));
  eta.setOnes();  // forgets it
  EXPECT_GT(clusters.find(field.Sigma, eta).von_mises, 0.0);
}

}  // namespace
}  // namespace limber::scene::stress_clusters_test
