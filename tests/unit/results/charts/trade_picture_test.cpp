// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/trade_picture.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>

#include "unit/results/temporary_folder.hpp"

namespace limber::results::trade_picture_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TradeFront, HoldsWhatNothingCheaperBeats) {
  EXPECT_THAT(find_front({4.0, 1.0, 2.0, 3.0}, {0.01, 0.5, 0.1, 0.2}),
              ElementsAre(1U, 2U, 0U));
}

TEST(TradeFront, HoldsTheBetterOfTwoAtOneCost) {
  EXPECT_THAT(find_front({1.0, 1.0}, {0.3, 0.2}), ElementsAre(1U));
}

TEST(TradeFront, LeavesOutWhatHasNoError) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(find_front({1.0, 2.0, 3.0}, {std::nullopt, nan, 0.1}),
              ElementsAre(2U));
  EXPECT_THAT(find_front({}, {}), IsEmpty());
}

TEST(TradePicture, IsDrawnWithWhateverErrorsThereAre) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "trade.png";
  const std::vector<TradePoint> points = {
      {"rigid", "", 1e-4, 0.2, 1.0},
      {"coupled", "it's 10 modes", 1e-2, 0.0, std::nullopt}};
  EXPECT_EQ(draw_trade(file, "a 'trade'", points, 0.1, 0.01), "");
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(draw_trade(file, "nothing", {}, 0.1, std::nullopt), "");
}

}  // namespace
}  // namespace limber::results::trade_picture_test
