// SPDX-License-Identifier: BSD-3-Clause
// Lengths of geometries in the unit that their file states, and questions about
// values that hardly anyone means.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::unit_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kBoxMass = 0.1 * 0.04 * 0.02 * 8000.0;  // [kg]
const std::string kSteel =
    " --youngs-modulus 200e9 --poisson-ratio 0.3 --density 8000 --count 1";

/// The box of 100 x 40 x 20, of which the file says that its unit is this one.
std::string make_step(const std::string& unit) {
  std::string text =
      read_text(LIMBER_SOURCE_DIR "/tests/data/units/box_mm.step");
  const std::string metre = "SI_UNIT(.MILLI.,.METRE.)";
  text.replace(text.find(metre), metre.size(), unit);
  return text;
}

nlohmann::json read_modes(const Workspace& place, const std::string& size) {
  const CommandResult result =
      place.limber("modes box.step --json --size " + size + kSteel);
  EXPECT_EQ(result.status, 0) << result.errors;
  return nlohmann::json::parse(result.out);
}

TEST(Units, OfAStepFileAreThoseThatItStates) {
  const Workspace place;
  place.write("box.step", make_step("SI_UNIT(.MILLI.,.METRE.)"));
  const nlohmann::json box = read_modes(place, "20");
  EXPECT_NEAR(box["mass"].get<double>(), kBoxMass, 1e-12);
  EXPECT_NEAR(box["size"][0].get<double>(), 0.1, 1e-12);
  place.write("box.step", make_step("SI_UNIT(.CENTI.,.METRE.)"));
  EXPECT_NEAR(read_modes(place, "200")["mass"].get<double>(), 1e3 * kBoxMass,
              1e-9);
}

TEST(Units, OfAStepFileGivenOtherwiseAreToldAsSuch) {
  const Workspace place;
  place.write("box.step", make_step("SI_UNIT(.MILLI.,.METRE.)"));
  const CommandResult result =
      place.limber("modes box.step --size 20 --unit m" + kSteel);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("1000 times as large as its file says"),
                    HasSubstr("6.4e+08 kg; is its length unit right")));
  const CommandResult same =
      place.limber("modes box.step --size 20 --unit mm" + kSteel);
  EXPECT_EQ(same.errors, "");
}

TEST(Units, OfAMeshHaveNames) {
  const Workspace place;
  const auto find_length = [&](const std::string& unit) {
    const CommandResult result = place.limber(
        "info " LIMBER_SOURCE_DIR "/meshes/beam579.msh --json --unit " + unit);
    EXPECT_EQ(result.status, 0) << result.errors;
    return nlohmann::json::parse(result.out)["size"][0].get<double>();
  };
  const double length = find_length("m");
  EXPECT_NEAR(find_length("in"), 0.0254 * length, 1e-12);
  EXPECT_NEAR(find_length("0.001"), find_length("mm"), 1e-15);
  const CommandResult wrong =
      place.limber("info " LIMBER_SOURCE_DIR "/meshes/beam579.msh --unit inch");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors,
              AllOf(HasSubstr("--unit is 'inch'"), HasSubstr("mm, in, ft")));
}

TEST(Units, AnElementSizeFarBelowThePartIsRefusedAtOnce) {
  const Workspace place;
  place.write("box.step", make_step("SI_UNIT(.MILLI.,.METRE.)"));
  const CommandResult result = place.limber(
      "modes box.step --youngs-modulus 2e11 --poisson-ratio 0.3 --density 8000 "
      "--size 0.02");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("5000 times smaller than the part"),
                    HasSubstr("A size of 2 is usual")));
}

void write_arm(const Workspace& place, const std::string& modulus,
               const std::string& scenario, double stop) {
  place.write(
      "arm.urdf",
      fmt::format(
          "<robot name='r'><link name='base'><inertial><mass value='1'/>"
          "<inertia ixx='1e-3' iyy='1e-3' izz='1e-3' ixy='0' ixz='0' iyz='0'/>"
          "</inertial></link><link name='arm'/>"
          "<joint name='elbow' type='revolute'><parent link='base'/>"
          "<child link='arm'/><axis xyz='0 1 0'/>"
          "<limit lower='-{0}' upper='{0}' effort='1' velocity='1'/></joint>"
          "<flexible link='arm'><mesh file='{1}'/>"
          "<material youngs_modulus='{2}' poisson_ratio='0' density='8000'/>"
          "<basis eigenmodes='1'/><attach joint='elbow' interface='root'/>"
          "<interface name='root' plane_point='0 0 0' plane_normal='0 0 "
          "1'/></flexible></robot>\n",
          stop, LIMBER_SOURCE_DIR "/meshes/beam579.msh", modulus));
  place.write("arm.toml",
              "robot = \"arm.urdf\"\n[time]\nduration = 0.002\n"
              "step = 0.001\n" +
                  scenario);
}

TEST(Units, ThatAreDoubtfulAreQuestioned) {
  const Workspace place;
  write_arm(place, "200e3",
            "[gravity]\nacceleration = [0, 0, -9810]\n"
            "[initial.joints]\nelbow = { position = 90 }\n",
            100.0);
  const CommandResult result = place.limber("run arm.toml");
  EXPECT_THAT(result.errors, HasSubstr("is it in Pa (steel: 2.1e11)?"));
  EXPECT_THAT(result.errors, HasSubstr("starts at 90 rad, 14.3 turns"));
  EXPECT_THAT(result.errors, HasSubstr("gravity is 9810 m/s^2"));
}

TEST(Units, ThatAreUsualAreNotQuestioned) {
  const Workspace place;
  write_arm(place, "200e9",
            "[gravity]\nacceleration = [0, 0, -9.81]\n"
            "[initial.joints]\nelbow = { position = 1.5 }\n",
            12.0);
  const CommandResult result = place.limber("run arm.toml");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, Not(HasSubstr("?")));
}

TEST(Info, HasTheMassesOfFlexibleLinksAndOfTheWholeRobot) {
  const Workspace place;
  write_arm(place, "200e9", "", 12.0);
  const CommandResult result = place.limber("info arm.urdf --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const nlohmann::json robot = nlohmann::json::parse(result.out);
  const nlohmann::json body = nlohmann::json::parse(
      place
          .limber("modes " LIMBER_SOURCE_DIR
                  "/meshes/beam579.msh --json --count 1 --youngs-modulus 2e11 "
                  "--poisson-ratio 0 --density 8000")
          .out);
  const double arm = body["mass"].get<double>();
  EXPECT_NEAR(robot["links"][1]["mass"].get<double>(), arm, 1e-12 * arm);
  EXPECT_NEAR(robot["mass"].get<double>(), 1.0 + arm, 1e-12 * (1.0 + arm));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(robot["center_of_mass"][i].get<double>(),
                arm / (1.0 + arm) * body["center_of_mass"][i].get<double>(),
                1e-12);
  }
}

}  // namespace
}  // namespace limber::test::unit_test
