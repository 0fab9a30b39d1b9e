// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace limber::study::distribution_test {
namespace {

Study make_study(DesignKind kind, std::size_t factors) {
  Study study;
  study.design.kind = kind;
  study.factors.resize(factors);
  study.responses.resize(1);
  return study;
}

std::vector<StudyRow> make_rows(const std::vector<double>& values) {
  std::vector<StudyRow> rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    StudyRow row;
    row.run = i;
    row.responses = {values[i]};
    rows.push_back(row);
  }
  return rows;
}

// Tables of Student's distribution, two-sided 95 %.
TEST(StudyDistribution, HasStudentsQuantiles) {
  const std::vector<std::pair<std::size_t, double>> table = {
      {1, 12.7062}, {2, 4.3027},  {3, 3.1824},   {4, 2.7764},
      {9, 2.2622},  {29, 2.0452}, {100, 1.9840}, {1000000, 1.95996}};
  for (const auto& [degrees, t] : table) {
    EXPECT_NEAR(find_student_quantile(degrees), t, 3e-3 * t) << degrees;
  }
}

TEST(StudyDistribution, HasMeanAndQuantilesOfTheRunsThatHaveAValue) {
  auto rows = make_rows({4.0, 1.0, 3.0, 2.0, 0.0});
  rows[4].responses[0].reset();
  const auto found =
      find_distribution(make_study(DesignKind::monte_carlo, 1), rows, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->values, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
  EXPECT_DOUBLE_EQ(found->mean, 2.5);
  // s^2 = 5/3; t(3) = 3.18245
  EXPECT_NEAR(found->mean_error, 3.18245 * std::sqrt(5.0 / 3.0 / 4.0), 6e-3);
  EXPECT_EQ(found->quantile(0.25), 1.0);
  EXPECT_EQ(found->quantile(0.26), 2.0);
  EXPECT_EQ(found->quantile(0.99), 4.0);
}

// Of 2000 experiments with 40 samples each; exact: 95 % for the mean, at least
// 95 % for the band. The standard deviation of a fraction of 2000 is 0.5 %.
TEST(StudyDistribution, HasIntervalsThatHoldInNineteenOfTwentyExperiments) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(3.0, 2.0);
  const auto study = make_study(DesignKind::monte_carlo, 1);
  int means = 0;
  int bands = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> samples(40);
    for (double& x : samples) x = normal(random);
    const auto found = find_distribution(study, make_rows(samples), 0);
    ASSERT_TRUE(found);
    means += std::abs(found->mean - 3.0) <= found->mean_error ? 1 : 0;
    double largest = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double truth =
          0.5 * std::erfc((3.0 - found->values[k]) / (2.0 * std::sqrt(2.0)));
      largest = std::max({largest, std::abs(truth - (k + 1) / 40.0),
                          std::abs(truth - k / 40.0)});
    }
    bands += largest <= found->band ? 1 : 0;
  }
  EXPECT_NEAR(means / 2000.0, 0.95, 0.02);
  EXPECT_GE(bands / 2000.0, 0.94);
  EXPECT_LE(bands / 2000.0, 0.985);  // a band that is no wider than it must be
}

TEST(StudyDistribution, TakesOfSobolsRunsTheIndependentOnesAlone) {
  // 2 factors: blocks of A, B and two that share values with them.
  const auto found =
      find_distribution(make_study(DesignKind::sobol, 2),
                        make_rows({1.0, 2.0, 9.0, 9.0, 3.0, 4.0, 9.0, 9.0}), 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->values, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
}

TEST(StudyDistribution, IsNotOfGridsListsAndSingleRuns) {
  const auto rows = make_rows({1.0, 2.0});
  EXPECT_FALSE(find_distribution(make_study(DesignKind::grid, 1), rows, 0));
  EXPECT_FALSE(find_distribution(make_study(DesignKind::list, 1), rows, 0));
  EXPECT_FALSE(find_distribution(make_study(DesignKind::monte_carlo, 1),
                                 make_rows({1.0}), 0));
}

}  // namespace
}  // namespace limber::study::distribution_test
