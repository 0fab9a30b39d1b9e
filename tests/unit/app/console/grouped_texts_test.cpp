// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/grouped_texts.hpp"

#include <gmock/gmock.h>

namespace limber::test::grouped_texts_test {
namespace {

using app::group_texts;
using ::testing::ElementsAre;

TEST(GroupedTexts, AreThoseGivenWhereAllDiffer) {
  EXPECT_THAT(group_texts({"one", "link 'a': two", "link 'a': three"}),
              ElementsAre("one", "link 'a': two", "link 'a': three"));
}

TEST(GroupedTexts, OfSeveralNamesAreOneText) {
  EXPECT_THAT(group_texts({"link 'a': soft", "other", "link 'b': soft"}),
              ElementsAre("links 'a', 'b': soft", "other"));
  EXPECT_THAT(group_texts({"joint 'a': x", "link 'a': x"}),
              ElementsAre("joint 'a': x", "link 'a': x"));
}

TEST(GroupedTexts, CountFurtherNames) {
  EXPECT_THAT(group_texts({"link '1': x", "link '2': x", "link '3': x",
                           "link '4': x", "link '5': x", "link '6': x"}),
              ElementsAre("links '1', '2', '3', '4' and 2 more: x"));
}

TEST(GroupedTexts, CountThemselves) {
  EXPECT_THAT(group_texts({"a", "a", "link 'l': b", "a", "link 'l': b"}),
              ElementsAre("a (3 times)", "link 'l': b (2 times)"));
}

TEST(GroupedTexts, TakeOnlyTheNameThatATextBeginsWith) {
  EXPECT_THAT(group_texts({"the joint 'a': x", "the joint 'b': x"}),
              ElementsAre("the joint 'a': x", "the joint 'b': x"));
}

}  // namespace
}  // namespace limber::test::grouped_texts_test
