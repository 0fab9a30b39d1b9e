// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verification/shear_load.hpp"

/// Eigenmodes chosen by the report's measure: slow, because it takes all modes
/// of the mesh.
namespace limber::automatic_modes_slow {
namespace {

using flexbody::ModeMeasure;
using test::beam;
using ::testing::ElementsAre;

// Table 2, left: mode 1 has 94.91 %, mode 4 1.96 %, no other more than 0.97 %.
TEST(AutomaticModesByTheReport, AreThoseOfItsTable2) {
  const VectorX load = test::shear_load(beam());
  const auto with = [&](double threshold) {
    return test::select_modes(load, {threshold, ModeMeasure::report, 10});
  };
  EXPECT_THAT(with(0.9).modes, ElementsAre(0));
  const flexbody::SelectionRecord two = with(0.96);
  EXPECT_THAT(two.modes, ElementsAre(0, 3));
  EXPECT_NEAR(two.cases[0].reached, 0.9687, 0.005);
}

}  // namespace
}  // namespace limber::automatic_modes_slow
