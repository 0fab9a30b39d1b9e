// SPDX-License-Identifier: BSD-3-Clause
// Signals and two commands at once.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::signal_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A pendulum over so many steps of 10 microseconds.
void write_pendulum(const Workspace& place, double duration) {
  place.write("r.urdf",
              "<robot name='r'><link name='world'/><link name='arm'><inertial>"
              "<origin xyz='1 0 0'/><mass value='1'/><inertia ixx='1' iyy='1' "
              "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint "
              "name='j' type='continuous'><parent link='world'/><child "
              "link='arm'/><axis xyz='0 1 0'/></joint></robot>");
  place.write(
      "s.toml",
      fmt::format(
          "robot = 'r.urdf'\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
          "[time]\nduration = {}\nstep = 1e-5\n"
          "output_interval = 0.01\n"
          "[output]\npictures = false\n"
          "[[probe]]\nname = 'p'\nlink = 'arm'\n"
          "point = [1.0, 0.0, 0.0]\n",
          duration));
}

// Long enough not to end before the signal.
constexpr double kLong = 1000.0;

void let_it_work() { std::this_thread::sleep_for(seconds(1)); }

TEST(Signal, EndsARunWithItsResultsAndACheckpoint) {
  for (const auto& [signal, status] :
       {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    const Workspace place;
    write_pendulum(place, kLong);
    RunningCommand run(place, "run s.toml --out o");
    ASSERT_TRUE(wait_for(place, "o/.limber-lock"));
    let_it_work();
    run.send(signal);
    const CommandResult result = run.wait();
    EXPECT_EQ(result.status, status);
    EXPECT_THAT(result.errors,
                AllOf(HasSubstr("interrupted at t = "), HasSubstr("'o'"),
                      HasSubstr(signal == SIGINT ? "SIGINT" : "SIGTERM"),
                      HasSubstr("--resume")));
    EXPECT_TRUE(fs::exists(place.folder() / "o/checkpoint.bin"));
    EXPECT_FALSE(fs::exists(place.folder() / "o/.limber-lock"));
    const auto summary = nlohmann::json::parse(
        read_text(place.folder() / "o/summary.json"), nullptr, false);
    ASSERT_TRUE(summary.is_object());
    EXPECT_EQ(summary["completed"], false);
    EXPECT_GT(summary["steps"], 0);
  }
}

// timeout(1) signals the program, then its process group.
TEST(Signal, ThatComesTwiceAtOnceIsOne) {
  const Workspace place;
  write_pendulum(place, kLong);
  const CommandResult result =
      run_shell(place, "timeout -s INT 3 '" LIMBER_COMMAND
                       "' run s.toml --out o; echo status $?");
  EXPECT_THAT(result.errors, HasSubstr("interrupted at t = "));
  EXPECT_TRUE(fs::exists(place.folder() / "o/checkpoint.bin"));
}

TEST(Signal, AndResumeGiveTheAnswerOfOneRun) {
  const Workspace place;
  write_pendulum(place, 0.5);
  ASSERT_EQ(place.limber("run s.toml --out whole").status, 0);
  RunningCommand run(place, "run s.toml --out o");
  ASSERT_TRUE(wait_for(place, "o/.limber-lock"));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  run.send(SIGINT);
  const int status = run.wait().status;
  ASSERT_TRUE(status == 130 || status == 0);
  ASSERT_EQ(place.limber("run s.toml --out o --resume").status, 0);
  for (const char* file : {"probes.csv", "results.h5"}) {
    EXPECT_TRUE(read_text(place.folder() / "o" / file) ==
                read_text(place.folder() / "whole" / file))
        << file;
  }
  EXPECT_FALSE(fs::exists(place.folder() / "o/checkpoint.bin"));
}

TEST(Signal, EndsMeshingAtOnceAndLeavesNothingHalfWritten) {
  const Workspace place;
  place.write("fine.geo",
              "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\n"
              "MeshSize{:} = 0.004;\nPhysical Volume(\"v\") = {1};\n");
  RunningCommand reduction(place,
                           "reduce fine.geo --youngs-modulus 2e11 "
                           "--poisson-ratio 0.3 --density 7800 -o body.h5");
  let_it_work();
  const auto begin = std::chrono::steady_clock::now();
  reduction.send(SIGINT);
  const CommandResult result = reduction.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(3));
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.errors, HasSubstr("SIGINT"));
  EXPECT_FALSE(fs::exists(place.folder() / "body.h5"));
}

TEST(Signal, ThatIsIgnoredFromTheStartStaysSo) {
  const Workspace place;
  write_pendulum(place, 3.0);
  const CommandResult result = run_shell(
      place,
      "trap '' INT; '" LIMBER_COMMAND
      "' run s.toml --out o & id=$!; sleep 0.3; kill -INT $id; wait $id");
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST(TwoRuns, InOneFolderAreOneAndAnError) {
  const Workspace place;
  write_pendulum(place, kLong);
  RunningCommand first(place, "run s.toml --out o");
  ASSERT_TRUE(wait_for(place, "o/.limber-lock"));
  let_it_work();
  for (const char* arguments :
       {"run s.toml --out o", "static s.toml --out o", "compare s.toml --out o",
        "run s.toml --out ./o/../o"}) {
    const CommandResult second = place.limber(arguments);
    EXPECT_EQ(second.status, 2) << arguments;
    EXPECT_THAT(second.errors, AllOf(HasSubstr("is in use by process " +
                                               std::to_string(first.id())),
                                     HasSubstr("since ")))
        << arguments;
  }
  first.send(SIGKILL);
  first.wait();
  write_pendulum(place, 0.01);
  EXPECT_EQ(place.limber("run s.toml --out o").status, 0);
  EXPECT_FALSE(fs::exists(place.folder() / "o/.limber-lock"));
}

}  // namespace
}  // namespace limber::test::signal_test
