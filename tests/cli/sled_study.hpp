// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "cli/command.hpp"

/// A sled on a spring that is pushed, and a study of it.
namespace limber::test {

inline const char* const kRobot = R"(<robot name='r'><link name='world'/>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='0' velocity='0'/>
</joint>
<spring name='coil' stiffness='10' free_length='1'>
  <from link='world' point='-1 0 0'/><to link='sled'/></spring></robot>)";

inline const char* const kScenario = R"(robot = 'robot.urdf'
[time]
duration = 0.5
step = 1e-3
output_interval = 0.01
[initial.joints]
rail = { position = 0.1 }
[[load]]
name = 'push'
link = 'sled'
force = [1, 0, 0]
[[probe]]
name = 'sled'
link = 'sled'
)";

inline const char* const kStudy = R"(scenario = 's.toml'
[design]
kind = 'monte-carlo'
samples = 12
seed = 5
[[factor]]
name = 'force'
path = 'load.push.force.0'
uniform = [-2.0, 2.0]
[[factor]]
name = 'stiffness'
path = 'robot.spring.coil.stiffness'
log_range = [1.0, 100.0]
[[response]]
name = 'x'
probe = 'sled.ux'
[[response]]
name = 'when'
probe = 'sled.ux'
measure = 'time'
[[response]]
name = 'last'
probe = 'sled.ux'
measure = 'final'
[[response]]
name = 'size'
probe = 'sled.ux'
measure = 'rms'
[[response]]
name = 'work'
summary = 'energy.work'
[[response]]
name = 'per_force'
expression = 'x / force'
)";

inline std::string replace(std::string text, const std::string& old,
                           const std::string& by) {
  EXPECT_NE(text.find(old), std::string::npos) << old;
  return text.replace(text.find(old), old.size(), by);
}

class AStudy : public ::testing::Test {
 protected:
  AStudy() {
    place_.write("robot.urdf", kRobot);
    place_.write("s.toml", kScenario);
    place_.write("study.toml", kStudy);
  }

  [[nodiscard]] std::string run(const std::string& options) const {
    const CommandResult result = place_.limber("study " + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.out;
  }

  [[nodiscard]] std::string table(const std::string& folder) const {
    return read_text(place_.folder() / folder / "study.csv");
  }

  void expect_refused(const std::string& options,
                      const std::string& words) const {
    const CommandResult result = place_.limber("study " + options);
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_THAT(result.errors, ::testing::HasSubstr(words));
  }

  Workspace place_;
};

}  // namespace limber::test
