// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace limber::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Reduce : public ::testing::Test {
 protected:
  [[nodiscard]] CommandResult reduce(const std::string& more) const {
    return place_.limber(
        "reduce " LIMBER_SOURCE_DIR
        "/meshes/beam579.msh --youngs-modulus 200e9 --poisson-ratio 0 "
        "--density 8000 --output body.h5 --json " +
        more);
  }
  Workspace place_;
};

TEST_F(Reduce, ChoosesModesByItsInterfacesAndKeepsTheRecord) {
  const CommandResult result =
      reduce("--interface tip --modes auto --threshold 0.5 --candidates 40");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json chosen = json::parse(result.out)["automatic_modes"];
  EXPECT_EQ(chosen["cases"].size(), 6U);
  for (const json& item : chosen["cases"]) {
    EXPECT_GE(item["reached"], 0.5);
    EXPECT_LT(item["static_error_of_basis"], 1e-5);
  }
  const json kept = json::parse(place_.limber("info body.h5 --json").out);
  EXPECT_EQ(kept["automatic_modes"], chosen);
}

TEST_F(Reduce, RefusesToChooseByNothing) {
  const CommandResult result = reduce("--modes auto");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("need a load"));
}

}  // namespace
}  // namespace limber::test
