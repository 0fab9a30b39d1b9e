// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/command.hpp"

/// A steel blade of 1 m x 20 mm x 4 mm through every command.
namespace limber::test::slender_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kLength = 1.0, kWidth = 0.02, kThickness = 0.004;  // m
constexpr double kModulus = 210e9, kDensity = 7850.0;
const std::string kSteel =
    "--youngs-modulus 210e9 --poisson-ratio 0.3 --density 7850";

/// F L^3 / (3 E I) across the thickness [m/N].
double tip_compliance() {
  return 4.0 * std::pow(kLength / kThickness, 3) / (kModulus * kWidth);
}

/// First bending mode of Euler and Bernoulli [Hz]. @param root of its frequency
/// equation
double bending_frequency(double root) {
  return root * root / (2.0 * std::numbers::pi * kLength * kLength) *
         kThickness * std::sqrt(kModulus / (12.0 * kDensity));
}

class Blade : public ::testing::Test {
 protected:
  Blade() {
    place_.write(
        "blade.geo",
        fmt::format(
            "Point(1) = {{0, {}, {}}};\n"
            "l[] = Extrude {{0, {}, 0}} {{ Point{{1}}; Layers{{2}}; }};\n"
            "s[] = Extrude {{0, 0, {}}} {{ Line{{l[1]}}; Layers{{1}}; "
            "Recombine; }};\n"
            "b[] = Extrude {{{}, 0, 0}} {{ Surface{{s[1]}}; Layers{{50}}; "
            "Recombine; }};\n"
            "Physical Surface(\"root\") = {{s[1]}};\n"
            "Physical Surface(\"tip\") = {{b[0]}};\n"
            "Physical Volume(\"body\") = {{b[1]}};\nMesh.ElementOrder = 2;\n",
            -0.5 * kWidth, -0.5 * kThickness, kWidth, kThickness, kLength));
  }

  /// @param held how the blade is held, and where its joint is
  void write_scene(const std::string& held, const std::string& joint) const {
    place_.write(
        "blade.urdf",
        "<robot name='r'>" + joint +
            "<link name='blade'/><flexible link='blade'>"
            "<mesh file='blade.geo'/><material youngs_modulus='210e9' "
            "poisson_ratio='0.3' density='7850'/>" +
            held +
            "<basis eigenmodes='6'/><interface name='tip' group='tip'/>"
            "</flexible></robot>\n");
    place_.write("s.toml",
                 "robot = 'blade.urdf'\n[time]\nduration = 0.05\nstep = 5e-4\n"
                 "[output]\npictures = false\n"
                 "[[load]]\nname = 'push'\nlink = 'blade'\ninterface = 'tip'\n"
                 "force = [0, 0, 0.1]\nframe = 'world'\n"
                 "[[probe]]\nname = 'tip'\nlink = 'blade'\n"
                 "interface = 'tip'\nquantity = 'deformation'\n");
  }

  [[nodiscard]] json run(const std::string& arguments) const {
    const CommandResult result = place_.limber(arguments);
    EXPECT_EQ(result.status, 0) << arguments << "\n" << result.errors;
    return json::parse(result.out, nullptr, false);
  }

  Workspace place_;
};

TEST_F(Blade, HasTheFrequenciesOfABeam) {
  for (const auto& [more, root] :
       {std::pair{"", 4.73004074}, std::pair{"--clamp root", 1.87510407}}) {
    const json modes = run("modes blade.geo --json " + kSteel + " " + more);
    EXPECT_NEAR(
        modes["frequencies_hz"][0].get<double>() / bending_frequency(root), 1.0,
        3e-3)
        << more;
  }
}

TEST_F(Blade, IsReducedFreeAndClampedWithItsInterfaces) {
  for (const std::string more : {"", "--clamp root"}) {
    const json body =
        run("reduce blade.geo --json --modes auto --interface "
            "tip -o b.h5 " +
            kSteel + " " + more);
    EXPECT_GT(body["modes"].get<int>(), 6) << more;
  }
}

TEST_F(Blade, BendsAsABeamAtEveryLevelThatBends) {
  write_scene("<clamp group='root'/>", "");
  for (const std::string level : {"coupled", "full"}) {
    const json found = run("static s.toml --json --out o --fidelity " + level);
    EXPECT_NEAR(found["probes"]["tip.dz"]["value"].get<double>() /
                    (0.1 * tip_compliance()),
                1.0, 4e-3)
        << level;
  }
}

// A step load swings the tip to twice the static deflection about it.
TEST_F(Blade, SwingsOnAJoint) {
  write_scene(
      "<interface name='root' group='root'/><attach joint='foot' "
      "interface='root'/>",
      "<link name='world'/><joint name='foot' type='fixed'><parent "
      "link='world'/><child link='blade'/></joint>");
  const json summary = run("run s.toml --json --out o");
  EXPECT_EQ(summary["completed"], true);
  EXPECT_LT(summary["energy"]["relative_drift"].get<double>(), 1e-2);
}

}  // namespace
}  // namespace limber::test::slender_test
