// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/length_unit.hpp"

#include <gtest/gtest.h>

namespace limber::test::length_unit_test {
namespace {

TEST(LengthUnit, HasANameOrIsANumberOfMetres) {
  EXPECT_EQ(parse_length_unit("m"), 1.0);
  EXPECT_EQ(parse_length_unit("cm"), 0.01);
  EXPECT_EQ(parse_length_unit("mm"), 0.001);
  EXPECT_EQ(parse_length_unit("in"), 0.0254);
  EXPECT_EQ(parse_length_unit("ft"), 0.3048);
  EXPECT_EQ(parse_length_unit("1e-6"), 1e-6);
}

TEST(LengthUnit, IsNothingElse) {
  for (const char* text :
       {"", "0", "-1", "nan", "inf", "MM", "mm ", "inch", "km", "1 mm"}) {
    EXPECT_EQ(parse_length_unit(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace limber::test::length_unit_test
