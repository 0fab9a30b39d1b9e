// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/selection_record.hpp"

#include <gmock/gmock.h>

namespace limber::flexbody::selection_record_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SelectionRecord record_of(const std::vector<double>& reached) {
  SelectionRecord record;
  record.candidates = 60;
  for (const double fraction : reached)
    record.cases.push_back({"case", {}, fraction, 0.25, 0.5});
  return record;
}

TEST(SelectionRecord, SaysNothingWhereTheThresholdIsReached) {
  EXPECT_THAT(describe_shortfalls(record_of({0.9, 1.0, 0.95})), IsEmpty());
  EXPECT_THAT(describe_shortfalls({}), IsEmpty());
}

TEST(SelectionRecord, NamesTheCaseTheShareAndTheErrors) {
  SelectionRecord record = record_of({0.95, 0.875});
  record.cases[1].name = "tip, force";
  EXPECT_THAT(describe_shortfalls(record),
              ElementsAre(AllOf(HasSubstr("'tip, force'"), HasSubstr("87.5 %"),
                                HasSubstr("not 90 %"), HasSubstr("25 %"),
                                HasSubstr("50 %"))));
}

TEST(SelectionRecord, NamesTheWorstOfManyAndCountsTheRest) {
  const auto texts =
      describe_shortfalls(record_of({0.7, 0.6, 0.1, 0.5, 0.4, 0.3, 0.2}));
  ASSERT_EQ(texts.size(), 5U);
  EXPECT_THAT(texts[0], HasSubstr("reach 10 %"));
  EXPECT_THAT(texts[3], HasSubstr("reach 40 %"));
  EXPECT_THAT(texts[4], HasSubstr("3 further load cases"));
}

}  // namespace
}  // namespace limber::flexbody::selection_record_test
