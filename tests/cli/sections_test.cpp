// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "places.hpp"

/// Shells and beams on groups of geometries, by the command.
namespace limber::test::sections_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kModulus = 2.1e11;
constexpr double kDensity = 7850.0;
const std::string kSteel =
    " --youngs-modulus 2.1e11 --poisson-ratio 0.3 --density 7850 ";

class Sections : public ::testing::Test {
 protected:
  json find_modes(const std::string& arguments) const {
    const CommandResult result =
        place_.limber("modes " + arguments + kSteel + "--json");
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.status == 0 ? json::parse(result.out) : json();
  }

  /// A square of 1 m in n x n quadrilaterals.
  std::vector<double> find_plate(int n) const {
    place_.write(
        "plate.geo",
        "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nPoint(3) = {1, 1, 0};\n"
        "Point(4) = {0, 1, 0};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\n"
        "Line(3) = {3, 4};\nLine(4) = {4, 1};\nCurve Loop(1) = {1, 2, 3, 4};\n"
        "Plane Surface(1) = {1};\nTransfinite Curve {1, 2, 3, 4} = " +
            std::to_string(n + 1) +
            ";\nTransfinite Surface {1};\nRecombine Surface {1};\n"
            "Physical Surface(\"plate\") = {1};\n"
            "Physical Curve(\"edge\") = {1, 2, 3, 4};\n");
    const json study = find_modes(
        "plate.geo --shell 'group=\"plate\" thickness=\"0.005\"' --clamp edge "
        "--count 4 ");
    return study.at("frequencies_hz").get<std::vector<double>>();
  }

  Workspace place_;
};

/// omega = lambda sqrt(D / (rho h)) / a^2 of a square that is held all around:
/// Leissa, Vibration of Plates, NASA SP-160 (1969), table 4.24
TEST_F(Sections, OfAClampedPlateConvergeToItsFrequencies) {
  const double D = kModulus * std::pow(0.005, 3) / (12.0 * (1.0 - 0.09));
  const double unit = std::sqrt(D / (kDensity * 0.005)) / (2.0 * kPi);
  const std::vector<double> lambda = {35.992, 73.413, 73.413, 108.27};
  const std::vector<double> coarse = find_plate(16);
  const std::vector<double> fine = find_plate(32);
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    const double expected = lambda[i] * unit;
    EXPECT_NEAR(fine[i], expected, 0.01 * expected);
    EXPECT_LT(std::abs(fine[i] - expected),
              0.4 * std::abs(coarse[i] - expected));
  }
}

/// A tube of 4 m and 20 mm, 1 mm wall: omega = k^2 sqrt(E I / (rho A)) / L^2, k
/// L = 1.875104, 4.694091, each in two planes.
TEST_F(Sections, OfASlenderTubeHaveTheFrequenciesOfEuler) {
  place_.write("tube.geo",
               "Point(1) = {0, 0, 0};\nPoint(2) = {0, 2.4, 3.2};\n"
               "Line(1) = {1, 2};\nPhysical Curve(\"tube\") = {1};\n"
               "Physical Point(\"root\") = {1};\n");
  const json study = find_modes(
      "tube.geo --size 0.1 --beam 'section=\"tube\" radius=\"0.01\" "
      "wall=\"0.001\"' --clamp root --count 4 ");
  const auto found = study.at("frequencies_hz").get<std::vector<double>>();
  const double square = 0.25 * (0.01 * 0.01 + 0.009 * 0.009);  // I / A
  for (std::size_t i = 0; i < 4; ++i) {
    const double k = i < 2 ? 1.875104 : 4.694091;
    const double expected =
        k * k / 16.0 * std::sqrt(kModulus * square / kDensity) / (2.0 * kPi);
    EXPECT_NEAR(found[i], expected, 5e-4 * expected);
  }
  EXPECT_NEAR(study.at("mass").get<double>(),
              kDensity * 4.0 * kPi * (1e-4 - 0.81e-4), 1e-9);
}

/// Its middle under 10 N for 0.2 s: of a rigid body the work is (F t)^2 / (2
/// m); a flexible one takes more, and loses none.
TEST_F(Sections, TakeALoadAtAllLevels) {
  place_.write("boom.geo",
               "Point(1) = {-1, 0, 0};\nPoint(2) = {0, 0, 0};\n"
               "Point(3) = {1, 0, 0};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\n"
               "Physical Curve(\"boom\") = {1, 2};\n"
               "Physical Point(\"middle\") = {2};\n");
  place_.write(
      "boom.urdf",
      "<robot name='boom'><link name='boom'/><flexible link='boom'>"
      "<mesh file='boom.geo' size='0.1'/><material youngs_modulus='7e10' "
      "poisson_ratio='0.3' density='2700'/><beam group='boom' section='box' "
      "height='0.02' width='0.03' flange='0.001' web='0.001' y_axis='0 0 1'/>"
      "<basis eigenmodes='6'/><interface name='middle' group='middle' "
      "weighting='equal'/></flexible></robot>\n");
  place_.write("s.toml",
               "robot = 'boom.urdf'\n[time]\nduration = 0.2\nstep = 0.0005\n"
               "integrator = 'energy-conserving'\n[output]\npictures = false\n"
               "[[load]]\nname = 'push'\nlink = 'boom'\ninterface = 'middle'\n"
               "force = [0, 0, 10]\n");
  const double mass = 2700.0 * 2.0 * (0.02 * 0.03 - 0.018 * 0.028);
  const auto find_energy = [&](const std::string& level) {
    const CommandResult result = place_.limber("run s.toml --cache c --out " +
                                               level + " --fidelity " + level);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(read_text(place_.folder() / level / "summary.json"))
        .at("energy");
  };
  const double rigid = find_energy("rigid").at("work").get<double>();
  const double expected = 4.0 / (2.0 * mass);
  EXPECT_NEAR(rigid, expected, 1e-6 * expected);
  const json energy = find_energy("coupled");
  const double flexible = energy.at("work").get<double>();
  EXPECT_GT(flexible, 1.0005 * rigid);
  EXPECT_LT(flexible, 1.5 * rigid);
  EXPECT_LT(std::abs(energy.at("relative_drift").get<double>()), 1e-9);
}

TEST_F(Sections, SayWhatIsWrongWithTheirAttributes) {
  place_.write("line.geo",
               "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\n"
               "Line(1) = {1, 2};\nPhysical Curve(\"line\") = {1};\n");
  const auto expect_error = [&](const std::string& option,
                                const auto& matcher) {
    const CommandResult result =
        place_.limber("modes line.geo" + kSteel + option);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.errors, matcher) << option;
  };
  expect_error("--shell 'thickness=\"0\"'",
               AllOf(HasSubstr("--shell"), HasSubstr("thickness")));
  expect_error("--shell 'group=\"line\" thickness=\"0.1\"'",
               HasSubstr("a group of curves"));
  expect_error("--shell 'thicknes=\"0.1\"'", HasSubstr("thicknes"));
  expect_error("--shell 0.1", HasSubstr("expected attributes of <shell>"));
  expect_error("--beam 'section=\"round\"'", HasSubstr("tube, rectangle"));
  expect_error("--beam 'section=\"tube\" radius=\"0.1\"'",
               HasSubstr("needs 'wall'"));
  expect_error("--beam 'section=\"tube\" radius=\"0.1\" wall=\"0.2\"'",
               HasSubstr("give no section"));
  expect_error("--beam 'section=\"rectangle\" width=\"0.1\" height=\"0.2\"'",
               HasSubstr("y_axis"));
  place_.write("bad.urdf",
               "<robot name='bad'><link name='bad'/>\n<flexible link='bad'>\n"
               "<mesh file='line.geo'/>\n<material youngs_modulus='7e10' "
               "poisson_ratio='0.3' density='2700'/>\n<shell thickness='-1'/>\n"
               "</flexible></robot>\n");
  const CommandResult result = place_.limber("info bad.urdf");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("bad.urdf:5: <shell>"));
}

}  // namespace
}  // namespace limber::test::sections_test
