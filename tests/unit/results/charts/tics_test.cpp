// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/tics.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace limber::results::tics_test {
namespace {

using ::testing::ElementsAre;

void expect_readable(const std::vector<double>& places, double least,
                     double most) {
  ASSERT_GE(places.size(), 2U) << least << " to " << most;
  EXPECT_LE(places.size(), 9U) << least << " to " << most;
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  EXPECT_GE(places.front(), least * (1.0 - 1e-6));
  EXPECT_LE(places.back(), most * (1.0 + 1e-6));
}

TEST(Tics, OfEveryLogarithmicAxisAreTwoToNine) {
  for (const double ratio : {1.05, 1.3, 2.0, 3.1, 5.2, 6.0, 9.7, 12.0, 25.0,
                             51.0, 99.0, 450.0, 3e4, 1e9, 1e30}) {
    for (double first = -12.0; first < 6.0; first += 0.137) {
      const double least = std::pow(10.0, first);
      expect_readable(list_logarithmic_tics(least, ratio * least), least,
                      ratio * least);
    }
  }
}

TEST(Tics, OfEveryEvenAxisAreTwoToFive) {
  for (double exponent = -6.0; exponent < 6.0; exponent += 0.0731) {
    for (const double place : {0.0, 0.313, 1.77, 2.49}) {
      const double range = std::pow(10.0, exponent);
      const std::vector<double> places =
          list_even_tics(place * range, (place + 1.0) * range);
      expect_readable(places, place * range, (place + 1.0) * range);
      EXPECT_LE(places.size(), 5U);
    }
  }
}

TEST(Tics, ArePowersOfTenWhereThereAreThree) {
  EXPECT_THAT(list_logarithmic_tics(0.5, 150.0), ElementsAre(1.0, 10.0, 100.0));
  EXPECT_THAT(list_logarithmic_tics(1.5, 6.0),
              ElementsAre(2.0, 3.0, 4.0, 5.0, 6.0));
}

TEST(Tics, AreAListOfGnuplot) {
  EXPECT_EQ(to_tics({0.1, 1.0, 1e6}), "(0.1, 1, 1000000)");
}

}  // namespace
}  // namespace limber::results::tics_test
