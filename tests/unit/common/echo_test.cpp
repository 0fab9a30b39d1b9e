// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/echo.hpp"

#include <gtest/gtest.h>

#include <string>

#include "limber/common/names.hpp"

namespace limber::echo_test {
namespace {

TEST(Echo, LeavesOrdinaryTextAsItIs) {
  EXPECT_EQ(echo("bras gauche, épaule"), "bras gauche, épaule");
}

TEST(Echo, SpellsOutControlCharacters) {
  using namespace std::string_literals;
  EXPECT_EQ(echo("a\0b\x1b[2J\n\t\x7f\xc2\x9b"s),
            "a\\x00b\\x1b[2J\\n\\t\\x7f\\xc2\\x9b");
}

TEST(Echo, SpellsOutBytesThatAreNotUtf8) {
  EXPECT_EQ(echo("b\xff Tr\xe4ger \xe2\x82"), "b\\xff Tr\\xe4ger \\xe2\\x82");
}

TEST(Echo, EndsAfterTwoHundredCharactersAndSaysSo) {
  EXPECT_EQ(echo(std::string(200, 'x')), std::string(200, 'x'));
  EXPECT_EQ(echo(std::string(1000, 'x')),
            std::string(200, 'x') + "... (1000 bytes in all)");
}

TEST(Echo, CutsBetweenCharactersOfUtf8) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += "é";
  EXPECT_EQ(echo(text), text.substr(0, 400) + "... (600 bytes in all)");
}

// Bytes that continue nothing are no reason to echo a million of them.
TEST(Echo, EndsWhateverTheBytes) {
  EXPECT_LT(echo(std::string(1000000, '\x80')).size(), 1200U);
}

TEST(Echo, KeepsTheLinesOfAWholeMessage) {
  EXPECT_EQ(escape_controls("one\ntwo\x1b"), "one\ntwo\\x1b");
}

TEST(DescribeUnknown, EchoesTheNameAndTheKnownOnes) {
  const std::string text = describe_unknown("key", std::string(100000, 'k'),
                                            {"a\x1b", std::string(5000, 'n')});
  EXPECT_LT(text.size(), 1000U);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace limber::echo_test
