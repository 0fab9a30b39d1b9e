// SPDX-License-Identifier: BSD-3-Clause
// What limber view --play refuses before it writes a page; tests/playground/
// looks at pages.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::play_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kRefused = 2;

class Play : public ::testing::Test {
 protected:
  Play() {
    place_.write("beam.urdf",
                 "<robot name='b'><link name='beam'/><flexible link='beam'>"
                 "<mesh file='" LIMBER_SOURCE_DIR
                 "/meshes/beam579.msh'/><material youngs_modulus='200e9' "
                 "poisson_ratio='0' density='8000'/><basis eigenmodes='6'/>"
                 "</flexible></robot>");
    write_scene("");
  }

  void write_scene(const std::string& more) const {
    place_.write("beam.toml",
                 "robot = 'beam.urdf'\n"
                 "[time]\nduration = 0.004\nstep = 0.001\n" +
                     more);
  }

  void expect_refused(const std::string& arguments,
                      const ::testing::Matcher<std::string>& why) const {
    const CommandResult result = place_.limber("view " + arguments);
    EXPECT_EQ(result.status, kRefused) << result.errors;
    EXPECT_THAT(result.errors, why);
    EXPECT_FALSE(std::filesystem::exists(place_.folder() / "beam.html"));
  }

  Workspace place_;
};

TEST_F(Play, NeedsAScenarioInPlaceOfResults) {
  expect_refused("", HasSubstr("results, or --play SCENARIO is required"));
  expect_refused("--play beam.toml out", HasSubstr("excludes --play"));
  expect_refused("--play beam.toml --with out", HasSubstr("excludes"));
  expect_refused("out --cache c", HasSubstr("--cache requires --play"));
  expect_refused("--play none.toml", HasSubstr("none.toml"));
  write_scene("[fidelity]\ndefault = 'soft'\n");
  expect_refused("--play beam.toml", HasSubstr("beam.toml:6"));
}

TEST_F(Play, RefusesALevelThatNeedsTheMesh) {
  write_scene("[fidelity]\ndefault = 'full'\n");
  expect_refused("--play beam.toml",
                 AllOf(HasSubstr("link 'beam' has level full"),
                       HasSubstr("choose another level")));
}

TEST_F(Play, RefusesFilesThatThePageWouldLack) {
  place_.write("push.txt", "5 1e6 0 0\n");
  write_scene(
      "[[load]]\nname = 'push'\nlink = 'beam'\nnodal_forces = 'push.txt'\n");
  expect_refused("--play beam.toml", AllOf(HasSubstr("this scene also needs"),
                                           HasSubstr("push.txt")));
}

// A copy of the command has pages beside it, but no module.
TEST_F(Play, NamesTheScriptThatMakesTheModule) {
  const CommandResult result = run_shell(
      place_, "cp '" LIMBER_COMMAND "' own && cp \"$(dirname '" LIMBER_COMMAND
              "')\"/*.html . && rm -f beam.html && "
              "./own view --play beam.toml");
  EXPECT_EQ(result.status, kRefused) << result.errors;
  EXPECT_THAT(result.errors, AllOf(HasSubstr("needs 'playground.js'"),
                                   HasSubstr("scripts/playground makes it")));
  EXPECT_FALSE(std::filesystem::exists(place_.folder() / "beam.html"));
}

// Its results might differ from those of the command that makes the page.
TEST_F(Play, RefusesAModuleOfOtherSources) {
  const CommandResult result = run_shell(
      place_, "cp '" LIMBER_COMMAND "' own && cp \"$(dirname '" LIMBER_COMMAND
              "')\"/*.html . && rm -f beam.html && "
              "echo '// 0123' > playground.js && echo > playground.wasm && "
              "./own view --play beam.toml");
  EXPECT_EQ(result.status, kRefused) << result.errors;
  EXPECT_THAT(result.errors, AllOf(HasSubstr("playground.js' was compiled from "
                                             "other sources"),
                                   HasSubstr("scripts/playground makes it")));
  EXPECT_FALSE(std::filesystem::exists(place_.folder() / "beam.html"));
}

}  // namespace
}  // namespace limber::test::play_test
