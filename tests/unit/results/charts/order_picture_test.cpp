// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/order_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "unit/results/temporary_folder.hpp"

namespace limber::results::order_picture_test {
namespace {

TEST(OrderPicture, IsDrawnOfWhatIsAboveZero) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "order.png";
  const std::vector<OrderLine> lines = {{"nothing", {1.0, 10.0}, {0.0, NAN}},
                                        {"it's [m]", {1.0, 10.0}, {2.0, 0.2}}};
  EXPECT_EQ(draw_order(file, "a 'title'", "x", "y", -1.0, lines), "");
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_NE(draw_order(file, "none", "x", "y", -1.0, {lines[0]}), "");
}

}  // namespace
}  // namespace limber::results::order_picture_test
