// SPDX-License-Identifier: BSD-3-Clause
// Runs with many outputs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "places.hpp"

namespace limber::test::long_run_test {
namespace {

constexpr int kSleds = 6;

/// Of sleds on a rail each, with a load.
void write_scene(const Workspace& place) {
  std::string robot = "<robot name='r'><link name='world'/>";
  std::string scenario =
      "robot = 'robot.urdf'\n[time]\nduration = 1\nstep = 1e-3\n"
      "output_interval = 1e-3\n[output]\npictures = false\n";
  for (int i = 0; i < kSleds; ++i) {
    robot += fmt::format(
        "<link name='l{0}'><inertial><mass value='3'/><inertia ixx='0.1' "
        "iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        "<joint name='j{0}' type='prismatic'><parent link='world'/>"
        "<child link='l{0}'/><origin xyz='0 {0} 0'/><axis xyz='1 0 0'/>"
        "<dynamics damping='0.1'/>"
        "<limit lower='-9' upper='9' effort='0' velocity='0'/></joint>",
        i);
    scenario += fmt::format(
        "[[load]]\nname = 'f{0}'\nlink = 'l{0}'\nforce = [1, 0, 0]\n"
        "time = {{ kind = 'sinusoid', frequency = {1} }}\n"
        "[[probe]]\nname = 'p{0}'\nlink = 'l{0}'\n",
        i, i + 1);
  }
  place.write("robot.urdf", robot + "</robot>");
  place.write("s.toml", scenario);
}

/// Largest memory of a run [bytes].
double measure(const Workspace& place, const std::string& arguments) {
  const pid_t child = fork();
  if (child == 0) {
    const CommandResult result =
        run_shell(place, "limber run s.toml " + arguments);
    rusage used = {};
    getrusage(RUSAGE_CHILDREN, &used);
    // In units that an exit status can hold.
    const long units = std::min(used.ru_maxrss / 4096, 255L);
    _exit(result.status == 0 ? static_cast<int>(units) : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? 4.0 * 1024 * 1024 * WEXITSTATUS(status) : 0.0;
}

TEST(RunOfManyOutputs, TakesNoMoreMemoryThanOneOfFew) {
  const Workspace place;
  write_scene(place);
  const double few = measure(place, "--out few");
  const double many = measure(
      place, "--out many --set time.step=4e-5 --set time.output_interval=4e-5");
  ASSERT_GT(few, 0.0);
  ASSERT_GT(many, 0.0);
  // The outputs are 62 MB, of which the times are in memory. Sanitizers keep
  // what was freed.
  if (!kIsSanitized) {
    EXPECT_LT(many, few + 30e6);
  }
  const Hdf5File in = Hdf5File::open(place.folder() / "many/results.h5");
  EXPECT_EQ(in.read_matrix("time").rows(), 25001);
}

}  // namespace
}  // namespace limber::test::long_run_test
