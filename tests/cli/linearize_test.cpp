// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"

/// `limber linearize`. What is in its files: read_linear_model.py.
namespace limber::test::linearize_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kRobot = R"(<robot name='r'><link name='world'/>
<link name='rotor'><inertial><mass value='2'/><inertia ixx='0.3' iyy='0.3'
  izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='hinge' type='continuous'><parent link='world'/>
  <child link='rotor'/><axis xyz='0 0 1'/></joint></robot>)";

const char* const kScenario = R"(robot = 'robot.urdf'
[time]
duration = 1.0
step = 0.001
[output]
pictures = false
[[drive]]
name = 'motor'
joint = 'hinge'
mode = 'effort'
signal = { kind = 'input', controller = 'pd', factor = 2 }
[[controller]]
name = 'pd'
period = 0.02
measures = 'angle.q'
proportional = 3.0
[[load]]
name = 'spin'
link = 'rotor'
moment = [0.0, 0.0, 0.8]
[[probe]]
name = 'angle'
coupler = 'hinge'
quantity = 'coordinate'
[[probe]]
name = 'torque'
controller = 'pd'
)";

class Linearize : public ::testing::Test {
 protected:
  Linearize() {
    place_.write("robot.urdf", kRobot);
    place_.write("s.toml", kScenario);
  }

  json read(const std::string& options = "") {
    const CommandResult r =
        place_.limber("linearize s.toml -o m.json " + options);
    EXPECT_EQ(r.status, 0) << r.errors;
    out_ = r.out;
    errors_ = r.errors;
    return json::parse(read_text(place_.folder() / "m.json"), nullptr, false);
  }

  void expect_refused(const std::string& options, const std::string& words) {
    const CommandResult r = place_.limber("linearize s.toml " + options);
    EXPECT_EQ(r.status, 2) << options;
    EXPECT_THAT(r.errors, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(place_.folder() / "no.mat"));
  }

  Workspace place_;
  std::string out_;
  std::string errors_;
};

TEST_F(Linearize, TellsThatControllersAreOpenLoopsWhoseInputsAreInputs) {
  const json model = read();
  EXPECT_THAT(out_, AllOf(HasSubstr("open loops: pd is not in it"),
                          HasSubstr("12 states, 2 of them of free motion")));
  EXPECT_THAT(model["input_names"].get<std::vector<std::string>>(),
              ElementsAre("spin", "pd"));
  EXPECT_THAT(model["output_names"].get<std::vector<std::string>>(),
              ElementsAre("angle.q", "torque.u"));
  EXPECT_EQ(model["D"], json::parse("[[0.0, 0.0], [0.0, 1.0]]"));
  EXPECT_EQ(model["u0"], json::parse("[[1.0], [0.0]]"));
  // C A B: the acceleration of the hinge by the load, and by the controller.
  double gains[2] = {0.0, 0.0};
  for (std::size_t u : {0, 1}) {
    for (std::size_t i = 0; i < 12; ++i) {
      for (std::size_t k = 0; k < 12; ++k) {
        gains[u] += model["C"][0][i].get<double>() *
                    model["A"][i][k].get<double>() *
                    model["B"][k][u].get<double>();
      }
    }
  }
  EXPECT_NEAR(gains[0], 0.8 / 0.4, 1e-9);
  EXPECT_NEAR(gains[1], 2.0 / 0.4, 1e-9);
}

TEST_F(Linearize, SelectsInputsAndOutputsByName) {
  const json model = read("--inputs pd --outputs angle");
  EXPECT_EQ(model["input_names"], json::parse("[\"pd\"]"));
  EXPECT_EQ(model["output_names"], json::parse("[\"angle.q\"]"));
}

TEST_F(Linearize, IsAboutTheStateOfARunAtATime) {
  const json model = read("--at 0.5 --set controller.pd.proportional=1e-9");
  EXPECT_EQ(model["time"], json::parse("[[0.5]]"));
  EXPECT_NEAR(model["y0"][0][0].get<double>(), 0.5 * 2.0 * 0.25, 1e-6);
  EXPECT_THAT(errors_, HasSubstr("the state at 0.5 s is no steady motion"));
}

TEST_F(Linearize, RefusesWhatItCannotDoInOneClearError) {
  expect_refused("-o no.csv", "ends in none of .mat");
  expect_refused("-o no.mat --at later", "about 'later': expected 'start'");
  expect_refused("-o no.mat --at 2", "the run goes from 0 s to 1 s");
  expect_refused("-o no.mat --inputs motor", "unknown input 'motor'");
  expect_refused("-o no.mat --outputs angel.q", "angle.q");
  expect_refused("-o no.mat --inputs pd,", "'pd,' has an empty value");
  expect_refused("-o no.mat --inputs ''", "'' has an empty value");
  expect_refused("-o no.mat --outputs ,angle", "',angle' has an empty value");
  expect_refused("-o no.mat --outputs angle,,torque", "an empty value");
  expect_refused("-o no.mat --fidelity ''", "unknown fidelity ''");
  expect_refused("-o no.mat --states 1", "do not decay");
  expect_refused("-o no.mat --states 13", "the model has 12");
  expect_refused("-o no.mat --set controller.pd.gain=1", "gain");
  expect_refused("-o none/no.mat", "none/no.mat");
}

TEST_F(Linearize, TellsAFullDiskForEveryKindOfFile) {
  for (const std::string ending : {"mat", "npz", "json"}) {
    const std::string name = "full." + ending;
    std::filesystem::create_symlink("/dev/full", place_.folder() / name);
    expect_refused("-o " + name, "is the disk full");
  }
}

TEST_F(Linearize, ReducesToTheStatesThatMatter) {
  const json model = read("--states 12 --inputs pd --outputs angle");
  EXPECT_EQ(model["A"].size(), 2U);  // of free motion: springs at rest stay so
  EXPECT_THAT(errors_, HasSubstr("the model has 2 states in place of 12"));
  EXPECT_EQ(model["state_names"], json::parse("[\"kept1\", \"kept2\"]"));
  EXPECT_NEAR(model["error_bound"][0][0].get<double>(), 0.0, 1e-9);
}

}  // namespace
}  // namespace limber::test::linearize_test
