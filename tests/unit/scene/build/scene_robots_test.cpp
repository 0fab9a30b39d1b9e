// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scene_robots.hpp"

#include <gmock/gmock.h>

#include "limber/scene/build/scenario_writer.hpp"
#include "limber/scene/robot/joined_robots.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Several robots in one scene, against each of them alone and closed forms.
namespace limber::scene::scene_robots_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::HasSubstr;

const std::string kArm =
    rigid_link("base", 3.0, 1.0) + rigid_link("upper", 1.0, 0.5, "0.5 0 0") +
    "<joint name='j' type='continuous'><parent link='base'/><child "
    "link='upper'/><origin xyz='0.2 0 0' rpy='0.3 0 0'/><axis xyz='0 0 1'/>"
    "</joint>\n<coupler joint='j'><spring stiffness='40'/></coupler>\n"
    "<spring name='s' stiffness='7'><from link='world' point='0 3 0'/><to "
    "link='upper' point='1 0 0'/></spring>\n";

std::string ball() {
  std::string text = rigid_link("body", 2.0, 0.2);
  text.insert(text.find("</link>"),
              "<collision><geometry><sphere radius='0.5'/></geometry>"
              "</collision>");
  return text;
}

class Robots : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& links) const {
    std::ofstream(folder_.path() / (name + ".urdf")) << "<robot name='r'>\n"
                                                     << links << "</robot>\n";
  }

  [[nodiscard]] Scene load(const std::string& scenario) const {
    std::ofstream(folder_.path() / "scenario.toml") << scenario;
    return load_scene(folder_.path() / "scenario.toml");
  }

  [[nodiscard]] BuiltScene build(const std::string& scenario) const {
    return folder_.build(load(scenario));
  }

  [[nodiscard]] std::string error_of(const std::string& scenario) const {
    return input_error([&] { (void)load(scenario); });
  }

  SceneFolder folder_;
};

std::string robot(const std::string& name, const std::string& file,
                  const std::string& more = "") {
  return "[[robot]]\nname = '" + name + "'\nfile = '" + file + ".urdf'\n" +
         more;
}

// Newton's tolerance is one of all bodies together.
const std::string kExact = "newton_tolerance = 1e-13\n";

const std::string kStart =
    "position = [1.0, 2.0, 3.0]\norientation_rpy = [0.1, -0.2, 0.7]\n"
    "velocity = [0.5, -0.3, 0.2]\nangular_velocity = [0.4, 1.0, -0.6]\n";

std::string probes(const std::string& prefix) {
  return "[[probe]]\nname = 'p'\nlink = '" + prefix +
         "upper'\npoint = [1.0, 0.0, 0.0]\nquantity = 'position'\n"
         "[[probe]]\nname = 'w'\nlink = '" +
         prefix +
         "base'\nquantity = 'angular_velocity'\n[[probe]]\nname = 'q'\n"
         "coupler = '" +
         prefix + "j'\nquantity = 'coordinate'\n";
}

// Beside another one, each robot moves as it does alone.
TEST_F(Robots, MoveAsEachOfThemAlone) {
  write("arm", kArm);
  write("ball", ball());
  const std::string time = time_table(0.5, 1e-3) + kExact;
  const auto alone = simulate_probes(
      build("robot = 'arm.urdf'\n" + time + "[initial.base]\n" + kStart +
            "[initial.joints]\nj = { position = 0.4, velocity = 1.5 }\n" +
            probes("")));
  const auto beside = simulate_probes(build(
      time + robot("ball", "ball", "angular_velocity = [0.0, 90.0, 0.0]\n") +
      robot("arm", "arm", kStart) +
      "[initial.joints]\n'arm.j' = { position = 0.4, velocity = 1.5 }\n" +
      probes("arm.")));
  ASSERT_EQ(alone.size(), beside.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_NEAR(alone[i], beside[i], 1e-9);
  }
  EXPECT_GT(std::abs(alone[0] - 1.9), 1e-3);  // it does move
}

// x = x_0 + v t, and a sphere's spin stays.
TEST_F(Robots, FlyFreelyFromTheirStarts) {
  write("ball", ball());
  const auto end = simulate_probes(
      build(time_table(1.0, 1e-2) +
            robot("a", "ball",
                  "position = [1.0, 2.0, 3.0]\nvelocity = [4.0, 5.0, 6.0]\n"
                  "orientation_rpy = [0.0, 0.0, 1.0]\n"
                  "angular_velocity = [1.0, 2.0, 3.0]\n") +
            robot("b", "ball") +
            "[[probe]]\nname = 'x'\nlink = 'a.body'\nquantity = 'position'\n"
            "[[probe]]\nname = 'w'\nlink = 'a.body'\nquantity = "
            "'angular_velocity'\n[[probe]]\nname = 'y'\nlink = 'b.body'\n"));
  const double expected[] = {5, 7, 9, 1, 2, 3, 0, 0, 0};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(end[i], expected[i], 1e-10);
}

// Two equal balls of one file exchange their velocities.
TEST_F(Robots, StrikeEachOther) {
  write("ball", ball());
  const std::string scene =
      time_table(0.2, 1e-4) +
      robot("a", "ball", "velocity = [1.0, 0.0, 0.0]\n") +
      robot("b", "ball", "position = [1.05, 0.0, 0.0]\n") +
      "[[probe]]\nname = 'a'\nlink = 'a.body'\nquantity = 'velocity'\n"
      "[[probe]]\nname = 'b'\nlink = 'b.body'\nquantity = 'velocity'\n"
      "[[contact]]\nfriction = 0.0\nrestitution = 1.0\nbetween = ";
  for (const char* between :
       {"['a.body', 'b.body']", "['a.*', 'b.*']", "['?.body', '*']"}) {
    const auto end = simulate_probes(build(scene + between));
    EXPECT_NEAR(end[0], 0.0, 2e-3);
    EXPECT_NEAR(end[3], 1.0, 2e-3);
  }
}

// What hangs on a link called world is held where the robot's pose says.
TEST_F(Robots, StandWhereTheirPoseSays) {
  write("pendulum",
        kWorld + rigid_link("bob", 1.0, 0.1, "0 0 -1") +
            "<joint name='j' type='continuous'><parent link='world'/><child "
            "link='bob'/><axis xyz='0 1 0'/></joint>\n<spring name='s' "
            "stiffness='3'><from link='world' point='1 0 0'/><to link='bob' "
            "point='0 0 -1'/></spring>\n");
  const auto rest = [](const std::string& prefix) {
    return "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n[[probe]]\nname = "
           "'q'\ncoupler = '" +
           prefix +
           "j'\nquantity = 'coordinate'\n[[probe]]\nname = 'x'\nlink = '" +
           prefix + "bob'\nquantity = 'position'\npoint = [0.0, 0.0, -1.0]\n";
  };
  const std::string time = time_table(0.5, 1e-3) + kExact;
  const auto alone = simulate_probes(
      build("robot = 'pendulum.urdf'\n" + time +
            "[initial.joints]\nj = { position = 0.5 }\n" + rest("")));
  const auto placed = simulate_probes(
      build(time + robot("a", "pendulum") +
            robot("b", "pendulum", "position = [5.0, 6.0, 7.0]\n") +
            "[initial.joints]\n'b.j' = { position = 0.5 }\n" + rest("b.")));
  EXPECT_NEAR(placed[0], alone[0], 1e-10);
  const double shift[] = {5, 6, 7};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(placed[i + 1], alone[i + 1] + shift[i], 1e-9);
  }
}

// Nothing but names differs, so the cache serves both.
TEST_F(Robots, KeepTheInterfacesOfTheirJoints) {
  NamedRobot named;
  named.name = "a";
  named.robot.links.resize(2);
  named.robot.links[0].name = "hub";
  named.robot.links[1].name = "beam";
  named.robot.links[1].flexible.emplace();
  Joint joint;
  joint.name = "root";
  joint.parent = 0;
  joint.child = 1;
  named.robot.joints = {joint};
  const Robot joined = join_robots({named});
  ASSERT_EQ(joined.links.size(), 3U);
  EXPECT_EQ(joined.links[2].name, "a.beam");
  EXPECT_EQ(joined.joints[1].name, "a.root");
  EXPECT_EQ(joined.joints[1].child, 2);
  EXPECT_EQ(joined.links[2].flexible->interface_of_joint.at("a.root"), "root");
}

TEST_F(Robots, AreRefusedIfTheyAreNotClear) {
  write("ball", ball());
  write("held", kWorld);
  const std::string time = time_table(0.5, 1e-3);
  const std::string two = time + robot("a", "ball") + robot("b", "ball");
  const std::pair<std::string, std::string> wrong[] = {
      {time + robot("a", "ball") + robot("a", "ball"), "'a' is given twice"},
      {time + robot("a", "none"), "none.urdf"},
      {time + robot("", "ball"), "'' cannot name a robot"},
      {time + robot("a.b", "ball"), "'a.b' cannot name a robot"},
      {time + robot("a*", "ball"), "'a*' cannot name a robot"},
      {time + robot("a/b", "ball"), "'a/b' cannot name a robot"},
      {time + robot("world", "ball"), "'world' cannot name a robot"},
      {time + "[[robot]]\nname = 'a'\n", "needs 'file'"},
      {time + "[[robot]]\nfile = 'ball.urdf'\n", "needs 'name'"},
      {time + robot("a", "ball", "speed = 3\n"), "unknown key 'speed'"},
      {time, "needs 'robot', the path of a URDF file, [robot]"},
      {"robot = []\n" + time, "robot: is empty; give one at least"},
      {"robot = 'ball.urdf'\n" + time + robot("a", "ball"), "robot"},
      {time + robot("a", "held", "velocity = [1.0, 0.0, 0.0]\n"),
       "[[robot]] 'a' is held by the world; it has no velocity"},
      {two + "[initial.base]\nposition = [1.0, 0.0, 0.0]\n",
       "[initial] base moves the only robot"},
      {two + "[initial.joints]\na = { position = [0, 0, 0, 0, 0, 0] }\n",
       "[initial.joints] 'a' is a robot"},
      {two + "[initial.joints]\na.j = { position = 0.1 }\n",
       "a name with a dot is a key in quotes: \"a.j\""},
      {two + "[fidelity]\nlinks = { a.body = 'rigid' }\n",
       "a name with a dot is a key in quotes: \"a.body\""},
      {two + "[[probe]]\nname = 'p'\nlink = 'body'\n", "did you mean 'a.body'"},
      {two + "[[contact]]\nbetween = ['a.bdy', 'b.*']\n",
       "did you mean 'a.body'"},
      {two + "[[projectile]]\nname = 'a'\nradius = 1.0\nmass = 1.0\nposition = "
             "[9.0, 9.0, 9.0]\n",
       "projectile 'a' has the same name as another link, robot"},
  };
  for (const auto& [text, problem] : wrong) {
    EXPECT_THAT(error_of(text), HasSubstr(problem)) << text;
  }
}

TEST_F(Robots, AreRewrittenWithTheirFiles) {
  write("ball", ball());
  const Scene scene = load(time_table(0.5, 1e-3) + robot("a", "ball", kStart) +
                           robot("b", "ball"));
  const std::filesystem::path moved = folder_.path() / "moved";
  std::filesystem::create_directory(moved);
  std::ofstream(moved / "scenario.toml")
      << rewrite_scenario(scene.scenario.file, {}, moved);
  const Scene again = load_scene(moved / "scenario.toml");
  ASSERT_EQ(again.robot.links.size(), scene.robot.links.size());
  EXPECT_EQ(again.robot.joints[0].X_PJ.p, Vector3(1, 2, 3));
}

TEST_F(Robots, AreReadOnceWithTheSameSettings) {
  write("arm", kArm);
  const auto file = folder_.path() / "scenario.toml";
  std::ofstream(file) << "robot = 'arm.urdf'\n"
                      << time_table(0.5, 1e-3) << probes("");
  const auto end_with = [&](const char* stiffness, KnownRobots* known) {
    const Overrides overrides{
        .settings = {{"robot.spring.s.stiffness", stiffness}}};
    return simulate_probes(folder_.build(load_scene(file, overrides, known)));
  };
  KnownRobots known;
  const auto soft = end_with("7", &known);
  const auto stiff = end_with("8", &known);
  EXPECT_EQ(soft, end_with("7", nullptr));
  EXPECT_EQ(stiff, end_with("8", nullptr));
  EXPECT_NE(soft, stiff);
  write("arm", "");
  EXPECT_EQ(end_with("7", &known), soft);
  EXPECT_EQ(end_with("8", &known), stiff);
  EXPECT_THROW((void)end_with("9", &known), InputError);
}

}  // namespace
}  // namespace limber::scene::scene_robots_test
