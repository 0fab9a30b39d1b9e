// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::wobble_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kNodes = 579;

/// The WOBBLE package's files: 100 N in x on node 1, for ever.
class Wobble : public ::testing::Test {
 protected:
  void SetUp() override {
    place_.write("material.dat",
                 "material elastic [\n name = steel\n rho = 8000\n E = 200e9\n"
                 " nu = 0\n]\n");
    place_.write("force.txt", force_rows(kNodes));
  }

  static std::string force_rows(int nodes, const std::string& times = "0") {
    std::string text = times + "\n100\n";
    for (int dof = 1; dof < 3 * nodes; ++dof) text += "0\n";
    return text;
  }

  [[nodiscard]] CommandResult wobble(const std::string& more) const {
    return place_.limber(
        "wobble --mesh " LIMBER_SOURCE_DIR
        "/meshes/beam579.msh --material material.dat --force force.txt "
        "--step 1e-3 --duration 0.05 --out o --cache c " +
        more + (more.find("--modes") == std::string::npos ? " --modes 4" : ""));
  }

  Workspace place_;
};

// F t^2 / (2 m) for the centre of mass; its energy is the work.
TEST_F(Wobble, MovesAFreeBodyByItsForces) {
  for (const char* solver : {"SimpleRB", "CoupledRB"}) {
    const CommandResult result =
        wobble(fmt::format("--solver {} --node 1 --json", solver));
    ASSERT_EQ(result.status, 0) << result.errors;
    const json run = json::parse(result.out);
    EXPECT_EQ(run["steps"], 50);
    const double energy = run["energy"]["final"];
    EXPECT_NEAR(energy, run["energy"]["work"].get<double>(), 0.01 * energy);
    const double moved = run["probes"]["node_1.ux"]["final"];
    // The corner turns with the beam: it moves further than the centre.
    EXPECT_GT(moved, 100.0 * 0.05 * 0.05 / (2.0 * 40000.0));
  }
}

TEST_F(Wobble, HoldsAClampedBody) {
  place_.write("force.txt", force_rows(kNodes - 37));
  const CommandResult result = wobble("--solver PureMA --clamp root --json");
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST_F(Wobble, NeedsNoStepsForABodyThatIsHeld) {
  place_.write("force.txt", force_rows(kNodes - 37));
  const std::string held = "--solver PureMA --clamp root --node 3 --json ";
  const CommandResult exact = wobble(held);
  const CommandResult stepped = wobble(held + "--integrator explicit-euler");
  ASSERT_EQ(exact.status, 0) << exact.errors;
  ASSERT_EQ(stepped.status, 0) << stepped.errors;
  const json a = json::parse(exact.out);
  const json b = json::parse(stepped.out);
  EXPECT_EQ(a["steps"], 0);
  EXPECT_EQ(a["modes_exact"], 4);
  EXPECT_EQ(b["steps"], 50);
  // The package's scheme is exact for a load that is constant over a step.
  for (const char* axis : {"x", "y", "z"}) {
    const std::string name = std::string("node_3.u") + axis;
    const double peak = a["probes"]["node_3.ux"]["peak"];
    EXPECT_NEAR(a["probes"][name]["final"].get<double>(),
                b["probes"][name]["final"].get<double>(),
                1e-10 * std::abs(peak));
  }
}

TEST_F(Wobble, RefusesAStepThatIsNotPositive) {
  for (const char* step : {"-1", "0", "nan", "soon"}) {
    const CommandResult result = place_.limber(fmt::format(
        "wobble --mesh m --material a --force f --duration 1 --step {}", step));
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors,
                HasSubstr(fmt::format("is {}; expected a number > 0", step)));
  }
}

TEST_F(Wobble, ChoosesModesByItsForces) {
  const CommandResult result = wobble("--modes auto --threshold 0.4 --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json chosen = json::parse(result.out)["automatic_modes"]["beam579"];
  EXPECT_EQ(chosen["cases"].size(), 1U);
  EXPECT_EQ(chosen["cases"][0]["load"], "force.txt from 0 s");
  EXPECT_GE(chosen["cases"][0]["reached"], 0.4);
  EXPECT_LT(chosen["eigenmodes"].size(), chosen["candidates"]);
}

TEST_F(Wobble, WarnsWhereTheCandidatesFallShort) {
  const CommandResult result =
      wobble("--modes auto --threshold 0.99 --candidates 2");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.errors,
              HasSubstr("link 'beam579': automatic modes: 2 candidates reach"));
  EXPECT_EQ(wobble("--modes 4 --threshold 0.99").status, 2);
  EXPECT_EQ(wobble("--modes some").status, 2);
}

// A uniform velocity is rigid motion, which no mode can have.
TEST_F(Wobble, SaysHowMuchOfAnInitialVelocityIsRigid) {
  std::string ones;
  for (int dof = 0; dof < 3 * kNodes; ++dof) ones += "1\n";
  place_.write("v.txt", ones);
  const CommandResult result = wobble("--initial-velocity v.txt");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("link 'beam579': 100 % of the initial "
                                       "velocity (in the norm of mass) is "
                                       "rigid motion"));
  const CommandResult refused = wobble("--initial-displacement force.txt");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("force.txt: 1738 rows; expected 1737"));
}

TEST_F(Wobble, RefusesAForceFileForAnotherMesh) {
  place_.write("force.txt", force_rows(kNodes + 1));
  const CommandResult result = wobble("");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("1740 rows of forces; expected 1737"));
}

TEST_F(Wobble, RefusesASolverThatDoesNotFitTheSupport) {
  EXPECT_EQ(wobble("--solver PureMA").status, 2);
  EXPECT_EQ(wobble("--solver CoupledRB --clamp root").status, 2);
  EXPECT_THAT(wobble("--solver Fast").errors, HasSubstr("PureMA"));
}

}  // namespace
}  // namespace limber::test::wobble_test
