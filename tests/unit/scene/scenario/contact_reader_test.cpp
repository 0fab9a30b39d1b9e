// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/contact_reader.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::contact_reader_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::AllOf;
using ::testing::HasSubstr;

Scenario read(const std::string& text) {
  const TemporaryFile file(
      "scenario.toml",
      "robot = \"r.urdf\"\n[time]\nduration = 1.0\nstep = 0.1\n" + text);
  return read_scenario(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

const std::string kBall =
    "[[projectile]]\nname='ball'\nradius=0.5\nposition=[1,2,3]\n";

TEST(ContactReader, ReadsAProjectile) {
  const Scenario scenario =
      read(kBall +
           "mass=2\nvelocity=[4,5,6]\nangular_velocity=[7,8,9]\n"
           "orientation_rpy=[0.1,0,0]\n"
           "youngs_modulus=2e11\npoisson_ratio=0.3\n");
  const ProjectileSpec& ball = scenario.projectiles.at(0);
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(ball.radius, 0.5);
  EXPECT_EQ(ball.mass, 2.0);
  EXPECT_EQ(ball.start.position, Vector3(1, 2, 3));
  EXPECT_EQ(ball.start.orientation_rpy, Vector3(0.1, 0, 0));
  EXPECT_EQ(ball.start.velocity, Vector3(4, 5, 6));
  EXPECT_EQ(ball.start.angular_velocity, Vector3(7, 8, 9));
  EXPECT_EQ(ball.material->youngs_modulus, 2e11);
  EXPECT_EQ(ball.material->poisson_ratio, 0.3);
  EXPECT_FALSE(read(kBall + "mass=2\n").projectiles.at(0).material);
}

TEST(ContactReader, MassOfAProjectileIsDensityTimesVolume) {
  const Scenario scenario = read(kBall + "density=7800\n");
  EXPECT_NEAR(scenario.projectiles.at(0).mass, 7800.0 * std::numbers::pi / 6.0,
              1e-9);
}

TEST(ContactReader, TellsEveryProblemOfAProjectile) {
  EXPECT_THAT(error_of(kBall), HasSubstr("one of 'mass' [kg] and 'density'"));
  EXPECT_THAT(error_of(kBall + "mass=1\ndensity=2\n"),
              HasSubstr("one of 'mass' [kg] and 'density'"));
  EXPECT_THAT(error_of(kBall + "mass=1\nyoungs_modulus=1e9\n"),
              HasSubstr("needs both 'youngs_modulus' and 'poisson_ratio'"));
  EXPECT_THAT(error_of(kBall + "mass=1\n" + kBall + "mass=1\n"),
              HasSubstr("[projectile 2] 'ball' is given twice"));
  const std::string text = error_of(
      "[[projectile]]\nname='b'\nradius=-1\nmass=0\nyoungs_modulus=-1\n"
      "poisson_ratio=0.6\ncolour='red'\n");
  for (const char* part :
       {"projectile 1.radius: is -1", "projectile 1.mass: is 0",
        "needs 'position'", "projectile 1.youngs_modulus: is -1",
        "projectile 1.poisson_ratio: is 0.6", "unknown key 'colour'"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

std::string obstacle(const std::string& more) {
  return "[[obstacle]]\nname='o'\nposition=[1,2,3]\n" + more;
}

template <typename Shape>
Shape read_shape(const std::string& more) {
  return std::get<Shape>(read(obstacle(more)).obstacles.at(0).geometry);
}

TEST(ContactReader, ReadsObstacles) {
  EXPECT_EQ(read_shape<BoxGeometry>("shape='box'\nsize=[4,5,6]\n").size,
            Vector3(4, 5, 6));
  EXPECT_EQ(
      read_shape<EllipsoidGeometry>("shape='ellipsoid'\nradii=[4,5,6]\n").radii,
      Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(
      read_shape<ConeGeometry>("shape='cone'\nradius=4\nlength=5\n").length,
      5.0);
  EXPECT_EQ(read_shape<SphereGeometry>("shape='sphere'\nradius=4\n").radius,
            4.0);
  const auto cylinder =
      read_shape<CylinderGeometry>("shape='cylinder'\nradius=4\nlength=5\n");
  EXPECT_EQ(cylinder.radius, 4.0);
  EXPECT_EQ(cylinder.length, 5.0);
  const auto capsule =
      read_shape<CapsuleGeometry>("shape='capsule'\nradius=4\nlength=5\n");
  EXPECT_EQ(capsule.radius, 4.0);
  EXPECT_EQ(capsule.length, 5.0);
  const Scenario turned =
      read(obstacle("shape='box'\nsize=[4,5,6]\norientation_rpy=[1,2,3]\n"
                    "youngs_modulus=1e9\npoisson_ratio=0.5\n"));
  EXPECT_EQ(turned.obstacles[0].X_WS.R, rotation_rpy(Vector3(1, 2, 3)));
  EXPECT_EQ(turned.obstacles[0].X_WS.p, Vector3(1, 2, 3));
  EXPECT_EQ(turned.obstacles[0].material->poisson_ratio, 0.5);
}

// The half space is z <= 0 of the shape's frame.
TEST(ContactReader, PutsTheNormalOfAPlaneAlongZ) {
  for (const char* normal : {"[0,0,2]", "[0,0,-1]", "[3,0,4]"}) {
    const Scenario scenario =
        read(obstacle(std::string("shape='plane'\nnormal=") + normal + "\n"));
    const Pose& X_WS = scenario.obstacles.at(0).X_WS;
    const Vector3 expected = normal[1] == '3'   ? Vector3(0.6, 0, 0.8)
                             : normal[5] == '-' ? Vector3(0, 0, -1)
                                                : Vector3(0, 0, 1);
    EXPECT_LT((X_WS.R.col(2) - expected).norm(), 1e-14) << normal;
    EXPECT_LT((X_WS.R.transpose() * X_WS.R - Matrix3::Identity()).norm(),
              1e-14);
    EXPECT_EQ(X_WS.p, Vector3(1, 2, 3));
  }
}

TEST(ContactReader, TellsEveryProblemOfAnObstacle) {
  EXPECT_THAT(error_of(obstacle("")), HasSubstr("needs 'shape', 'plane'"));
  EXPECT_THAT(error_of(obstacle("shape='boxx'\nsize=[1,1,1]\n")),
              HasSubstr("did you mean 'box'"));
  EXPECT_THAT(error_of(obstacle("shape='plane'\n")),
              HasSubstr("needs 'normal'"));
  EXPECT_THAT(error_of(obstacle("shape='plane'\nnormal=[0,0,0]\n")),
              HasSubstr("normal: is zero"));
  EXPECT_THAT(error_of(obstacle("shape='box'\n")), HasSubstr("needs 'size'"));
  EXPECT_THAT(error_of(obstacle("shape='ellipsoid'\n")),
              HasSubstr("needs 'radii'"));
  EXPECT_THAT(error_of(obstacle("shape='ellipsoid'\nradii=[1,2,0]\n")),
              HasSubstr("expected three numbers > 0"));
  EXPECT_THAT(error_of(obstacle("shape='cone'\nradius=1\n")),
              HasSubstr("length"));
  EXPECT_THAT(error_of(obstacle("shape='sphere'\nradius=1\nradii=[1,1,1]\n")),
              HasSubstr("does not apply to a sphere"));
  EXPECT_THAT(error_of(obstacle("shape='box'\nsize=[1,0,1]\n")),
              HasSubstr("size: expected three numbers > 0"));
  EXPECT_THAT(error_of(obstacle("shape='cylinder'\n")),
              AllOf(HasSubstr("needs 'radius'"), HasSubstr("needs 'length'")));
  EXPECT_THAT(
      error_of(obstacle("shape='plane'\nnormal=[0,0,1]\norientation_rpy="
                        "[0,0,1]\n")),
      HasSubstr("orientation_rpy: does not apply to a plane; leave it out"));
  EXPECT_THAT(error_of(obstacle("shape='sphere'\nradius=1\nsize=[1,1,1]\n")),
              HasSubstr("size: does not apply to a sphere"));
  EXPECT_THAT(error_of("[[obstacle]]\nname='o'\nshape='sphere'\nradius=1\n"),
              HasSubstr("needs 'position'"));
}

TEST(ContactReader, ReadsAContact) {
  const Scenario scenario = read(
      "[[contact]]\nbetween=['a','b*']\nfriction=0.3\n"
      "static_friction=0.4\nstribeck_speed=0.02\nrestitution=0.5\n"
      "radius=0.01\nstiffness=1e9\n"
      "[[contact]]\nbetween=['c','d']\nfriction=0.0\ndamping=0.7\n");
  const ContactSpec& contact = scenario.contacts.at(0);
  EXPECT_EQ(contact.between[0], "a");
  EXPECT_EQ(contact.between[1], "b*");
  EXPECT_EQ(contact.options.friction, 0.3);
  EXPECT_EQ(contact.options.static_friction, 0.4);
  EXPECT_EQ(contact.options.stribeck_speed, 0.02);
  EXPECT_EQ(contact.options.restitution, 0.5);
  EXPECT_EQ(contact.options.radius, 0.01);
  EXPECT_EQ(contact.options.stiffness, 1e9);
  EXPECT_FALSE(contact.options.damping);
  EXPECT_EQ(scenario.contacts.at(1).options.damping, 0.7);
  EXPECT_TRUE(scenario.warnings.empty());
}

TEST(ContactReader, TakesFromTheDefaultWhatAContactLeavesOut) {
  const Scenario scenario = read(
      "[contact_default]\nfriction=0.3\nrestitution=0.5\nstiffness=1e9\n"
      "[[contact]]\nbetween=['a','b']\n"
      "[[contact]]\nbetween=['a','c']\nfriction=0.1\ndamping=0.7\n");
  const ContactOptions& first = scenario.contacts.at(0).options;
  EXPECT_EQ(first.friction, 0.3);
  EXPECT_EQ(first.restitution, 0.5);
  EXPECT_EQ(first.stiffness, 1e9);
  const ContactOptions& second = scenario.contacts.at(1).options;
  EXPECT_EQ(second.friction, 0.1);
  EXPECT_EQ(second.damping, 0.7);
  EXPECT_FALSE(second.restitution);  // the damping is in its place
  EXPECT_TRUE(scenario.warnings.empty());
}

TEST(ContactReader, TellsWhichValuesItTakesForGranted) {
  const Scenario scenario = read(
      "[[contact]]\nbetween=['a','b']\n"
      "[[contact]]\nbetween=['a','c']\nfriction=0.1\n");
  ASSERT_EQ(scenario.warnings.size(), 2U);
  EXPECT_THAT(scenario.warnings[0],
              HasSubstr("no 'friction' is given for [[contact]] 1: it slides "
                        "without friction (0)"));
  EXPECT_THAT(scenario.warnings[1],
              HasSubstr("no 'restitution' is given for [[contact]] 1, 2: it "
                        "loses no energy (1)"));
}

TEST(ContactReader, TellsWhichRestitutionsActAsTheLeast) {
  const Scenario scenario = read(
      "[contact_default]\nfriction=0.3\n"
      "[[contact]]\nbetween=['a','b']\nrestitution=0\n"
      "[[contact]]\nbetween=['a','c']\nrestitution=0.05\n"
      "[[contact]]\nbetween=['a','d']\nrestitution=0.049\n"
      "[[contact]]\nbetween=['a','e']\ndamping=0.1\n");
  ASSERT_EQ(scenario.warnings.size(), 1U);
  EXPECT_THAT(
      scenario.warnings[0],
      HasSubstr("'restitution' of [[contact]] 1, 3 is below 0.05 and acts as "
                "that value: the bodies separate with 0.25 % of their energy"));
}

TEST(ContactReader, TellsEveryProblemOfAContact) {
  const std::string text = error_of(
      "[contact_default]\nbetween=['a','b']\n"
      "[[contact]]\nbetween=['a','b']\nfriction=-0.1\nrestitution=1.1\n"
      "radius=0\nstiffness=-1\nstribeck_speed=0\n"
      "[[contact]]\nbetween=['a','b']\ndamping=-1\nfrition=0.2\n"
      "[[contact]]\nbetween=['a']\n"
      "[[contact]]\nbetween='a'\n"
      "[[contact]]\nbetween=['a',1]\n"
      "[[contact]]\nfriction=0.1\n"
      "[[contact]]\nbetween=['a','b']\nrestitution=0.5\ndamping=1\n"
      "[[contact]]\nbetween=['a','b']\nfriction=0.5\nstatic_friction=0.4\n");
  for (const char* part :
       {"[contact_default] unknown key 'between'",
        "contact 1.friction: is -0.1", "contact 1.restitution: is 1.1",
        "contact 1.radius: is 0", "contact 1.stiffness: is -1",
        "contact 1.stribeck_speed: is 0", "contact 2.damping: is -1",
        "[contact 2] unknown key 'frition'; did you mean 'friction'",
        "[contact 3] needs 'between', the names of two bodies",
        "contact 4.between: expected an array of names, got string",
        "contact 5.between: expected names, got integer",
        "[contact 6] needs 'between'",
        "[contact 7] has both 'restitution' and 'damping'; keep one",
        "[contact 8] static_friction is 0.4, less than friction, 0.5"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(error_of("[contact]\nbetween=['a','b']\n"),
              HasSubstr("expected [[contact]] tables, got table"));
}

}  // namespace
}  // namespace limber::scene::contact_reader_test
