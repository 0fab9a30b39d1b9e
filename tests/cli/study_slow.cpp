// SPDX-License-Identifier: BSD-3-Clause
// A study of struck arms that is killed again and again.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::study_slow {
namespace {

using Clock = std::chrono::steady_clock;

const char* const kStudy =
    "scenario = '" LIMBER_SOURCE_DIR
    "/examples/struck_finger.toml'\nunset = ['time.steps']\n"
    "set = ['time.duration=0.004', 'time.step=1e-4']\n"
    "[design]\nkind = 'latin-hypercube'\nsamples = 300\nseed = 3\n"
    "[[factor]]\nname = 'force'\npath = 'load.strike.force.2'\n"
    "uniform = [-200.0, -50.0]\n"
    "[[factor]]\nname = 'duration'\npath = 'load.strike.time.duration'\n"
    "log_range = [0.002, 0.02]\n"
    "[[factor]]\nname = 'brake'\n"
    "path = 'robot.bushing.elbow_1_brake.rotational_stiffness.1'\n"
    "log_range = [500.0, 8000.0]\n"
    "[[response]]\nname = 'bending'\nprobe = 'elbow_1_bending.dz'\n"
    "[[response]]\nname = 'turn'\nprobe = 'base_turn.ry'\nmeasure = 'final'\n";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Where a kill hits is random: in loading, stepping, writing.
TEST(AStudyOfStruckArms, KilledAtTenRandomMomentsHasTheSameTableToTheBit) {
  const Workspace place;
  place.write("study.toml", kStudy);
  ASSERT_EQ(place
                .limber("run " LIMBER_SOURCE_DIR
                        "/examples/struck_finger.toml --unset time.steps "
                        "--set time.duration=0.001 --set time.step=1e-4 "
                        "--out r")
                .status,
            0);  // the bodies
  const Clock::time_point start = Clock::now();
  ASSERT_EQ(place.limber("study study.toml --out whole --csv --jobs 2").status,
            0);
  const double whole = seconds_since(start);

  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0.02, 0.16);
  int killed = 0;
  for (int i = 0; i < 10; ++i) {
    RunningCommand study(place, "study study.toml --out a --jobs 2");
    std::this_thread::sleep_for(
        std::chrono::duration<double>(share(random) * whole));
    study.send(SIGKILL);
    killed += study.wait().status == -1 ? 1 : 0;
  }
  EXPECT_GE(killed, 5) << "the machine became too fast to be hit";
  ASSERT_EQ(place.limber("study study.toml --out a --csv --jobs 2").status, 0);
  const std::string table = read_text(place.folder() / "a/study.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 301);
  EXPECT_EQ(table, read_text(place.folder() / "whole/study.csv"));
}

}  // namespace
}  // namespace limber::test::study_slow
