// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::reduce_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

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

// A field that no ten modes hold.
TEST_F(Reduce, ProjectsAnInitialDisplacementAndKeepsIt) {
  std::string field;
  for (int node = 0; node < 579; ++node)
    field += fmt::format("{}\n0\n0\n", node);
  place_.write("u.txt", field);
  const CommandResult result = reduce("--initial-displacement u.txt");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json kept = json::parse(place_.limber("info body.h5 --json").out);
  EXPECT_EQ(kept["initial_displacement"]["modes"].size(), 10U);
  EXPECT_GT(kept["initial_displacement"]["missed_share"], 0.0);
  EXPECT_FALSE(kept.contains("initial_velocity"));
}

// Three columns in two directions, on the first nodes of the mesh.
TEST_F(Reduce, AnswersNodalForcesByAModeForEachDirectionAndTerm) {
  std::string forces = "0 1 2\n1 0 2\n0 1 3\n";
  for (int row = 2; row < 3 * 579; ++row) forces += "0 0 0\n";
  place_.write("f.txt", forces);
  const auto count = [&](const std::string& more) {
    const CommandResult result = reduce("--modes 4 --force f.txt " + more);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out)["modes"].get<int>();
  };
  EXPECT_EQ(count(""), 4 + 2);
  EXPECT_EQ(count("--terms 3"), 4 + 3 * 2);
  const CommandResult alone = reduce("--terms 2");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.errors, HasSubstr("--force or --interface"));
}

TEST_F(Reduce, RefusesToChooseByNothing) {
  const CommandResult result = reduce("--modes auto");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("need a load"));
}

}  // namespace
}  // namespace limber::test::reduce_test
