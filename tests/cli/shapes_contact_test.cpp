// SPDX-License-Identifier: BSD-3-Clause
// Shapes other than balls that touch, as the command reports it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "cli/command.hpp"
#include "limber/common/files/hdf5_file.hpp"

namespace limber::test::shapes_contact_test {
namespace {

using nlohmann::json;

/// A block of 2 kg above a table, whose top is at z = -0.05 - gap.
void write_block(const Workspace& place, const std::string& geometry,
                 double gap, const std::string& more, bool has_material) {
  place.write("block.urdf",
              "<robot name='r'><link name='block'><inertial><mass value='2'/>"
              "<inertia ixx='0.0033' iyy='0.0033' izz='0.0033' ixy='0' "
              "ixz='0' iyz='0'/></inertial><collision><geometry>" +
                  geometry + "</geometry></collision></link>" +
                  (has_material ? "<contact link='block' youngs_modulus='1e10' "
                                  "poisson_ratio='0.3'/></robot>"
                                : "</robot>"));
  place.write("scene.toml",
              "robot = 'block.urdf'\n[output]\npictures = false\n"
              "[[probe]]\nname = 'p'\nlink = 'block'\nquantity = 'position'\n"
              "[[obstacle]]\nname = 'table'\nshape = 'box'\n"
              "size = [0.5, 0.5, 0.1]\nposition = [0.0, 0.0, " +
                  std::to_string(-0.1 - gap) +
                  "]\n[[contact]]\nbetween = ['block', 'table']\n" + more);
}

json run_block(const Workspace& place, const std::string& geometry, double gap,
               const std::string& more, bool has_material = true) {
  write_block(place, geometry, gap, more, has_material);
  const CommandResult result = place.limber("run scene.toml --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

constexpr const char* kBox = "<box size='0.1 0.1 0.1'/>";

// A slope of 10 degrees, mu = 0.3: 1 s, in which one without friction slides
// 0.85 m.
TEST(BlockOnABox, HoldsOnASlope) {
  const Workspace place;
  const json run = run_block(place, kBox, 1e-6,
                             "friction = 0.3\nrestitution = 0.2\n[gravity]\n"
                             "acceleration = [1.70354, 0.0, -9.66136]\n"
                             "[time]\nduration = 1.0\nstep = 1e-3\n");
  const json& p = run["probes"]["p.x"];
  EXPECT_LT(std::abs(p["final"].get<double>()), 1e-5);
  ASSERT_EQ(run["contacts"].size(), 1U);
  EXPECT_NEAR(run["contacts"][0]["impulse"].get<double>(), 2.0 * 9.66136, 0.05);
}

// J / (m R^2) = 0.66.
TEST(BallOnABox, RollsAgainstRollingFriction) {
  const Workspace place;
  const std::string slope =
      "friction = 0.5\nrestitution = 0.2\n[gravity]\n"
      "acceleration = [1.70354, 0.0, -9.66136]\n"
      "[time]\nduration = 0.6\nstep = 1e-3\n";
  for (const double arm : {0.0, 2e-3, 1e-2}) {
    const json run =
        run_block(place, "<sphere radius='0.05'/>", 1e-6,
                  "rolling_friction = " + std::to_string(arm) + "\n" + slope);
    const double pull = 1.70354 - arm / 0.05 * 9.66136;
    const double expected = pull > 0.0 ? 0.18 * pull / 1.66 : 0.0;
    EXPECT_NEAR(run["probes"]["p.x"]["final"].get<double>(), expected,
                0.01 * expected + 1e-3);
  }
}

TEST(RollingFriction, IsRefusedWhereItCannotAct) {
  const Workspace place;
  const auto run = [&](const std::string& more) {
    place.write("ball.urdf",
                "<robot name='r'><link name='b'><inertial><mass value='2'/>"
                "<inertia ixx='0.002' iyy='0.002' izz='0.002' ixy='0' ixz='0' "
                "iyz='0'/></inertial><collision><geometry><sphere "
                "radius='0.05'/></geometry></collision></link></robot>");
    place.write("scene.toml",
                "robot = 'ball.urdf'\n[time]\nduration = 0.1\nstep = 1e-3\n"
                "[[obstacle]]\nname = 'floor'\nshape = 'plane'\n"
                "position = [0.0, 0.0, -0.06]\n"
                "[[contact]]\nbetween = ['b', 'floor']\n" +
                    more);
    return place.limber("run scene.toml --out o");
  };
  const CommandResult negative = run("rolling_friction = -1e-3\n");
  EXPECT_EQ(negative.status, 2);
  EXPECT_NE(negative.errors.find("rolling_friction"), std::string::npos);
  const CommandResult unknown = run("rolling_friction = 'much'\n");
  EXPECT_EQ(unknown.status, 2);
}

/// The last row of the patch that the results hold.
Eigen::VectorXd read_patch(const Workspace& place) {
  const Hdf5File file = Hdf5File::open(place.folder() / "o/results.h5");
  const MatrixX rows = file.read_matrix("scene/contacts/0000/patch");
  return rows.row(rows.rows() - 1).transpose();
}

// A pressure that is linear across 0.1 x 0.1 m has second moments of 0.1^2 / 12
// about its centre, less its distance e from the middle squared along the
// slope: friction, 50 mm below the block's centre, shifts it.
TEST(BlockOnABox, ShowsTheEllipseAndTheFrictionOfItsPatch) {
  const Workspace place;
  for (const double mu : {0.3, 0.1}) {
    (void)run_block(place, kBox, 1e-6,
                    "friction = " + std::to_string(mu) +
                        "\nrestitution = 0.2\n[gravity]\n"
                        "acceleration = [1.70354, 0.0, -9.66136]\n"
                        "[time]\nduration = 0.3\nstep = 1e-3\n");
    const Eigen::VectorXd patch = read_patch(place);
    const Vector3 u = patch.head<3>();
    const Vector3 v = patch.segment<3>(3);
    const bool slips = mu < 0.2;
    const double friction = 2.0 * (slips ? mu * 9.66136 : 1.70354);
    const double e = 0.05 * friction / (2.0 * 9.66136);
    const double across = 2.0 * std::sqrt(0.01 / 12.0);
    const double along = 2.0 * std::sqrt(0.01 / 12.0 - e * e);
    EXPECT_NEAR(u.norm(), across, 0.01 * across);
    EXPECT_NEAR(v.norm(), along, 0.02 * along);
    EXPECT_LT(std::abs(u.dot(v)), 1e-9);
    EXPECT_LT(std::abs(u.z()) + std::abs(v.z()), 1e-6);
    // On the table.
    EXPECT_NEAR(patch[6], friction, 0.01 * friction);
    EXPECT_EQ(patch[9], slips ? 1.0 : 0.0);
  }
}

TEST(BlockOnABox, SlidesAsCoulombSays) {
  const Workspace place;
  const json run = run_block(place, kBox, 1e-6,
                             "friction = 0.1\nrestitution = 0.2\n[gravity]\n"
                             "acceleration = [1.70354, 0.0, -9.66136]\n"
                             "[time]\nduration = 0.3\nstep = 5e-4\n");
  const double way = 0.5 * (1.70354 - 0.1 * 9.66136) * 0.09;
  EXPECT_NEAR(run["probes"]["p.x"]["final"].get<double>() / way, 1.0, 0.01);
}

TEST(BlockOnABox, LeapsBackAsItsRestitutionSays) {
  for (const char* geometry : {kBox, "<capsule radius='0.02' length='0.06'/>",
                               "<cone radius='0.05' length='0.1'/>",
                               "<ellipsoid radii='0.03 0.04 0.05'/>"}) {
    const Workspace place;
    const json run = run_block(place, geometry, 0.01,
                               "friction = 0.0\nrestitution = 0.6\n[gravity]\n"
                               "acceleration = [0.0, 0.0, -9.81]\n"
                               "[time]\nduration = 0.06\nstep = 1e-5\n");
    ASSERT_EQ(run["contacts"].size(), 1U) << geometry;
    const json& impact = run["contacts"][0];
    EXPECT_EQ(impact["touches"], 1) << geometry;
    EXPECT_NEAR(impact["restitution"].get<double>(), 0.6, 0.02) << geometry;
    EXPECT_NEAR(impact["touch_speed"].get<double>(), std::sqrt(0.02 * 9.81),
                2e-3)
        << geometry;
  }
}

constexpr const char* kFall =
    "friction = 0.0\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
    "[time]\nduration = 0.15\nstep = 1e-3\n";

constexpr const char* kFlight =
    "friction = 0.0\n[initial.base]\nvelocity = [0.0, 0.0, -1.0]\n"
    "[time]\nduration = 0.15\nstep = 1e-3\n";

// Without gravity, whose work in a soft impact lowers the speed after it.
TEST(BlockOnABox, LeapsBackWithoutAMaterialAndWithAStiffness) {
  for (const char* geometry :
       {kBox, "<cylinder radius='0.05' length='0.1'/>"}) {
    for (const std::string own : {"", "stiffness = 1e7\n"}) {
      const Workspace place;
      const json run = run_block(place, geometry, 0.05,
                                 own + "restitution = 0.6\n" + kFlight, false);
      ASSERT_GE(run["contacts"].size(), 1U) << geometry;
      EXPECT_NEAR(run["contacts"][0]["restitution"].get<double>(), 0.6, 2e-3)
          << geometry << own;
      EXPECT_LT(std::abs(run["contacts"][0]["energy"]["error"].get<double>()),
                1e-3 * run["contacts"][0]["energy"]["in"].get<double>());
    }
  }
}

// Of a constant damping: (1 + e) b v = ln((1 + b v) / (1 - e b v)).
TEST(BlockOnABox, LeapsBackAsItsDampingSays) {
  const Workspace place;
  const json run =
      run_block(place, kBox, 0.05, std::string("damping = 0.5\n") + kFall);
  ASSERT_GE(run["contacts"].size(), 1U);
  const double x = 0.5 * run["contacts"][0]["touch_speed"].get<double>();
  const double e = run["contacts"][0]["restitution"].get<double>();
  EXPECT_GT(e, 0.3);
  EXPECT_NEAR((1.0 + e) * x, std::log((1.0 + x) / (1.0 - e * x)), 1e-3);
}

TEST(BlockOnABox, HasNoRadiusOfItsOwn) {
  const Workspace place;
  write_block(place, kBox, 0.05, std::string("radius = 0.1\n") + kFall, true);
  const CommandResult result = place.limber("run scene.toml --out o");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.errors.find("'radius' does not apply to a box and a box"),
            std::string::npos)
      << result.errors;
}

// ---- a cone in a ring of twelve sides, which it meets at all of them

void write_ring(const Workspace& place) {
  constexpr int kSides = 12;
  const auto corner = [](double radius, int k, double z) {
    const double angle = 2.0 * std::numbers::pi * k / kSides;
    return fmt::format("vertex {:.17g} {:.17g} {:.17g}\n",
                       radius * std::cos(angle), radius * std::sin(angle), z);
  };
  std::string text = "solid ring\n";
  const auto add = [&text](const std::string& a, const std::string& b,
                           const std::string& c) {
    text +=
        "facet normal 0 0 0\nouter loop\n" + a + b + c + "endloop\nendfacet\n";
  };
  // Corners of a section, counterclockwise seen along the way around.
  constexpr std::array<std::array<double, 2>, 4> kSection{
      {{0.05, 0.0}, {0.08, 0.0}, {0.08, 0.03}, {0.05, 0.03}}};
  for (int k = 0; k < kSides; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [r, z] = kSection[i];
      const auto [r_next, z_next] = kSection[(i + 1) % 4];
      add(corner(r, k, z), corner(r, k + 1, z), corner(r_next, k + 1, z_next));
      add(corner(r, k, z), corner(r_next, k + 1, z_next),
          corner(r_next, k, z_next));
    }
  }
  place.write("ring.stl", text + "endsolid ring\n");
}

void write_docking(const Workspace& place, double e, double aside) {
  write_ring(place);
  const auto write_robot = [&](const char* name, double mass,
                               const std::string& origin,
                               const std::string& shape) {
    place.write(
        fmt::format("{}.urdf", name),
        fmt::format("<robot name='{0}'><link name='{0}'><inertial><mass "
                    "value='{1}'/><inertia ixx='0.005' iyy='0.005' izz='0.009' "
                    "ixy='0' ixz='0' iyz='0'/></inertial><collision>{2}"
                    "<geometry>{3}</geometry></collision></link><contact "
                    "link='{0}' youngs_modulus='3e9' poisson_ratio='0.3'/>"
                    "</robot>",
                    name, mass, origin, shape));
  };
  write_robot("probe", 0.5, "<origin rpy='3.141592653589793 0 0'/>",
              "<cone radius='0.08' length='0.12'/>");
  write_robot("ring", 2.0, "", "<mesh filename='ring.stl'/>");
  place.write(
      "scene.toml",
      fmt::format("[[robot]]\nname = 'a'\nfile = 'probe.urdf'\nposition = "
                  "[{}, 0.0, 0.05]\nvelocity = [0.0, 0.0, -0.2]\n"
                  "[[robot]]\nname = 'b'\nfile = 'ring.urdf'\n"
                  "[[contact]]\nbetween = ['a.probe', 'b.ring']\n"
                  "friction = 0.0\nrestitution = {}\n"
                  "[time]\nduration = 0.3\nstep = 1e-3\n"
                  "[output]\npictures = false\n[[probe]]\nname = 'v'\n"
                  "link = 'a.probe'\nquantity = 'velocity'\n",
                  aside, e));
}

// v' = (m v - e M v) / (m + M), m of the cone.
TEST(ConeInARing, LeapsBackAsItsRestitutionSays) {
  for (const double e : {1.0, 0.5, 0.2}) {
    const Workspace place;
    write_docking(place, e, 0.0);
    const CommandResult result = place.limber("run scene.toml --out o --json");
    ASSERT_EQ(result.status, 0) << result.errors;
    const json run = json::parse(result.out);
    EXPECT_NEAR(run["probes"]["v.vz"]["final"].get<double>(),
                -0.2 * (0.5 - 2.0 * e) / 2.5, 5e-4)
        << e;
    ASSERT_EQ(run["contacts"].size(), 1U) << e;
    EXPECT_NEAR(run["contacts"][0]["restitution"].get<double>(), e, 5e-3);
    EXPECT_LT(std::abs(run["contacts"][0]["energy"]["error"].get<double>()),
              1e-9);
  }
}

// Off its middle it strikes several times, at some of the sides each time.
TEST(ConeInARing, HasTheRestitutionOfEachImpact) {
  const Workspace place;
  write_docking(place, 1.0, 4e-3);
  const CommandResult result = place.limber("run scene.toml --out o --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json run = json::parse(result.out);
  ASSERT_GE(run["contacts"].size(), 2U);
  for (const json& impact : run["contacts"]) {
    EXPECT_NEAR(impact["restitution"].get<double>(), 1.0, 5e-3);
  }
}

}  // namespace
}  // namespace limber::test::shapes_contact_test
