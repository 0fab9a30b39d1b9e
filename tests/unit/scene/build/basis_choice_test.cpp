// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/basis_choice.hpp"

#include <gmock/gmock.h>

#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scene.hpp"
#include "places.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::basis_choice_test {
namespace {

using flexbody::BasisOptions;
using test::input_error;
using test::TemporaryFile;
using ::testing::HasSubstr;

/// Its <basis> has six eigenmodes and every static-deformation mode.
const std::string kArm = "robot = '" LIMBER_SOURCE_DIR
                         "/models/capture_arm.urdf'\n"
                         "[time]\nduration = 1.0\nstep = 0.1\n";

Scene load(const std::string& text, const Overrides& overrides = {}) {
  const TemporaryFile file("basis.toml", kArm + text);
  return load_scene(file.path(), overrides);
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)load(text); });
}

const BasisOptions& basis_of(const Scene& scene, const std::string& link) {
  const auto index = static_cast<std::size_t>(find_link(scene.robot, link));
  return scene.robot.links[index].flexible->basis;
}

TEST(BasisChoice, OfAScenarioTakesThePlaceOfTheRobotsKeyByKey) {
  const Scene scene = load(
      "[basis]\nstatic_deformation = { loads = false, terms = 3 }\n"
      "[basis.links.upper_1]\neigenmodes = 3\n");
  EXPECT_EQ(basis_of(scene, "upper_1").eigenmodes, 3);
  EXPECT_TRUE(basis_of(scene, "upper_1").interface_modes);
  EXPECT_FALSE(basis_of(scene, "upper_1").load_modes);
  EXPECT_EQ(basis_of(scene, "upper_1").terms, 3);
  EXPECT_EQ(basis_of(scene, "upper_2").eigenmodes, 6);
  EXPECT_FALSE(basis_of(scene, "upper_2").load_modes);
}

TEST(BasisChoice, OfALinkGoesBeforeThatOfAllLinks) {
  const Scene scene =
      load("[basis]\neigenmodes = 9\n[basis.links.lower_2]\neigenmodes = 0\n");
  EXPECT_EQ(basis_of(scene, "lower_2").eigenmodes, 0);
  EXPECT_EQ(basis_of(scene, "lower_1").eigenmodes, 9);
}

TEST(BasisChoice, OfTheCallerGoesBeforeTheFiles) {
  Overrides overrides;
  overrides.basis.eigenmodes = 4;
  const Scene scene = load(
      "[basis.links.lower_2]\neigenmodes = 20\n"
      "static_deformation = { interfaces = false }\n",
      overrides);
  EXPECT_EQ(basis_of(scene, "lower_2").eigenmodes, 4);
  EXPECT_FALSE(basis_of(scene, "lower_2").interface_modes);
  EXPECT_EQ(basis_of(scene, "upper_3").eigenmodes, 4);
}

TEST(BasisChoice, OfANumberOfModesEndsTheirAutomaticChoice) {
  Robot robot;
  FlexibleLink flexible;
  flexible.mesh.file = "arm.msh";
  flexible.basis.automatic = flexbody::AutomaticModes{};
  robot.links = {{"arm", {}, flexible}};
  BasisChoice choice;
  choice.loads = false;
  choose_bases({}, choice, robot);
  EXPECT_TRUE(robot.links[0].flexible->basis.automatic);
  choice.eigenmodes = 5;
  choose_bases({}, choice, robot);
  EXPECT_FALSE(robot.links[0].flexible->basis.automatic);
}

TEST(BasisChoice, IsRefusedForASavedBody) {
  Robot robot;
  FlexibleLink flexible;
  flexible.reduced_file = "arm.h5";
  robot.links = {{"arm", {}, flexible}};
  choose_bases({}, {}, robot);  // nothing is requested
  BasisChoice choice;
  choice.eigenmodes = 5;
  EXPECT_THAT(input_error([&] { choose_bases({}, choice, robot); }),
              HasSubstr("link 'arm' comes from the saved body 'arm.h5'"));
}

TEST(BasisChoice, NamesWhatIsWrong) {
  EXPECT_THAT(error_of("[basis.links.uper_1]\neigenmodes = 3\n"),
              HasSubstr("did you mean 'upper_1'"));
  EXPECT_THAT(error_of("[basis.links.base]\neigenmodes = 3\n"),
              HasSubstr("unknown flexible link 'base'"));
  EXPECT_THAT(error_of("[basis]\neigenmodes = -1\n"),
              HasSubstr("basis.eigenmodes: is -1; expected a whole number"));
  EXPECT_THAT(error_of("[basis]\neigenmodes = 2.5\n"),
              HasSubstr("expected a whole number"));
  EXPECT_THAT(error_of("[basis]\nstatic_deformation = true\n"),
              HasSubstr("expected a table"));
  EXPECT_THAT(error_of("[basis]\nstatic_deformation = { load = true }\n"),
              HasSubstr("did you mean 'loads'"));
}

TEST(Overrides, OfTheStepLeaveTheOutputsAsTheyAre) {
  Overrides overrides;
  overrides.step = 0.05;
  const Scene scene = load("", overrides);
  EXPECT_EQ(scene.scenario.settings.step, 0.05);
  EXPECT_EQ(scene.scenario.settings.output_times.size(), 11U);
}

TEST(Overrides, OfRowsReachEveryFlexibleLink) {
  Overrides overrides;
  overrides.rows = flexbody::KeptRows{flexbody::KeptRows::Extent::all, {}};
  int count = 0;
  for (const Link& link : load("", overrides).robot.links) {
    if (!link.flexible) continue;
    EXPECT_EQ(link.flexible->rows, *overrides.rows);
    ++count;
  }
  EXPECT_EQ(count, 6);
}

}  // namespace
}  // namespace limber::scene::basis_choice_test
