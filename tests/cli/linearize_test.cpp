// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
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
using ::testing::Not;

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
  EXPECT_THAT(errors_, HasSubstr("the state at 0.5 s is not a steady motion"));
}

TEST_F(Linearize, RefusesWhatItCannotDoInOneClearError) {
  expect_refused("-o no.csv", "does not end in .mat");
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
  expect_refused("-o no.mat --states 13", "the model has only 12");
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

// The double integrator with a held force: poles of magnitude sqrt(1 + kp T^2 /
// (2 I)) at an angle of about T sqrt(kp / I), kp / I = 15 1/s^2.
TEST_F(Linearize, ClosesTheLoopsAsADiscreteModel) {
  const json model = read("--closed-loop");
  EXPECT_EQ(model["period"], json::parse("[[0.02]]"));
  EXPECT_THAT(model["input_names"].get<std::vector<std::string>>(),
              ElementsAre("spin", "pd.reference"));
  EXPECT_EQ(model["A"].size(), 17U);  // 12, the input, its slope, 3 of the law
  const double growth =
      0.5 * std::log1p(0.5 * 15.0 * 0.02 * 0.02) / 0.02 / std::log(10.0);
  EXPECT_THAT(errors_,
              HasSubstr(fmt::format("controller 'pd' (joint 'hinge', period "
                                    "0.02 s): the sampled loop is unstable at "
                                    "{:.3g} Hz, growing tenfold in {:.2g} s",
                                    std::sqrt(15.0) / (2.0 * std::acos(-1.0)),
                                    1.0 / growth)));
  EXPECT_THAT(out_, HasSubstr("from sample to sample: 17 states"));
  EXPECT_THAT(out_, Not(HasSubstr("open loops")));
  expect_refused("-o no.mat --closed-loop --states 4", "leave out");
  expect_refused("-o no.mat --closed-loop --inputs pd", "leave out");
}

TEST_F(Linearize, RefusesToCloseWhatIsNoLinearLoop) {
  const std::string text = kScenario;
  // Energies are quadratic in small motion.
  place_.write("s.toml",
               text +
                   "[[probe]]\nname = 'hinge_energy'\ncoupler = 'hinge'\n"
                   "quantity = 'energy'\n");
  expect_refused(
      "-o no.mat --closed-loop --set "
      "controller.pd.measures=hinge_energy.energy",
      "controller 'pd' cannot be in a linear closed loop: "
      "'hinge_energy.energy', which it measures, has no linear model");
  const std::string drive = text.substr(
      text.find("[[drive]]"), text.find("[[load]]") - text.find("[[drive]]"));
  std::string open = text;
  open.erase(open.find(drive), drive.size());
  open.erase(open.rfind("[[probe]]"));
  place_.write("s.toml", open);
  expect_refused("-o no.mat --closed-loop",
                 "a closed loop needs a [[controller]]; there is none");
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
