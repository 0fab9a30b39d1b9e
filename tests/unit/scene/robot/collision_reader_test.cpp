// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/collision_reader.hpp"

#include <gmock/gmock.h>

#include "limber/common/roll_pitch_yaw.hpp"
#include "unit/scene/robot/robot_text.hpp"

namespace limber::scene::collision_reader_test {
namespace {

using test::error_of;
using test::read;
using ::testing::HasSubstr;

std::string link(const std::string& content) {
  return "<link name='a'>" + content + "</link>";
}

std::string collision(const std::string& shape) {
  return link("<collision><geometry>" + shape + "</geometry></collision>");
}

template <typename Shape>
Shape read_shape(const std::string& shape) {
  const Robot robot = read(collision(shape));
  EXPECT_TRUE(robot.warnings.empty());
  return std::get<Shape>(robot.links.at(0).collisions.at(0).geometry);
}

TEST(CollisionReader, ReadsShapes) {
  EXPECT_EQ(read_shape<SphereGeometry>("<sphere radius='2'/>").radius, 2.0);
  EXPECT_EQ(read_shape<BoxGeometry>("<box size='1 2 3'/>").size,
            Vector3(1, 2, 3));
  const auto cylinder =
      read_shape<CylinderGeometry>("<cylinder radius='2' length='3'/>");
  EXPECT_EQ(cylinder.radius, 2.0);
  EXPECT_EQ(cylinder.length, 3.0);
  const auto cone = read_shape<ConeGeometry>("<cone radius='2' length='3'/>");
  EXPECT_EQ(cone.radius, 2.0);
  EXPECT_EQ(cone.length, 3.0);
  EXPECT_EQ(read_shape<EllipsoidGeometry>("<ellipsoid radii='1 2 3'/>").radii,
            Vector3(1.0, 2.0, 3.0));
  const auto capsule =
      read_shape<CapsuleGeometry>("<capsule radius='2' length='3'/>");
  EXPECT_EQ(capsule.radius, 2.0);
  EXPECT_EQ(capsule.length, 3.0);
  const auto mesh =
      read_shape<MeshGeometry>("<mesh filename='m.stl' scale='1 -2 3'/>");
  EXPECT_EQ(mesh.file.filename(), "m.stl");
  EXPECT_EQ(mesh.scale, Vector3(1, -2, 3));
  EXPECT_EQ(read_shape<MeshGeometry>("<mesh filename='file:///a/m.stl'/>").file,
            "/a/m.stl");
}

/// Why a shape cannot be used, which one warning tells.
std::string reason_of(const std::string& element) {
  const Robot robot = read(link(element));
  const bool is_visual = robot.links.at(0).collisions.empty();
  const Link& a = robot.links[0];
  const auto& shapes = is_visual ? a.visuals : a.collisions;
  EXPECT_EQ(robot.warnings.size(), 1U) << element;
  const auto& other = std::get<OtherGeometry>(shapes.at(0).geometry);
  EXPECT_THAT(robot.warnings.at(0), HasSubstr(other.reason));
  EXPECT_THAT(other.reason, HasSubstr("robot.urdf:2: <"));
  return other.reason;
}

std::string shape_of(const std::string& tag, const std::string& shape) {
  return "<" + tag + "><geometry>" + shape + "</geometry></" + tag + ">";
}

TEST(CollisionReader, WarnsOfShapesThatARunMayNotNeed) {
  for (const std::string tag : {"collision", "visual"}) {
    const auto why = [&](const std::string& shape) {
      return reason_of(shape_of(tag, shape));
    };
    EXPECT_THAT(why("<mesh filename='package://p/m.stl'/>"),
                HasSubstr("there is no p/m.stl in this file's folder or one "
                          "above it"));
    EXPECT_THAT(why("<mesh filename='http://p/m.stl'/>"),
                HasSubstr("expected a path from this file's folder"));
    for (const char* shape :
         {"<box size='0 0 0'/>", "<box size='1 0 1'/>",
          "<sphere radius='0.0'/>", "<cylinder radius='0' length='1'/>",
          "<capsule radius='1' length='0'/>", "<cone radius='1' length='0'/>",
          "<ellipsoid radii='1 0 1'/>"}) {
      EXPECT_THAT(why(shape), HasSubstr("has a size of 0"));
    }
  }
}

TEST(CollisionReader, TakesNothingInAVisualForAnError) {
  for (const char* shape :
       {"<sphere radius='-1'/>", "<sphere/>", "<box/>", "<cone/>", "<mesh/>",
        "", "<sphere radius='1'/><box size='1 1 1'/>",
        "<mesh filename='m' scale='1 0 1'/>"}) {
    EXPECT_NE(reason_of(shape_of("visual", shape)), "");
  }
  const Robot robot =
      read(link(shape_of("visual", "<capsule radius='1' length='2'/>") +
                "<visual/>" + shape_of("visual", "<box size='0 1 1'/>")));
  ASSERT_EQ(robot.links[0].visuals.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<CapsuleGeometry>(
      robot.links[0].visuals[0].geometry));
  EXPECT_THAT(robot.warnings,
              ::testing::ElementsAre(
                  HasSubstr("2 <visual> left out of pictures: the first is")));
}

TEST(CollisionReader, TakesTheShapeBesideWhatOtherProgramsPutThere) {
  for (const char* geometry : {"<material name='m'/><sphere radius='1'/>",
                               "<sphere radius='1'/><material name='m'/>"}) {
    const Robot robot = read(
        link(shape_of("visual", geometry) + shape_of("collision", geometry)));
    const Link& a = robot.links.at(0);
    EXPECT_TRUE(
        std::holds_alternative<SphereGeometry>(a.visuals.at(0).geometry));
    EXPECT_TRUE(
        std::holds_alternative<SphereGeometry>(a.collisions.at(0).geometry));
  }
}

TEST(CollisionReader, RefusesMeshesThatMakeNoSense) {
  EXPECT_THAT(error_of(collision("<mesh/>")), HasSubstr("needs 'filename'"));
  EXPECT_THAT(error_of(collision("<mesh filename='m' scale='1 0 1'/>")),
              HasSubstr("scale: a factor is 0"));
}

TEST(CollisionReader, ReadsSeveralShapesAndTheirPoses) {
  const Robot robot = read(
      link("<collision name='pad'><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/>"
           "<geometry><sphere radius='1'/></geometry></collision>"
           "<collision><geometry><box size='1 1 1'/></geometry></collision>") +
      "<link name='b'/><joint name='j' type='fixed'><parent link='a'/><child "
      "link='b'/></joint>");
  ASSERT_EQ(robot.links.at(0).collisions.size(), 2U);
  const Pose& X_LS = robot.links[0].collisions[0].X_LS;
  EXPECT_EQ(X_LS.p, Vector3(1, 2, 3));
  EXPECT_EQ(X_LS.R, rotation_rpy(Vector3(0.1, 0.2, 0.3)));
  EXPECT_EQ(robot.links[0].collisions[1].X_LS.p, Vector3::Zero());
  EXPECT_TRUE(robot.links[1].collisions.empty());
}

TEST(CollisionReader, KeepsShapesOfOtherProgramsWithAWarning) {
  const Robot robot = read(collision("<torus radius='1'/>"));
  EXPECT_THAT(robot.warnings.at(0), HasSubstr("'torus' is not read"));
  EXPECT_EQ(
      std::get<OtherGeometry>(robot.links[0].collisions.at(0).geometry).tag,
      "torus");
}

TEST(CollisionReader, TellsOfShapesThatAreNone) {
  EXPECT_THAT(error_of(collision("<sphere radius='-1'/>")),
              HasSubstr("<sphere> radius=\"-1\": expected"));
  EXPECT_THAT(error_of(collision("<sphere/>")), HasSubstr("needs 'radius'"));
  EXPECT_THAT(error_of(collision("<box/>")), HasSubstr("<box> needs 'size'"));
  EXPECT_THAT(error_of(collision("<box size='1 -2 1'/>")),
              HasSubstr("<box> size=\"1 -2 1\""));
  EXPECT_THAT(error_of(collision("<capsule radius='1'/>")),
              HasSubstr("<capsule> needs 'length'"));
  EXPECT_THAT(error_of(collision("<ellipsoid/>")),
              HasSubstr("<ellipsoid> needs 'radii'"));
  EXPECT_THAT(error_of(collision("<spher radius='1'/>")),
              HasSubstr("did you mean 'sphere'"));
  EXPECT_THAT(error_of(collision("<sphere radius='1'/><box size='1 1 1'/>")),
              HasSubstr("several shapes; give each a <collision>"));
  EXPECT_THAT(error_of(collision("")), HasSubstr("needs a <geometry>"));
  EXPECT_THAT(error_of(link("<collision/>")), HasSubstr("needs a <geometry>"));
}

const std::string kFlexible =
    "<flexible link='a'><mesh file='m.msh'/><material youngs_modulus='1e9' "
    "poisson_ratio='0.3' density='1000'/></flexible>";

TEST(CollisionReader, ReadsHowLinksTouch) {
  const Robot rigid = read(link("") +
                           "<contact link='a' youngs_modulus='1e9' "
                           "poisson_ratio='0.3'/>");
  EXPECT_EQ(rigid.links.at(0).contact.material->youngs_modulus, 1e9);
  EXPECT_EQ(rigid.links[0].contact.material->poisson_ratio, 0.3);
  const Robot flexible =
      read("<contact link='a' surface='tip pad'/>" + link("") + kFlexible);
  EXPECT_THAT(find_surfaces(flexible.links.at(0)),
              ::testing::ElementsAre("tip", "pad"));
  EXPECT_THAT(find_surfaces(read(link("") + kFlexible).links.at(0)),
              ::testing::ElementsAre("skin"));
}

TEST(CollisionReader, TellsOfContactsThatDoNotFitTheirLink) {
  const auto with = [](const std::string& contact) {
    return error_of(link("") + "<contact " + contact + "/>");
  };
  EXPECT_THAT(with("link='b'"), HasSubstr("unknown link 'b'"));
  EXPECT_THAT(with(""), HasSubstr("needs 'link'"));
  EXPECT_THAT(with("link='a' youngs_modulus='1'"), HasSubstr("needs both"));
  EXPECT_THAT(with("link='a' youngs_modulus='-1' poisson_ratio='0.3'"),
              HasSubstr("youngs_modulus=\"-1\""));
  EXPECT_THAT(with("link='a' youngs_modulus='1' poisson_ratio='0.6'"),
              HasSubstr("poisson_ratio=\"0.6\""));
  EXPECT_THAT(with("link='a' surface='tip'"),
              HasSubstr("link 'a' is rigid; its shapes are those of its "
                        "<collision>, leave 'surface' out"));
  EXPECT_THAT(with("link='a' surfaces='tip'"),
              HasSubstr("unknown attribute 'surfaces'"));
  EXPECT_THAT(with("link='a'/><contact link='a'"),
              HasSubstr("for link 'a' is given twice"));
  const std::string flexible = link("") + kFlexible;
  EXPECT_THAT(error_of(flexible + "<contact link='a' surface=' '/>"),
              HasSubstr("expected names of groups of faces"));
  EXPECT_THAT(
      error_of(flexible +
               "<contact link='a' youngs_modulus='1' poisson_ratio='0'/>"),
      HasSubstr("its material is that of its <flexible>"));
}

}  // namespace
}  // namespace limber::scene::collision_reader_test
