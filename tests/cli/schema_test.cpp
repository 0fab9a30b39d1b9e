// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::schema_test {
namespace {

using ::testing::HasSubstr;

// docs.Schema compares that file with what the command reads.
TEST(Schema, IsPrintedAsInTheReference) {
  const Workspace place;
  const CommandResult result = place.limber("schema");
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(result.out, read_text(LIMBER_SOURCE_DIR
                                  "/docs/reference/scenario.schema.json"));
  EXPECT_TRUE(
      nlohmann::json::parse(result.out)["properties"].contains("robot"));
  EXPECT_EQ(place.limber("-q schema").out, result.out);
}

TEST(Schema, TakesNoArgumentsAndReportsAFullDisk) {
  const Workspace place;
  const CommandResult result = place.limber("schema scene.toml");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("scene.toml"));
  EXPECT_NE(run_shell(place, "limber schema > /dev/full").status, 0);
}

}  // namespace
}  // namespace limber::test::schema_test
