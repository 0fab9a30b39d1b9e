// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace limber::utf8_test {
namespace {

TEST(Utf8, IsTextOfEveryLength) {
  for (const char* text :
       {"", "arm", "\x7f", "Tr\xc3\xa4ger", "\xe2\x82\xac", "\xf0\x9f\x98\x80",
        "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
}

TEST(Utf8, IsNotLatin1NorACharacterCutShort) {
  for (const char* text : {"b\xff", "Tr\xe4ger", "\x80", "a\xc3", "\xe2\x82",
                           "\xf0\x9f\x98", "\xe2\x28\xa1"}) {
    EXPECT_FALSE(is_utf8(text)) << text;
  }
}

// Of the forms that decoders have mistaken for others (RFC 3629, section 10).
TEST(Utf8, IsNoOverlongFormNorSurrogateNorBeyondTheLastCharacter) {
  for (const char* text :
       {"\xc0\xaf", "\xc1\xbf", "\xe0\x80\xaf", "\xf0\x80\x80\xaf",
        "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(text)) << text;
  }
}

TEST(Utf8, MeasuresTheCharacterAtAPlace) {
  const std::string text = "a\xc3\xa4\xe2\x82\xac\xff";
  EXPECT_EQ(measure_utf8(text, 0), 1U);
  EXPECT_EQ(measure_utf8(text, 1), 2U);
  EXPECT_EQ(measure_utf8(text, 2), 0U);
  EXPECT_EQ(measure_utf8(text, 3), 3U);
  EXPECT_EQ(measure_utf8(text, 6), 0U);
}

}  // namespace
}  // namespace limber::utf8_test
