// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/draw_all.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace limber::results::draw_all_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(DrawAll, DrawsEachOnce) {
  std::vector<std::atomic<int>> drawn(20);
  std::vector<Picture> pictures;
  for (std::atomic<int>& count : drawn) {
    pictures.emplace_back([&count] {
      ++count;
      return std::string();
    });
  }
  EXPECT_THAT(draw_all(pictures), IsEmpty());
  for (const std::atomic<int>& count : drawn) EXPECT_EQ(count, 1);
  EXPECT_THAT(draw_all({}), IsEmpty());
}

TEST(DrawAll, TellsEachReasonOnceInTheOrderOfPictures) {
  const auto say = [](const std::string& why) { return [why] { return why; }; };
  EXPECT_THAT(draw_all({say("a"), say(""), say("a")}), ElementsAre("a"));
  EXPECT_THAT(draw_all({say(""), say("b"), say("a")}), ElementsAre("b", "a"));
}

TEST(DrawAll, GivesUpOnceThreeHaveFailed) {
  std::atomic<int> begun = 0;
  std::vector<Picture> pictures(1000, [&begun] {
    ++begun;
    return std::string("missing");
  });
  EXPECT_THAT(draw_all(pictures), ElementsAre("missing"));
  EXPECT_LT(begun, 10);  // three, and those that others had begun
}

TEST(DrawAll, ThrowsInTheCallersThread) {
  std::vector<Picture> pictures(
      10, []() -> std::string { throw std::runtime_error("no memory"); });
  EXPECT_THROW(static_cast<void>(draw_all(pictures)), std::runtime_error);
}

}  // namespace
}  // namespace limber::results::draw_all_test
