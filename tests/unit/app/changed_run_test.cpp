// SPDX-License-Identifier: BSD-3-Clause
// Whatever is changed in a scenario or its robot between a run and the run that
// goes on from its checkpoint: it is another run and says so, or the change
// changes no bit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

#include "app/reducer.hpp"
#include "app/run_manifest.hpp"
#include "common/errors.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::app {
namespace {

using scene::BuiltScene;
using scene::Scene;
using scene::test::SceneFolder;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const kRobot = R"(
<link name='world'/>
<link name='arm'/>
<link name='hand'><inertial><origin xyz='0.1 0.02 0.3' rpy='0 0 0.2'/>
  <mass value='4'/><inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0.01' ixz='0'
  iyz='0'/></inertial></link>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='wheel'><inertial><mass value='2'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='follower'><inertial><mass value='2'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='shoulder' type='revolute'><parent link='world'/>
  <child link='arm'/><origin xyz='0.5 0.5 0' rpy='0 0.1 0'/><axis xyz='0 1 0'/>
  <limit lower='-0.5' upper='0.6' effort='900' velocity='9'/>
  <dynamics damping='0.3' friction='0.1'/></joint>
<joint name='wrist' type='revolute'><parent link='arm'/><child link='hand'/>
  <origin xyz='0.5 0.5 5' rpy='0 0 0'/><axis xyz='0 1 0'/>
  <limit lower='-1' upper='1' effort='0' velocity='0'/></joint>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <origin xyz='3 0 0'/><axis xyz='1 0 0'/>
  <limit lower='-2' upper='2' effort='500' velocity='5'/></joint>
<joint name='axle' type='continuous'><parent link='world'/>
  <child link='wheel'/><origin xyz='6 0 0'/><axis xyz='0 0 1'/></joint>
<joint name='mate' type='continuous'><parent link='world'/>
  <child link='follower'/><origin xyz='6 3 0'/><axis xyz='0 0 1'/></joint>
<flexible link='arm'>
  <mesh file='BOX' size='1.2' order='2' unit='1'/>
  <material youngs_modulus='7e8' poisson_ratio='0.3' density='20'/>
  <damping ratio='0.02'/>
  <basis eigenmodes='3' terms='1' interface_modes='true'/>
  <interface name='root' group='root'/>
  <interface name='tip' group='tip' weighting='uniform'/>
  <attach joint='shoulder' interface='root'/>
  <attach joint='wrist' interface='tip'/>
</flexible>
<coupler joint='shoulder' translational_stiffness='1e6'
  rotational_stiffness='2e6' translational_damping='100'
  rotational_damping='200'>
  <spring stiffness='10' quadratic='2' damping='0.5' rest='0.1'/>
  <stop stiffness='800' restitution='0.4' speed='1.5'/>
  <friction coulomb='0.2' viscous='0.1' speed='0.01'/>
</coupler>
<coupler joint='wrist' translational_stiffness='1e6'
  rotational_stiffness='1e6' free_damping='0.2'>
  <spring table='-1 -8 0 0 1 9'/>
</coupler>
<coupler joint='rail' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<coupler joint='axle' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<coupler joint='mate' translational_stiffness='1e6'
  rotational_stiffness='1e6'/>
<spring name='line' stiffness='50' damping='1' free_length='0.9'
  quadratic='3' tension_only='true'>
  <from link='world' point='3 1 0.2'/><to link='sled' point='0 0.1 0'/></spring>
<bushing name='mount' translational_stiffness='30 40 50'
  rotational_stiffness='3' translational_damping='0.2' rotational_damping='0.1'>
  <from link='world' point='3.1 0 -1'/><to link='sled' point='0 0 -1'/></bushing>
<latch name='hook' reach='0.3' translational_stiffness='2e4'
  rotational_stiffness='20' translational_damping='20' rotational_damping='0.1'
  release_force='4000' release_time='0.9'>
  <from link='world' point='4.4 0 0'/><to link='sled' point='1 0 0'/></latch>
<tendon name='rope' stiffness='400' damping='2' free_length='5'>
  <via link='world' point='0 0 1'/><via link='arm' interface='tip'/>
  <via link='hand' point='0.1 0 0.5'/></tendon>
<gear name='teeth' joint='axle' with='mate' ratio='-2' offset='0.1'
  stiffness='300' damping='1'/>
)";

const char* const kScenario = R"(
[time]
duration = 0.02
step = 1e-3
output_interval = 2e-3
rho_inf = 0.8
newton_tolerance = 1e-11
newton_iterations = 30
integrator = "generalized-alpha"
exact_modes = true

[fidelity]
default = "coupled"
links = { arm = "coupled" }

[full]
law = "st-venant-kirchhoff"
mass = "consistent"

[basis]
eigenmodes = 4

[gravity]
acceleration = [0.0, 0.3, -9.81]

[initial.joints]
shoulder = { position = 0.05, velocity = 0.4 }
rail = { position = 0.1, velocity = 2.0 }
axle = { velocity = 3.0 }

[initial.links]
arm = { modes = { position = [0.001], velocity = [0.1] } }

[[load]]
name = "push"
link = "hand"
point = [0.1, 0.0, 0.2]
force = [10.0, 0.0, -5.0]
moment = [0.1, 0.2, 0.3]
frame = "world"
time = { kind = "sinusoid", frequency = 3.0, phase = 0.2, from = 0.1, until = 9 }

[[load]]
name = "strike"
link = "arm"
interface = "tip"
force = [0.0, 20.0, 0.0]
time = { kind = "pulse", shape = "half-sine", start = 0.5, duration = 0.1 }

[[load]]
name = "sequence"
link = "sled"
force = [0.0, 1.0, 0.0]
time = { kind = "steps", times = [0.3, 0.4], values = [1.0, 0.5] }

[[load]]
name = "measured"
link = "sled"
force = [0.0, 0.0, 1.0]
time = { kind = "table", times = [0.3, 0.4], values = [1.0, 0.5] }

[[load]]
name = "waves"
link = "wheel"
moment = [0.0, 0.0, 1.0]
time = { kind = "sinusoids", frequencies = [2, 5], amplitudes = [1, 0.5], phases = [0.1, 0.3], mean = 0.2 }

[[drive]]
name = "motor"
joint = "shoulder"
mode = "position"
stiffness = 100.0
damping = 3.0
max_effort = 800.0
max_speed = 8.0
signal = { kind = "ramp", from = 0.05, to = 0.2, start = 0.1, duration = 0.8, shape = "trapezoid", rise = 0.3 }
shaper = { kind = "zv", frequency = 4.0, damping_ratio = 0.1 }

[[drive]]
joint = "rail"
mode = "effort"
signal = { kind = "sine", mean = 1.0, amplitude = 2.0, frequency = 7.0, phase = 0.1, start = 0.2 }

[[drive]]
tendon = "rope"
mode = "effort"
signal = { kind = "table", times = [0.1, 0.5], values = [3.0, 4.0] }

[[release]]
latch = "hook"
time = 0.7

[[probe]]
name = "tip"
link = "arm"
interface = "tip"
quantity = "displacement"

[[probe]]
name = "grip"
link = "hand"
point = [0.1, 0.0, 0.3]
quantity = "velocity"

[[probe]]
name = "knee"
coupler = "wrist"
quantity = "force"
side = "M"
frame = "F"

[advice]
displacement = 1e-6

[output]
folder = "here"
pictures = true
checkpoint_interval = 60
)";

std::string robot_text() {
  std::string text = kRobot;
  const std::string box = LIMBER_SOURCE_DIR "/meshes/box/box.geo";
  return text.replace(text.find("BOX"), 3, box);
}

/// A place in a text, and what may stand there instead: the first that can be
/// built counts.
struct Change {
  std::size_t at = 0;
  std::size_t length = 0;
  std::vector<std::string> by;
};

bool is_start_of_number(const std::string& text, std::size_t i) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           c == '.' || c == '-';
  };
  const bool has_digit =
      std::isdigit(static_cast<unsigned char>(text[i])) != 0 ||
      (text[i] == '-' &&
       std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0);
  return has_digit && !is_part(text[i - 1]);
}

/// Every number, a little different.
std::vector<Change> find_numbers(const std::string& text) {
  std::vector<Change> changes;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (!is_start_of_number(text, i)) continue;
    const std::size_t end = text.find_first_not_of("0123456789.e+-", i);
    const std::string word = text.substr(i, end - i);
    const double value = std::stod(word);
    Change change{i, word.size(), {}};
    if (word.find_first_of(".e") == std::string::npos) {
      const int whole = static_cast<int>(value);
      change.by = {std::to_string(whole + 1), std::to_string(whole - 1)};
    }
    for (const double factor : {1.25, 0.8}) {
      if (value == 0.0) break;
      change.by.push_back(fmt::format("{:.6e}", value * factor));
    }
    change.by.push_back(fmt::format("{:.6e}", value + 0.05));
    changes.push_back(change);
    i = end;
  }
  return changes;
}

/// Words that have others in their place.
std::vector<Change> find_words(const std::string& text) {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"'true'", "'false'"},
      {"= true", "= false"},
      {"\"generalized-alpha\"", "\"implicit-euler\""},
      {"\"coupled\"", "\"one-way\""},
      {"\"st-venant-kirchhoff\"", "\"neo-hookean\""},
      {"\"consistent\"", "\"lumped\""},
      {"\"world\"", "\"body\""},
      {"\"half-sine\"", "\"triangular\""},
      {"\"trapezoid\"", "\"smooth\""},
      {"kind = \"table\"", "kind = \"steps\""},
      {"\"zv\"", "\"zvd\""},
      {"\"displacement\"", "\"position\""},
      {"\"velocity\"", "\"position\""},
      {"\"force\"", "\"moment\""},
      {"side = \"M\"", "side = \"F\""},
      {"frame = \"F\"", "frame = \"world\""},
      {"coupler = \"wrist\"", "coupler = \"shoulder\""},
      {"name = \"tip\"", "name = \"top\""},
      {"\"push\"", "\"pull\""},
      {"interface = \"tip\"", "interface = \"root\""},
      {"link = \"hand\"", "link = \"sled\""},
      {"\"here\"", "\"there\""},
      {"type='revolute'", "type='continuous'"},
      {"'uniform'", "'equal'"},
      {"interface='tip'/>\n  <via", "interface='root'/>\n  <via"},
      {"<friction coulomb", "<!-- a note --><friction coulomb"},
      {"[gravity]", "# a note\n[gravity]"}};
  std::vector<Change> changes;
  for (const auto& [old, by] : pairs) {
    for (std::size_t at = text.find(old); at != std::string::npos;
         at = text.find(old, at + 1)) {
      changes.push_back({at, old.size(), {by}});
    }
  }
  return changes;
}

class ChangedRun : public ::testing::Test {
 protected:
  struct Built {
    BuiltScene scene;
    Manifest manifest;
  };

  Built build(const std::string& robot, const std::string& scenario) {
    const Scene scene = folder_.load(robot, scenario);
    Built built{
        scene::build_system(scene, make_reducer({}), folder_.path() / "cache"),
        {}};
    built.manifest = make_manifest(scene, built.scene);
    return built;
  }

  /// All numbers that a run leaves at its outputs.
  static std::vector<double> run(const BuiltScene& built) {
    std::vector<double> numbers;
    dynamics::SystemState state = built.initial;
    dynamics::simulate(built.model, state, built.settings,
                       [&](const dynamics::SystemState& now,
                           const dynamics::EnergyBalance& energy) {
                         const auto row = scene::evaluate_all(built.probes,
                                                              built.model, now);
                         numbers.insert(numbers.end(), row.begin(), row.end());
                         numbers.push_back(energy.total());
                         numbers.push_back(energy.work);
                       });
    return numbers;
  }

  /// @returns what is told, empty if the change changes nothing
  std::vector<std::string> expect_told(const Built& before, const Built& now,
                                       const std::string& what) {
    auto differences = find_differences(before.manifest, now.manifest);
    if (differences.empty()) {
      silent_.push_back(what);
      EXPECT_EQ(run(before.scene), run(now.scene)) << what;
    }
    return differences;
  }

  template <typename Build>
  void expect_all_told(const std::string& text,
                       const std::vector<Change>& changes,
                       const Build& build_changed) {
    const Built before = build_changed(text);
    int tried = 0;
    for (const Change& change : changes) {
      for (const std::string& by : change.by) {
        std::string changed = text;
        changed.replace(change.at, change.length, by);
        try {
          const Built now = build_changed(changed);
          const std::size_t begin = text.rfind('\n', change.at - 30) + 1;
          expect_told(before, now, text.substr(begin, change.at - begin) + by);
        } catch (const InputError&) {
          continue;  // refused by the reader
        }
        ++tried;
        break;
      }
    }
    EXPECT_GT(tried, 0.8 * static_cast<double>(changes.size()));
  }

  std::vector<std::string> silent_;  // changes that change nothing

 private:
  SceneFolder folder_;
};

TEST_F(ChangedRun, OfTheSameFilesIsTheSameRun) {
  const Built one = build(robot_text(), kScenario);
  const Built other = build(robot_text(), kScenario);
  EXPECT_THAT(find_differences(one.manifest, other.manifest), IsEmpty());
}

TEST_F(ChangedRun, IsNamedForEveryNumberOfTheScenario) {
  expect_all_told(kScenario, find_numbers(kScenario),
                  [&](const std::string& t) { return build(robot_text(), t); });
  EXPECT_THAT(silent_,
              ElementsAre(HasSubstr("[advice]"), HasSubstr("checkpoint_")));
}

TEST_F(ChangedRun, IsNamedForEveryWordOfTheScenario) {
  expect_all_told(kScenario, find_words(kScenario),
                  [&](const std::string& t) { return build(robot_text(), t); });
}

TEST_F(ChangedRun, IsNamedForEveryNumberAndWordOfTheRobot) {
  std::vector<Change> changes = find_numbers(robot_text());
  const std::vector<Change> words = find_words(robot_text());
  changes.insert(changes.end(), words.begin(), words.end());
  expect_all_told(robot_text(), changes,
                  [&](const std::string& t) { return build(t, kScenario); });
}

TEST_F(ChangedRun, NamesTheCouplerAndItsOldAndNewStiffness) {
  std::string robot = robot_text();
  const Built before = build(robot, kScenario);
  const std::string old = "<spring stiffness='10'";
  robot.replace(robot.find(old), old.size(), "<spring stiffness='100'");
  EXPECT_THAT(
      find_differences(before.manifest, build(robot, kScenario).manifest),
      Contains("coupler 'shoulder', joint, element 1, spring, stiffness: "
               "10 -> 100 N/m, N m/rad"));
}

}  // namespace
}  // namespace limber::app
