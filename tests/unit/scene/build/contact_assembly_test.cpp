// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "limber/common/records/manifest.hpp"
#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "support/point_mass_body.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Contacts from their files to the pairs of a system.
namespace limber::scene::contact_assembly_test {
namespace {

using test::input_error;
using test::kWorld;
using test::SceneFolder;
using test::time_table;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kTime = time_table(1.0, 1e-3);
const std::string kOptions = "friction = 0.3\nrestitution = 0.5\n";

std::string projectile(const std::string& name, const std::string& position,
                       const std::string& more = "") {
  return fmt::format(
      "[[projectile]]\nname = '{}'\nradius = 0.1\nmass = 2.0\nposition = "
      "[{}]\n{}",
      name, position, more);
}

std::string floor_at(double z) {
  return fmt::format(
      "[[obstacle]]\nname = 'floor'\nshape = 'plane'\nnormal = [0.0, 0.0, "
      "1.0]\nposition = [0.0, 0.0, {:.6f}]\n",
      z);
}

std::string contact(const std::string& A, const std::string& B,
                    const std::string& options = kOptions) {
  return fmt::format("[[contact]]\nbetween = ['{}', '{}']\n{}", A, B, options);
}

/// A link of two spheres with its centre of mass 0.3 m along x.
const std::string kDumbbell =
    "<link name='bell'><inertial><origin xyz='0.3 0 0'/><mass value='1'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
    "<collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/>"
    "</geometry></collision></link>\n";

std::vector<std::string> pair_names(const BuiltScene& built) {
  std::vector<std::string> names;
  for (const auto& pair : built.model.pairs) names.push_back(pair.name);
  return names;
}

TEST(ContactAssembly, MakesAPairForEveryTwoShapes) {
  const SceneFolder folder;
  const BuiltScene built =
      folder.build(kDumbbell, kTime + projectile("ball", "0.0, 0.0, 1.0") +
                                  floor_at(-1.0) + contact("*", "*"));
  EXPECT_THAT(pair_names(built),
              ElementsAre("bell.1/ball", "bell.2/ball", "bell.1/floor",
                          "bell.2/floor", "ball/floor"));
  EXPECT_EQ(built.model.pairs[0].body_A, 0);
  EXPECT_EQ(built.model.pairs[0].body_B, 1);
  EXPECT_EQ(built.model.pairs[4].body_A, 1);
  EXPECT_EQ(built.model.pairs[4].body_B, dynamics::kWorld);
}

TEST(ContactAssembly, WithoutAContactThereIsNoPair) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kDumbbell, kTime + projectile("ball", "0.0, 0.0, 0.0") + floor_at(0.5));
  EXPECT_TRUE(built.model.pairs.empty());
  EXPECT_THAT(built.warnings, ElementsAre(HasSubstr("obstacle 'floor' changes "
                                                    "nothing: no [[contact]] "
                                                    "names it")));
}

// The depth at the start says where the shapes are: the ball of radius 0.1 m
// overlaps by 0.02 m with the sphere around x of the link.
std::string overlap_with(const std::string& robot, const std::string& between,
                         const std::string& base, const Vector3& center) {
  const SceneFolder folder;
  const Vector3 p = center + Vector3(0.0, 0.0, 0.18);
  return input_error([&] {
    (void)folder.build(
        robot, kTime + base +
                   projectile("ball", fmt::format("{:.12f}, {:.12f}, {:.12f}",
                                                  p.x(), p.y(), p.z())) +
                   contact("ball", between));
  });
}

TEST(ContactAssembly, ShapesAreWhereTheirLinkIs) {
  EXPECT_THAT(overlap_with(kDumbbell, "bell", "", Vector3::Zero()),
              HasSubstr("contact 'ball/bell.1': the bodies overlap by 0.02 m "
                        "at the start, at (0, 0, 0.09) m"));
  const Vector3 rpy(0.4, -0.3, 1.1);
  const Vector3 origin(0.2, 0.5, -0.1);
  EXPECT_THAT(overlap_with(kDumbbell, "bell",
                           "[initial.base]\nposition = [0.2, 0.5, -0.1]\n"
                           "orientation_rpy = [0.4, -0.3, 1.1]\n",
                           origin + rotation_rpy(rpy) * Vector3::UnitX()),
              HasSubstr("contact 'ball/bell.2': the bodies overlap by 0.02 m"));
}

// A link without mass on a fixed joint: its shape moves with the dumbbell.
TEST(ContactAssembly, LinksOnFixedJointsKeepTheirShapes) {
  const std::string mount =
      "<link name='mount'><collision><origin xyz='0 0 0.5'/><geometry>"
      "<sphere radius='0.1'/></geometry></collision></link>\n"
      "<joint name='m' type='fixed'><parent link='bell'/><child link='mount'/>"
      "<origin xyz='0 2 0' rpy='1.5707963267948966 0 0'/></joint>\n";
  // z of the mount is -y of the link.
  EXPECT_THAT(
      overlap_with(kDumbbell + mount, "mount", "", Vector3(0.0, 1.5, 0.0)),
      HasSubstr("contact 'ball/mount': the bodies overlap by 0.02 m"));
  const std::string fixed =
      "<joint name='w' type='fixed'><parent link='world'/><child link='bell'/>"
      "<origin xyz='0 0 7'/></joint>\n";
  EXPECT_THAT(overlap_with(kWorld + kDumbbell + mount + fixed, "mount", "",
                           Vector3(0.0, 1.5, 7.0)),
              HasSubstr("contact 'ball/mount': the bodies overlap by 0.02 m"));
}

// 3 % of R_e = 0.1 m of a sphere on a plane.
TEST(ContactAssembly, TakesSmallOverlapsForTouching) {
  const SceneFolder folder;
  const auto build = [&](double z, const std::string& options) {
    return input_error([&] {
      (void)folder.build(
          kWorld, kTime +
                      projectile("ball", fmt::format("0.0, 0.0, {:.6f}", z)) +
                      floor_at(0.0) + contact("ball", "floor", options));
    });
  };
  EXPECT_EQ(build(0.0971, kOptions), "");
  EXPECT_THAT(build(0.0969, kOptions),
              AllOf(HasSubstr("scenario.toml"),
                    HasSubstr("the bodies overlap by 0.0031 m"),
                    HasSubstr("up to 0.003 m counts as touching")));
  EXPECT_EQ(build(0.0969, kOptions + "radius = 0.2\n"), "");
  EXPECT_THAT(build(-1.0, kOptions), HasSubstr("the bodies overlap by 1.1 m"));
}

// Of a cube of 2 a on a plane 1 % of a, in whatever unit.
TEST(ContactAssembly, TakesFlatOverlapsForTouchingByTheSizeOfBoth) {
  const SceneFolder folder;
  for (const double a : {1e-3, 0.1, 1.0, 1e3}) {
    const std::string cube = fmt::format(
        "<link name='cube'><inertial><mass value='1'/><inertia ixx='{0}' "
        "iyy='{0}' izz='{0}' ixy='0' ixz='0' iyz='0'/></inertial><collision>"
        "<geometry><box size='{1} {1} {1}'/></geometry></collision></link>\n",
        2.0 / 3.0 * a * a, 2.0 * a);
    const auto build = [&](double fraction) {
      return input_error([&] {
        (void)folder.build(cube, kTime + floor_at((fraction - 1.0) * a) +
                                     contact("cube", "floor"));
      });
    };
    EXPECT_EQ(build(0.009), "") << a;
    EXPECT_THAT(
        build(0.011),
        HasSubstr(fmt::format("up to {:.2g} m counts as touching", 0.01 * a)))
        << a;
  }
}

// Hertz's force of steel on steel at 1 um [@johnson1985, eq. 4.23].
/// A free link of one shape of up to 0.1 m.
std::string make_small(const std::string& geometry) {
  return "<link name='small'><inertial><mass value='1'/><inertia ixx='1' "
         "iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision>"
         "<origin rpy='0.3 0.2 0'/><geometry>" +
         geometry + "</geometry></collision></link>\n";
}

// Surfaces that do not meet press nothing, which must not pass for a gap.
TEST(ContactAssembly, RefusesOneShapeWithinAnother) {
  const SceneFolder folder;
  for (const std::string inner :
       {"<sphere radius='0.05'/>", "<box size='0.1 0.05 0.05'/>",
        "<cylinder radius='0.03' length='0.1'/>",
        "<capsule radius='0.03' length='0.05'/>"}) {
    for (const std::string outer :
         {"shape = 'box'\nsize = [2.0, 2.0, 2.0]\n",
          "shape = 'cylinder'\nradius = 1.0\nlength = 2.0\n",
          "shape = 'capsule'\nradius = 1.0\nlength = 2.0\n",
          "shape = 'sphere'\nradius = 1.0\n"}) {
      for (const double x : {0.0, 0.31}) {
        const std::string obstacle = fmt::format(
            "[[obstacle]]\nname = 'big'\nposition = [{:.3f}, 0.0, 0.1]\n", x);
        for (const auto& [A, B] :
             {std::pair("small", "big"), std::pair("big", "small")}) {
          const std::string refused = input_error([&] {
            (void)folder.build(make_small(inner),
                               kTime + obstacle + outer + contact(A, B, ""));
          });
          EXPECT_THAT(refused, AnyOf(HasSubstr("lies within the other"),
                                     HasSubstr("the bodies overlap by")))
              << inner << outer << x;
        }
      }
    }
  }
}

TEST(ContactAssembly, TellsTheForceOfASmallOverlap) {
  const SceneFolder folder;
  const std::string steel = "youngs_modulus = 2e11\npoisson_ratio = 0.3\n";
  const BuiltScene built = folder.build(
      kWorld, kTime + projectile("ball", "0.0, 0.0, 0.099999", steel) +
                  floor_at(0.0) + steel + contact("ball", "floor"));
  const double modulus = 1e11 / 0.91;
  const double force =
      4.0 / 3.0 * modulus * std::sqrt(0.1) * std::pow(1e-6, 1.5);
  ASSERT_EQ(built.warnings.size(), 1U);
  EXPECT_THAT(built.warnings[0],
              AllOf(HasSubstr("the bodies overlap by 1e-06 m"),
                    HasSubstr(fmt::format("with {:.4g} N", force))));
}

TEST(ContactAssembly, TellsOfEveryOverlap) {
  const SceneFolder folder;
  const std::string text = input_error([&] {
    (void)folder.build(kDumbbell,
                       kTime + floor_at(0.0) + contact("bell", "floor"));
  });
  EXPECT_THAT(text,
              AllOf(HasSubstr("'bell.1/floor'"), HasSubstr("'bell.2/floor'")));
}

// A parameter of a contact is one of its law, so no other run resumes it.
TEST(ContactAssembly, EveryKeyOfAContactIsInTheManifest) {
  const SceneFolder folder;
  const auto describe_pairs = [&](const std::string& options,
                                  const std::string& ball = "",
                                  const std::string& contact_of_link = "") {
    const BuiltScene built =
        folder.build(kDumbbell + contact_of_link,
                     kTime + projectile("ball", "0.0, 0.0, 1.0", ball) +
                         contact("ball", "bell", options));
    Manifest manifest;
    describe(manifest, "", built.model.pairs);
    return manifest.text();
  };
  const std::string all =
      "friction = 0.3\nstatic_friction = 0.4\nstribeck_speed = 0.02\n"
      "restitution = 0.5\nradius = 0.01\nstiffness = 1e9\n";
  const std::string same = describe_pairs(all);
  EXPECT_EQ(describe_pairs(all), same);
  for (const auto& [key, other] : std::map<std::string, std::string>{
           {"friction = 0.3", "friction = 0.2"},
           {"static_friction = 0.4", "static_friction = 0.5"},
           {"stribeck_speed = 0.02", "stribeck_speed = 0.03"},
           {"restitution = 0.5", "restitution = 0.6"},
           {"restitution = 0.5", "damping = 0.6"},
           {"radius = 0.01", "radius = 0.02"},
           {"stiffness = 1e9", "stiffness = 2e9"}}) {
    std::string changed = all;
    changed.replace(changed.find(key), key.size(), other);
    EXPECT_NE(describe_pairs(changed), same) << other;
  }
  EXPECT_NE(describe_pairs(all, "youngs_modulus = 1e9\npoisson_ratio = 0.3\n"),
            same);
  EXPECT_NE(describe_pairs(all, "",
                           "<contact link='bell' youngs_modulus='1e9' "
                           "poisson_ratio='0.3'/>\n"),
            same);
}

// Newton's impact law: (1 - e) / 2 and (1 + e) / 2 of the speed of the first of
// two equal balls, whose centres meet. 0.5 % is what steps of 1 % of the impact
// leave open.
TEST(ContactAssembly, BallsExchangeMomentumAsTheirRestitutionSays) {
  const SceneFolder folder;
  const std::string material = "youngs_modulus = 1e9\npoisson_ratio = 0.3\n";
  const BuiltScene built = folder.build(
      kWorld,
      time_table(0.02, 2e-5) +
          projectile("one", "0.0, 0.0, 0.0",
                     "velocity = [1.0, 0.0, 0.0]\n" + material) +
          projectile("two", "0.205, 0.0, 0.0", material) +
          contact("one", "two") +
          "[[probe]]\nname = 'one'\nlink = 'one'\nquantity = 'velocity'\n"
          "[[probe]]\nname = 'two'\nlink = 'two'\nquantity = 'velocity'\n");
  const auto end = test::simulate_probes(built);
  EXPECT_NEAR(end[0], 0.25, 0.005);
  EXPECT_NEAR(end[3], 0.75, 0.005);
  EXPECT_NEAR(end[0] + end[3], 1.0, 1e-9);
}

/// A saved body with two triangles that may touch, 0.5 m above and below its
/// centre of mass.
flexbody::ReducedBody make_touching_body() {
  flexbody::ReducedBody body =
      testing::make_point_mass_body(12, 3, 5.0, 1.0, 300.0, 3).reduced;
  for (const double side : {1.0, -1.0}) {
    flexbody::ContactSurface surface;
    surface.name = side > 0.0 ? "skin" : "pad";
    surface.tags = {1, 2, 3};
    surface.x_B.resize(3, 3);
    surface.x_B << -1.0, 1.0, 0.0, -1.0 * side, -1.0 * side, 1.0 * side,
        0.5 * side, 0.5 * side, 0.5 * side;
    surface.Phi_B = MatrixX::Constant(9, 3, 0.1);
    surface.residual = VectorX::Constant(3, 1e-9);
    surface.patch_radius = VectorX::Constant(3, 0.01);
    surface.faces = {{0, 1, 2, -1, -1, -1}};
    surface.youngs_modulus = 1e9;
    surface.poisson_ratio = 0.3;
    body.contact_surfaces.push_back(surface);
  }
  return body;
}

class TouchingBody : public ::testing::Test {
 protected:
  void SetUp() override {
    flexbody::write_body(body_, folder_.path() / "body.h5");
  }
  /// A ball of radius 0.1 m at a place relative to the centre of mass.
  [[nodiscard]] BuiltScene build(const Vector3& at, const std::string& robot,
                                 const std::string& scenario) const {
    const Vector3 p = body_.p_MoBcm_M + at;
    return folder_.build(
        "<link name='body'/>\n<flexible link='body'><reduced file='body.h5'/>"
        "</flexible>\n" +
            robot,
        kTime + scenario +
            projectile("ball", fmt::format("{:.12f}, {:.12f}, {:.12f}", p.x(),
                                           p.y(), p.z())) +
            contact("body", "ball"));
  }
  [[nodiscard]] std::string error_of(const Vector3& at,
                                     const std::string& robot = "",
                                     const std::string& scenario = "") const {
    return input_error([&] { (void)build(at, robot, scenario); });
  }
  flexbody::ReducedBody body_ = make_touching_body();
  SceneFolder folder_;
};

TEST_F(TouchingBody, TouchesWithItsSkinOrTheSurfacesThatItNames) {
  const Vector3 away(0.0, 0.0, 2.0);
  EXPECT_THAT(pair_names(build(away, "", "")), ElementsAre("body/ball"));
  EXPECT_THAT(
      pair_names(build(away, "<contact link='body' surface='pad skin'/>", "")),
      ElementsAre("body.pad/ball", "body.skin/ball"));
}

TEST_F(TouchingBody, HasItsSurfaceWhereItsMeshIs) {
  const Vector3 above(0.0, 0.0, 0.58);
  EXPECT_THAT(error_of(above),
              HasSubstr("contact 'body/ball': the bodies overlap by 0.02 m"));
  EXPECT_EQ(error_of(above, "<contact link='body' surface='pad'/>"), "");
  EXPECT_THAT(error_of(-above, "<contact link='body' surface='pad'/>"),
              HasSubstr("contact 'body/ball': the bodies overlap by 0.02 m"));
}

TEST_F(TouchingBody, LosesTheModesOfItsSurfaceAtLevelRigid) {
  const BuiltScene built = build(Vector3(0.0, 0.0, 2.0), "",
                                 "[fidelity]\nlinks = { body = 'rigid' }\n");
  ASSERT_EQ(built.model.pairs.size(), 1U);
  EXPECT_EQ(built.model.bodies[0].modes, 0);
  EXPECT_NO_THROW(built.model.pairs[0].law->check(0, 0));
}

// R is what modes leave out, so it goes with them.
TEST_F(TouchingBody, HasNoResidualFlexibilityAtLevelRigid) {
  const auto describe_pairs = [&](const std::string& level) {
    const BuiltScene built =
        build(Vector3(0.0, 0.0, 2.0), "",
              "[fidelity]\nlinks = { body = '" + level + "' }\n");
    Manifest manifest;
    describe(manifest, "", built.model.pairs);
    return manifest.text();
  };
  const std::string coupled = describe_pairs("coupled");
  const std::string rigid = describe_pairs("rigid");
  for (auto& surface : body_.contact_surfaces) surface.residual *= 2.0;
  flexbody::write_body(body_, folder_.path() / "body.h5");
  EXPECT_NE(describe_pairs("coupled"), coupled);
  EXPECT_EQ(describe_pairs("rigid"), rigid);
}

// It is saved without parts and slices.
TEST_F(TouchingBody, TouchesBallsAloneWithoutConvexParts) {
  EXPECT_THAT(
      error_of(Vector3(0.0, 0.0, 2.0), "",
               "[[obstacle]]\nname = 'post'\nshape = 'cylinder'\n"
               "radius = 1.0\nlength = 1.0\nposition = [9.0, 0.0, 0.0]\n" +
                   contact("body", "post")),
      AllOf(HasSubstr("between 'body' and 'post'"),
            HasSubstr("surface 'skin' has no convex parts")));
}

TEST_F(TouchingBody, NeedsTheSecondOrderOfItsSurfaceAtLevelNonlinear) {
  flexbody::QuadraticManifold manifold;
  manifold.paired = {1, 2};
  manifold.Q = MatrixX::Zero(2, 3);
  manifold.S2 = Matrix6X::Zero(6, 3);
  manifold.Theta_B = MatrixX::Zero(body_.rows.Phi_B.rows(), 3);
  body_.manifold = manifold;
  flexbody::write_body(body_, folder_.path() / "body.h5");
  const Vector3 away(0.0, 0.0, 2.0);
  const std::string level = "[fidelity]\nlinks = { body = 'nonlinear' }\n";
  EXPECT_THAT(error_of(away, "", level),
              HasSubstr("surface 'skin' of its saved body has no second "
                        "order, which level nonlinear needs"));
  for (auto& surface : body_.contact_surfaces) {
    surface.Phi_B = MatrixX::Constant(9, 6, 0.1);
  }
  flexbody::write_body(body_, folder_.path() / "body.h5");
  const BuiltScene built = build(away, "", level);
  ASSERT_EQ(built.model.pairs.size(), 1U);
  EXPECT_NO_THROW(built.model.pairs[0].law->check(6, 0));
  // Lower levels take the modes alone.
  const BuiltScene coupled = build(away, "", "");
  EXPECT_NO_THROW(coupled.model.pairs[0].law->check(3, 0));
}

TEST_F(TouchingBody, IsRefusedWithASurfaceThatItDoesNotHave) {
  EXPECT_THAT(
      error_of(Vector3(0.0, 0.0, 2.0), "<contact link='body' surface='pads'/>"),
      AllOf(HasSubstr("link 'body': unknown surface 'pads'; did you "
                      "mean 'pad'"),
            HasSubstr("a saved body has those that it was reduced "
                      "with")));
}

}  // namespace
}  // namespace limber::scene::contact_assembly_test
