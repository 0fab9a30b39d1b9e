// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/force_directions.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "limber/flexbody/model/load_modes_record.hpp"

namespace limber::flexbody::force_directions_test {
namespace {

constexpr double kRoundoff = 1e-13;  // n = 60, a hundred eps

MatrixX make_random(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  return MatrixX::NullaryExpr(rows, columns, [&] { return number(engine); });
}

/// A load that turns in a plane: many columns, two directions.
MatrixX make_turning(Eigen::Index columns) {
  const MatrixX plane = make_random(60, 2);
  MatrixX F(60, columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    const double angle = 0.01 * static_cast<double>(i);
    F.col(i) =
        1e3 * (std::cos(angle) * plane.col(0) + std::sin(angle) * plane.col(1));
  }
  return F;
}

TEST(ForceDirections, OfALoadThatTurnsAreTwo) {
  const MatrixX F = make_turning(2000);
  const ForceDirections found = find_force_directions(F, 1e-6, 100);
  EXPECT_TRUE(found.is_whole);
  ASSERT_EQ(found.Q.cols(), 2);
  EXPECT_LT((found.Q * found.R - F).norm(), kRoundoff * F.norm());
  EXPECT_LT((found.Q.transpose() * found.Q - MatrixX::Identity(2, 2)).norm(),
            kRoundoff);
}

TEST(ForceDirections, LeaveOutWhatIsBelowTheTolerance) {
  MatrixX F = make_turning(50);
  const VectorX other = make_random(60, 3).col(2).normalized();
  const double longest = F.colwise().norm().maxCoeff();
  F.col(7) += 0.5e-6 * longest * other;
  EXPECT_EQ(find_force_directions(F, 1e-6, 100).Q.cols(), 2);
  F.col(7) += 1e-4 * longest * other;
  EXPECT_EQ(find_force_directions(F, 1e-6, 100).Q.cols(), 3);
}

TEST(ForceDirections, BeyondTheRequestedNumberAreReported) {
  const ForceDirections found =
      find_force_directions(make_random(60, 40), 1e-6, 8);
  EXPECT_EQ(found.Q.cols(), 8);
  EXPECT_FALSE(found.is_whole);
  EXPECT_TRUE(find_force_directions(make_random(60, 40), 1e-6, 40).is_whole);
}

TEST(ForceDirections, OfNothingAreNone) {
  for (const Eigen::Index columns : {0, 3}) {
    const ForceDirections found =
        find_force_directions(MatrixX::Zero(60, columns), 1e-6, 100);
    EXPECT_EQ(found.Q.cols(), 0);
    EXPECT_TRUE(found.is_whole);
  }
}

TEST(LoadModesRecord, SpeaksOnlyOfWhatWasLeftOut) {
  EXPECT_FALSE(describe_left_out({"f.txt", 3, true, 3, 0.0}).has_value());
  EXPECT_THAT(describe_left_out({"f.txt", 30, true, 12, 0.125}).value_or(""),
              ::testing::AllOf(::testing::HasSubstr("'f.txt'"),
                               ::testing::HasSubstr("in 30 independent"),
                               ::testing::HasSubstr("the 12 largest"),
                               ::testing::HasSubstr("12.5 %")));
  EXPECT_THAT(describe_left_out({"f.txt", 90, false, 12, 0.125}).value_or(""),
              ::testing::HasSubstr("more than 90"));
}

}  // namespace
}  // namespace limber::flexbody::force_directions_test
