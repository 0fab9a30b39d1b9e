// SPDX-License-Identifier: BSD-3-Clause
// Errors by cause (`limber run --errors`), beside those that are known.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/command.hpp"
#include "cli/sled_study.hpp"
#include "places.hpp"

namespace limber::test::errors_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kPushed = R"(robot = 'robot.urdf'
[time]
duration = 3
step = 0.05
output_interval = 0.05
[output]
pictures = false
[[load]]
name = 'push'
link = 'sled'
force = [1, 0, 0]
[[probe]]
name = 'sled'
link = 'sled'
)";

json run_with_errors(const Workspace& place, const std::string& options) {
  const CommandResult result = place.limber("run " + options + " --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out)["errors"];
}

/// Rows of time and the columns of the only probe.
std::vector<std::array<double, 4>> read_rows(const Workspace& place,
                                             const std::string& folder) {
  std::istringstream table(read_text(place.folder() / folder / "probes.csv"));
  std::string line;
  std::getline(table, line);
  std::vector<std::array<double, 4>> rows;
  while (std::getline(table, line)) {
    char comma = 0;
    std::array<double, 4>& row = rows.emplace_back();
    std::istringstream(line) >> row[0] >> comma >> row[1] >> comma >> row[2] >>
        comma >> row[3];
  }
  return rows;
}

/// Largest error of the sled: x = F / k (1 - cos w t).
double find_true_error(const Workspace& place) {
  double error = 0.0;
  for (const auto& [t, x, y, z] : read_rows(place, "o")) {
    const double exact = 0.1 * (1.0 - std::cos(std::sqrt(10.0 / 3.0) * t));
    error = std::max(error, std::abs(x - exact));
  }
  return error;
}

TEST(Errors, OfTheStepAreThoseOfTheClosedForm) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", kPushed);
  for (const std::string step : {"0.1", "0.05", "0.025"}) {
    const json errors = run_with_errors(
        place, "s.toml --errors --out o --set time.step=" + step);
    const double stated =
        errors["probes"]["sled.ux"]["total"]["curve"].get<double>();
    const double exact = find_true_error(place);
    EXPECT_GT(exact, 1e-7);
    EXPECT_NEAR(stated / exact, 1.0, 0.2) << step;
    EXPECT_EQ(errors["probes"]["sled.ux"]["remedy"], "step");
    EXPECT_TRUE(errors["probes"]["sled.ux"]["adds_up"].is_null());
  }
}

TEST(Errors, AreAskedForByTheScenarioToo) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", kPushed);
  const json asked = run_with_errors(place, "s.toml --errors --out o");
  const json set =
      run_with_errors(place, "s.toml --out o --set output.errors=true");
  EXPECT_EQ(asked["probes"], set["probes"]);
  EXPECT_TRUE(run_with_errors(place, "s.toml --out o").is_null());
  EXPECT_THAT(place.limber("run s.toml --errors --out o").out,
              AllOf(HasSubstr("errors of curves"),
                    HasSubstr("half of the step"), HasSubstr("sled.ux")));
}

/// A bar of two modes in a coarse mesh, under a step of force at its tip.
class ABar : public ::testing::Test {
 protected:
  ABar() {
    place_.write("bar.geo",
                 "Point(1) = {0, -0.01, -0.01};\nl[] = Extrude {0, 0.02, 0} { "
                 "Point{1}; };\nr[] = Extrude {0, 0, 0.02} { Line{l[1]}; };\n"
                 "s[] = Extrude {0.3, 0, 0} { Surface{r[1]}; };\n"
                 "Physical Surface(\"root\") = {r[1]};\n"
                 "Physical Surface(\"tip\") = {s[0]};\n"
                 "Physical Volume(\"body\") = {s[1]};\n");
    place_.write("robot.urdf",
                 "<robot name='r'><link name='bar'/><flexible link='bar'>"
                 "<mesh file='bar.geo' size='0.03'/><material "
                 "youngs_modulus='7e10' poisson_ratio='0.3' density='2700'/>"
                 "<basis eigenmodes='2' interface_modes='false' "
                 "load_modes='false'/><clamp group='root'/>"
                 "<interface name='end' group='tip'/></flexible></robot>");
    place_.write("s.toml",
                 "robot = 'robot.urdf'\n[time]\nduration = 0.01\n"
                 "step = 1e-4\noutput_interval = 2e-4\n[output]\n"
                 "pictures = false\n[fidelity]\ndefault = 'uncoupled'\n"
                 "[[load]]\nname = 'push'\nlink = 'bar'\n"
                 "interface = 'end'\nforce = [0, 10, 0]\n"
                 "[[probe]]\nname = 'tip'\nlink = 'bar'\n"
                 "interface = 'end'\n");
  }

  Workspace place_;
};

TEST_F(ABar, HasErrorsOfItsModesAndOfItsMesh) {
  const json errors = run_with_errors(place_, "s.toml --errors --out o");
  const json& tip = errors["probes"]["tip.uy"];
  ASSERT_EQ(place_
                .limber("run s.toml --out fine --set time.step=1e-5 --set "
                        "robot.flexible.bar.mesh.size=0.01 --set "
                        "robot.flexible.bar.basis.eigenmodes=20 --set "
                        "robot.flexible.bar.basis.load_modes=true")
                .status,
            0);
  const auto rows = read_rows(place_, "o");
  const auto fine = read_rows(place_, "fine");
  ASSERT_EQ(rows.size(), fine.size());
  double exact = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    exact = std::max(exact, std::abs(rows[i][2] - fine[i][2]));
  }
  const double stated = tip["total"]["curve"].get<double>();
  EXPECT_LT(exact, 3.0 * stated);
  EXPECT_LT(stated, 10.0 * exact);
  EXPECT_GT(tip["by_cause"]["modes"]["curve"].get<double>(), 0.0);
  EXPECT_GT(tip["by_cause"]["mesh"]["curve"].get<double>(), 0.0);
}

TEST_F(ABar, OfASavedBodyTellsWhatNoRunCanShow) {
  ASSERT_EQ(place_
                .limber("reduce bar.geo --size 0.03 --youngs-modulus 7e10 "
                        "--poisson-ratio 0.3 --density 2700 --clamp root "
                        "--interface tip --modes 3 -o bar.h5")
                .status,
            0);
  place_.write("robot.urdf",
               "<robot name='r'><link name='bar'/><flexible link='bar'>"
               "<reduced file='bar.h5'/><clamp group='root'/>"
               "</flexible></robot>");
  std::string scene = read_text(place_.folder() / "s.toml");
  for (std::size_t at = 0; (at = scene.find("'end'")) != std::string::npos;) {
    scene.replace(at, 5, "'tip'");
  }
  place_.write("s.toml", scene);
  const json errors = run_with_errors(place_, "s.toml --errors --out o");
  EXPECT_THAT(errors["unknown"].dump(),
              HasSubstr("modes and mesh of link 'bar', a saved body"));
  EXPECT_FALSE(errors["probes"]["tip.uy"]["by_cause"].contains("mesh"));
}

}  // namespace
}  // namespace limber::test::errors_test
