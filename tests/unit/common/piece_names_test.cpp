// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/piece_names.hpp"

#include <gtest/gtest.h>

namespace limber::piece_names_test {
namespace {

TEST(PieceNames, CountFromOne) { EXPECT_EQ(name_piece("arm", 0), "arm.1"); }

TEST(PieceNames, TellTheLink) {
  EXPECT_EQ(find_whole("arm.12"), "arm");
  EXPECT_EQ(find_whole("robot.arm.2"), "robot.arm");
}

TEST(PieceNames, OfOtherBodiesAreTheirOwn) {
  for (const char* name : {"arm", "robot.arm", "arm.", "arm.2b", ".2", ""}) {
    EXPECT_EQ(find_whole(name), name);
  }
}

}  // namespace
}  // namespace limber::piece_names_test
