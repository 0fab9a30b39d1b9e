// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/mesh_locking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limber::flexbody::mesh_locking_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(MeshLocking, IsReportedWithItsSizeAndBothFrequencies) {
  const auto text = describe_locking(MeshLocking{18.45, 12.3});
  ASSERT_TRUE(text.has_value());
  EXPECT_THAT(*text, AllOf(HasSubstr("18.45 Hz"), HasSubstr("50 % too high"),
                           HasSubstr("12.3 Hz"), HasSubstr("order 2")));
}

TEST(MeshLocking, HasAsManyDigitsAsAnEstimateBears) {
  EXPECT_THAT(*describe_locking(MeshLocking{245.9, 111.3}),
              HasSubstr("about 121 % too high"));
  EXPECT_THAT(*describe_locking(MeshLocking{102.34, 100.0}),
              HasSubstr("about 2.3 % too high"));
}

TEST(MeshLocking, BelowOnePercentOrOfNoMeshIsNotReported) {
  EXPECT_FALSE(describe_locking(MeshLocking{100.9, 100.0}).has_value());
  EXPECT_TRUE(describe_locking(MeshLocking{101.1, 100.0}).has_value());
  EXPECT_FALSE(describe_locking(std::nullopt).has_value());
}

}  // namespace
}  // namespace limber::flexbody::mesh_locking_test
