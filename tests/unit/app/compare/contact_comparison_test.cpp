// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/compare/contact_comparison.hpp"

#include <gmock/gmock.h>

namespace limber::app::contact_comparison_test {
namespace {

using ::testing::HasSubstr;

// Also if it is the reference that misses.
TEST(ContactComparison, NamesARunThatDoesNotTouch) {
  const runs::PairContact contact{"a/b", 1, 1, 2.0, 10.0, 0.5, 0.8};
  EXPECT_THAT(to_text({{"one", {contact}}}, {"truth", {}}),
              HasSubstr("truth  does not touch"));
  EXPECT_THAT(to_text({{"one", {}}}, {"truth", {contact}}),
              HasSubstr("one    does not touch"));
  EXPECT_EQ(to_text({{"one", {}}}, {"truth", {}}), "");
  const std::vector<runs::PairContact> none;
  EXPECT_TRUE(to_json({contact}, &none)[0]["error"].is_null());
  EXPECT_FALSE(to_json({contact}, nullptr)[0].contains("error"));
}

}  // namespace
}  // namespace limber::app::contact_comparison_test
