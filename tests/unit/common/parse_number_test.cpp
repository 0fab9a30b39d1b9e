// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/parse_number.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace limber::parse_number_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ParseNumber, ReadsDecimalsToTheLastBit) {
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("-2.5e-3"), -2.5e-3);
  EXPECT_EQ(parse_number("+7"), 7.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("1.7976931348623157e308"),
            std::numeric_limits<double>::max());
  EXPECT_EQ(parse_number("4.9406564584124654e-324"),
            std::numeric_limits<double>::denorm_min());
}

TEST(ParseNumber, RefusesAllElse) {
  for (const char* text : {"", "+", "+-1", " 1", "1 ", "1,5", "1e400", "inf",
                           "nan", "0x10", "1e", "--1", "1.2.3"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
  EXPECT_EQ(parse_number({"1\0", 2}), std::nullopt);
}

TEST(SplitWords, PassesOverAnyBlanks) {
  EXPECT_THAT(split_words(" a\tbc \r\n d"), ElementsAre("a", "bc", "d"));
  EXPECT_THAT(split_words(" \t "), IsEmpty());
}

}  // namespace
}  // namespace limber::parse_number_test
