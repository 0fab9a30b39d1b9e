// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/recipes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene::recipes_test {
namespace {

using test::TemporaryFile;

/// A flexible link with an interface "tip", whose static-deformation modes
/// cover every load on it.
Robot make_robot(bool automatic) {
  FlexibleLink flexible;
  flexible.mesh.file = "arm.msh";
  flexible.interfaces = {{"tip", flexbody::GroupNodes{"tip"}}};
  if (automatic) flexible.basis.automatic = flexbody::AutomaticModes{};
  Robot robot;
  robot.links = {{"arm", {}, flexible}};
  return robot;
}

Scenario push_tip(dynamics::LoadFrame frame) {
  LoadSpec load;
  load.name = "push";
  load.where.link = "arm";
  load.where.interface = "tip";
  load.force = Vector3(0.0, 2.0, 0.0);
  load.frame = frame;
  Scenario scenario;
  scenario.loads = {load};
  return scenario;
}

TEST(Recipes, LoadsThatAnInterfaceCoversNeedNoPattern) {
  const Scenario scenario = push_tip(dynamics::LoadFrame::world);
  EXPECT_TRUE(
      make_recipe(make_robot(false), 0, scenario).load_patterns.empty());
}

TEST(Recipes, OfAutomaticModesHoldThemAsLoadCasesAlone) {
  const Robot robot = make_robot(true);
  const auto body =
      make_recipe(robot, 0, push_tip(dynamics::LoadFrame::body)).load_patterns;
  ASSERT_EQ(body.size(), 1U);
  EXPECT_EQ(body[0].force, Vector3(0.0, 2.0, 0.0));
  EXPECT_FALSE(body[0].static_mode);
  const auto world =
      make_recipe(robot, 0, push_tip(dynamics::LoadFrame::world)).load_patterns;
  EXPECT_EQ(world.size(), 3U);  // it turns through the body
}

/// A load and a probe on selections of their own.
std::vector<std::string> interfaces_of(
    const flexbody::NodeSelection& loaded,
    const flexbody::NodeSelection& probed,
    flexbody::Weighting probed_weighting = flexbody::Weighting::uniform) {
  Scenario scenario = push_tip(dynamics::LoadFrame::body);
  scenario.loads[0].where = {"arm", "", loaded, {}};
  PointProbeSpec probe;
  probe.where = {"arm", "", probed, {}, probed_weighting};
  scenario.probes = {{"p", probe}};
  std::vector<std::string> names;
  for (const auto& request :
       make_recipe(make_robot(false), 0, scenario).interfaces) {
    names.push_back(request.name);
  }
  return names;
}

TEST(Recipes, ShareAnInterfaceBetweenEqualSelectionsAlone) {
  const Vector3 p(0.1, 0.2, 0.3);
  const Vector3 q = p + Vector3(0, 0, 1e-9);
  const Vector3 z = Vector3::UnitZ();
  const std::vector<flexbody::NodeSelection> selections = {
      flexbody::GroupNodes{"root"},
      flexbody::BoxNodes{p, q},
      flexbody::BoxNodes{p, p},
      flexbody::make_plane(p, z, 0.0),
      flexbody::make_plane(q, z, 0.0),
      flexbody::make_cylinder(p, z, 0.1, 0.0),
      flexbody::make_cylinder(q, z, 0.1, 0.0),
      flexbody::make_cylinder(p, z, 0.1, 0.05)};
  for (std::size_t i = 0; i < selections.size(); ++i) {
    for (std::size_t j = 0; j < selections.size(); ++j) {
      const auto names = interfaces_of(selections[i], selections[j]);
      EXPECT_EQ(names.size(), i == j ? 2U : 3U) << names.back();
      EXPECT_EQ(names[0], "tip");
    }
    EXPECT_EQ(
        interfaces_of(selections[i], selections[i], flexbody::Weighting::equal)
            .size(),
        3U);
  }
  // A group may be called like another selection's name.
  EXPECT_EQ(
      interfaces_of(flexbody::GroupNodes{"tip:equal"},
                    flexbody::GroupNodes{"tip"}, flexbody::Weighting::equal)
          .size(),
      3U);
}

TEST(Recipes, RefuseAnInterfaceNamedLikeAnotherSelection) {
  Robot robot = make_robot(false);
  robot.links[0].flexible->interfaces.push_back(
      {"group:root", flexbody::GroupNodes{"tip"}});
  Scenario scenario = push_tip(dynamics::LoadFrame::body);
  scenario.loads[0].where = {"arm", "", flexbody::GroupNodes{"root"}, {}};
  EXPECT_THAT(test::input_error([&] { (void)make_recipe(robot, 0, scenario); }),
              ::testing::HasSubstr("interface 'group:root' has the same name "
                                   "as another selection, the group 'root'"));
}

// Every end of a coupler bends the link there, a point of a tendon too.
TEST(Recipes, HoldInterfacesOfAllCouplersWithTheirStaticModes) {
  Robot robot = make_robot(false);
  const auto end = [](const flexbody::NodeSelection& nodes) {
    return ConnectorEnd{{"arm", "", nodes, {}}, Matrix3::Identity()};
  };
  const ConnectorEnd world{{"world", "", {}, {}}, Matrix3::Identity()};
  Loop loop;
  loop.from = end(flexbody::GroupNodes{"root"});
  loop.to = world;
  robot.loops = {loop};
  Latch latch;
  latch.from = world;
  latch.to = ConnectorEnd{{"arm", "tip", {}, {}}, Matrix3::Identity()};
  robot.latches = {latch};
  Tendon tendon;
  tendon.via = {world, end(flexbody::TaggedNode{7})};
  robot.tendons = {tendon};
  const auto interfaces = make_recipe(robot, 0, {}).interfaces;
  ASSERT_EQ(interfaces.size(), 3U);
  EXPECT_EQ(interfaces[0].name, "tip");  // the link's own
  EXPECT_EQ(interfaces[1].name, "group:root");
  EXPECT_EQ(interfaces[2].name, "node:7");
  for (const auto& interface : interfaces) {
    EXPECT_TRUE(interface.static_modes);
  }
}

TEST(Recipes, HoldNodalForcesAsLoadCasesAndForStaticModes) {
  const TemporaryFile file("forces.txt", "0 0.5\n1 2\n3 4\n5 6\n");
  Scenario scenario;
  LoadSpec load;
  load.where.link = "arm";
  load.nodal_forces = file.path();
  scenario.loads = {load};
  for (const bool automatic : {false, true}) {
    Robot robot = make_robot(automatic);
    const auto recipe = make_recipe(robot, 0, scenario);
    ASSERT_EQ(recipe.nodal_forces.size(), 1U);
    EXPECT_EQ(recipe.nodal_forces[0].times, (std::vector<double>{0.0, 0.5}));
    EXPECT_EQ(recipe.nodal_forces[0].forces.col(1), Vector3(2.0, 4.0, 6.0));
    EXPECT_EQ(recipe.rows, flexbody::parse_rows({"all"}));
    robot.links[0].flexible->basis.load_modes = false;
    EXPECT_EQ(make_recipe(robot, 0, scenario).nodal_forces.size(),
              automatic ? 1U : 0U);
  }
}

TEST(Recipes, KeepTheSurfacesThatContactsNeed) {
  Robot robot = make_robot(false);
  EXPECT_TRUE(make_recipe(robot, 0, {}).contact_groups.empty());
  robot.links[0].flexible->contact_groups = {"tip", "pad"};
  EXPECT_THAT(make_recipe(robot, 0, {}).contact_groups,
              ::testing::ElementsAre("tip", "pad"));
}

}  // namespace
}  // namespace limber::scene::recipes_test
