// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/touching_pairs.hpp"

#include <gmock/gmock.h>

#include "limber/scene/contacts/projectiles.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::touching_pairs_test {
namespace {

using test::input_error;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Link make_sphere(const std::string& name) {
  Link link;
  link.name = name;
  link.collisions.resize(1);
  link.collisions[0].geometry = SphereGeometry{1.0};
  return link;
}

Joint make_joint(int parent, int child,
                 joints::JointKind kind = joints::JointKind::revolute) {
  Joint joint;
  joint.parent = parent;
  joint.child = child;
  joint.kind = kind;
  return joint;
}

/// palm - finger_1 - tip_1 and palm - finger_2 on hinges, a target beside them
/// on a floating joint.
Robot make_hand() {
  Robot robot;
  robot.links = {make_sphere("palm"), make_sphere("finger_1"),
                 make_sphere("tip_1"), make_sphere("finger_2"),
                 make_sphere("target")};
  robot.joints = {make_joint(0, 1), make_joint(1, 2), make_joint(0, 3),
                  make_joint(0, 4, joints::JointKind::floating)};
  return robot;
}

Scenario touch(const std::vector<std::array<std::string, 2>>& between,
               const std::vector<std::string>& obstacles = {}) {
  Scenario scenario;
  for (const auto& names : between) scenario.contacts.push_back({names, {}});
  for (const std::string& name : obstacles) {
    ObstacleSpec& obstacle = scenario.obstacles.emplace_back();
    obstacle.name = name;
    obstacle.geometry = PlaneGeometry{};
  }
  return scenario;
}

/// "CONTACT:A/B", counted from 1.
std::vector<std::string> list(const Scenario& scenario, const Robot& robot) {
  std::vector<std::string> texts;
  for (const TouchingPair& pair : find_touching_pairs(scenario, robot).pairs) {
    texts.push_back(std::to_string(pair.contact + 1) + ":" +
                    name_of(pair.A, robot, scenario) + "/" +
                    name_of(pair.B, robot, scenario));
  }
  return texts;
}

std::string error_of(const Scenario& scenario, const Robot& robot) {
  return input_error([&] { (void)find_touching_pairs(scenario, robot); });
}

TEST(TouchingPairs, ExpandsPatternsToEachPairOnce) {
  const Scenario scenario = touch({{"finger_*", "target"}});
  EXPECT_THAT(list(scenario, make_hand()),
              ElementsAre("1:finger_1/target", "1:finger_2/target"));
}

// palm-finger_1, palm-finger_2 and finger_1-tip_1 are hinged; the target
// floats.
TEST(TouchingPairs, PatternsLeaveOutLinksThatAJointConnects) {
  EXPECT_THAT(
      list(touch({{"*", "*"}}), make_hand()),
      ElementsAre("1:palm/tip_1", "1:palm/target", "1:finger_1/finger_2",
                  "1:finger_1/target", "1:tip_1/finger_2", "1:tip_1/target",
                  "1:finger_2/target"));
  EXPECT_THAT(list(touch({{"palm", "finger_1"}}), make_hand()),
              ElementsAre("1:palm/finger_1"));
  EXPECT_THAT(error_of(touch({{"pal*", "finger_1"}}), make_hand()),
              HasSubstr("leaves no pair of bodies that can be in contact"));
}

TEST(TouchingPairs, PatternsLeaveOutLinksThatALoopConnects) {
  Robot robot = make_hand();
  Loop loop;
  loop.from.where.link = "tip_1";
  loop.to.where.link = "finger_2";
  robot.loops = {loop};
  EXPECT_THAT(error_of(touch({{"tip_*", "finger_2"}}), robot),
              HasSubstr("leaves no pair"));
}

TEST(TouchingPairs, NamesOfBothBodiesDecideOverPatternsAndThenTheFirst) {
  EXPECT_THAT(list(touch({{"finger_*", "target"},
                          {"*", "target"},
                          {"target", "finger_2"}}),
                   make_hand()),
              ElementsAre("1:finger_1/target", "2:palm/target",
                          "2:tip_1/target", "3:target/finger_2"));
}

TEST(TouchingPairs, TellsOfContactsWithoutAPairOfTheirOwn) {
  const TouchingPairs found = find_touching_pairs(
      touch({{"*", "target"}, {"finger_?", "target"}}), make_hand());
  EXPECT_THAT(found.idle, ElementsAre(1U));
}

TEST(TouchingPairs, ObstaclesTouchLinksButNotEachOther) {
  EXPECT_THAT(list(touch({{"*", "*"}}, {"floor", "wall"}),
                   [] {
                     Robot robot;
                     robot.links = {make_sphere("ball")};
                     return robot;
                   }()),
              ElementsAre("1:ball/floor", "1:ball/wall"));
  EXPECT_THAT(
      error_of(touch({{"floor", "wall"}}, {"floor", "wall"}), make_hand()),
      HasSubstr("both are fixed in the world"));
}

TEST(TouchingPairs, FindsProjectilesByName) {
  Scenario scenario = touch({{"ball", "*"}}, {"floor"});
  ProjectileSpec ball;
  ball.name = "ball";
  ball.radius = 0.1;
  scenario.projectiles = {ball};
  Robot robot = make_hand();
  add_projectiles(scenario, robot);
  EXPECT_THAT(list(scenario, robot),
              ElementsAre("1:ball/palm", "1:ball/finger_1", "1:ball/tip_1",
                          "1:ball/finger_2", "1:ball/target", "1:ball/floor"));
}

TEST(TouchingPairs, LinksOfOneRigidBodyNeverMeet) {
  Robot robot = make_hand();
  robot.joints[1].kind = joints::JointKind::fixed;  // finger_1 - tip_1
  robot.joints[0].kind = joints::JointKind::fixed;  // palm - finger_1
  EXPECT_THAT(error_of(touch({{"palm", "tip_1"}}), robot),
              HasSubstr("fixed joints make them one rigid body"));
  EXPECT_THAT(list(touch({{"*", "tip_1"}}), robot),
              ElementsAre("1:finger_2/tip_1", "1:target/tip_1"));
  robot.links[0].name = "world";
  EXPECT_THAT(error_of(touch({{"tip_1", "floor"}}, {"floor"}), robot),
              HasSubstr("both are fixed in the world"));
}

TEST(TouchingPairs, PatternsPassOverLinksWithoutShapesThatNamesRefuse) {
  Robot robot = make_hand();
  robot.links[1].collisions.clear();
  EXPECT_THAT(list(touch({{"finger_*", "target"}}), robot),
              ElementsAre("1:finger_2/target"));
  EXPECT_THAT(
      error_of(touch({{"finger_1", "target"}}), robot),
      HasSubstr("[[contact]] 1 between 'finger_1' and 'target': link "
                "'finger_1' has no contact shape; give it a <collision>"));
  robot.links[3].collisions.clear();
  EXPECT_THAT(error_of(touch({{"finger_*", "target"}}), robot),
              HasSubstr("no link that 'finger_*' matches has a <collision>"));
}

TEST(TouchingPairs, FlexibleLinksTouchWithTheirOwnMesh) {
  Robot robot = make_hand();
  robot.links[1].collisions.resize(1);
  robot.links[1].collisions[0].geometry = OtherGeometry{"mesh"};
  robot.links[1].flexible = FlexibleLink{};
  EXPECT_THAT(list(touch({{"finger_1", "target"}}), robot),
              ElementsAre("1:finger_1/target"));
}

TEST(TouchingPairs, RefusesShapesThatItDoesNotKnowOfLinksThatContactsAskFor) {
  Robot robot = make_hand();
  robot.links[1].collisions.emplace_back().geometry = OtherGeometry{"torus"};
  EXPECT_THAT(list(touch({{"finger_2", "target"}}), robot),
              ElementsAre("1:finger_2/target"));
  for (const char* name : {"finger_1", "finger_*"}) {
    EXPECT_THAT(
        error_of(touch({{name, "target"}}), robot),
        HasSubstr(
            "link 'finger_1' has a <torus> in its <collision>, which contacts "
            "do not support; use <sphere>, <box>, <cylinder>, <capsule>, "
            "<cone>, <ellipsoid> or <mesh>, or make the link flexible"));
  }
}

TEST(TouchingPairs, TellsEveryProblem) {
  const std::string text = error_of(touch({{"finger_1", "targt"},
                                           {"thumb*", "target"},
                                           {"target", "target"},
                                           {"target", "finger_1"},
                                           {"finger_1", "target"}}),
                                    make_hand());
  EXPECT_THAT(text, HasSubstr("[[contact]] 1 between 'finger_1' and 'targt': "
                              "unknown body 'targt'; did you mean 'target'"));
  EXPECT_THAT(text,
              HasSubstr("'thumb*' matches no link, projectile or obstacle"));
  EXPECT_THAT(text, HasSubstr("[[contact]] 3 between 'target' and 'target': "
                              "names one body twice"));
  EXPECT_THAT(text, HasSubstr("[[contact]] 5 between 'finger_1' and 'target': "
                              "[[contact]] 4 names the same; keep one"));
}

TEST(TouchingPairs, RefusesMorePairsThanAnyoneMeans) {
  Robot robot;
  for (int i = 0; i < 500; ++i) {
    robot.links.push_back(make_sphere("a" + std::to_string(i)));
  }
  EXPECT_THAT(error_of(touch({{"*", "*"}}), robot),
              HasSubstr("matches 124750 pairs of bodies; at most 100000"));
}

}  // namespace
}  // namespace limber::scene::touching_pairs_test
