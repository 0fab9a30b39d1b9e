// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): POSIX
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "cli/command.hpp"
#include "places.hpp"

/// No command runs what a geometry orders, and none ends by it.
namespace limber::test::harmful_geometry_test {
namespace {

using ::testing::HasSubstr;

const std::string kMaterial =
    " --youngs-modulus 200e9 --poisson-ratio 0.3 --density 8000 ";
const std::string kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
    "Physical Volume(\"body\") = {1};\nMesh.MeshSizeMax = 0.5;\n";

bool has_canary(const Workspace& place) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(place.folder())) {
    if (entry.path().filename().string().find("canary") == 0) return true;
  }
  return false;
}

struct Order {
  std::string text;
  std::string message;
};

const std::vector<Order>& list_orders() {
  static const std::vector<Order> orders = {
      {"SystemCall \"touch canary\";", "run a program"},
      {"System \"touch canary\";", "run a program"},
      {"NonBlockingSystemCall \"touch canary\";", "run a program"},
      {"OnelabRun(\"touch\", \"touch canary\");", "tries to"},
      {"Printf(\"x\") > \"canary\";", "write the file"},
      {"Save \"canary.msh\";", "write the file"},
      {"Exit;", "Exit"},
      {"Merge \"/dev/zero\";", "/dev/zero"}};
  return orders;
}

TEST(HarmfulGeometry, IsRefusedByEveryCommandThatReadsMeshes) {
  if (kIsSanitized) GTEST_SKIP() << "sets limits";
  const Workspace place;
  place.write("evil.urdf",
              "<robot name='r'><link name='bar'/><flexible link='bar'>"
              "<mesh file='evil.geo'/><material youngs_modulus='70e9' "
              "poisson_ratio='0.3' density='2700'/></flexible></robot>\n");
  place.write("evil.toml",
              "robot = \"evil.urdf\"\n[time]\nduration = 0.001\nstep = 1e-3\n");
  for (const Order& order : list_orders()) {
    place.write("evil.geo", kBox + order.text + "\n");
    for (const std::string command :
         {"info evil.geo", "run evil.toml", "static evil.toml",
          "compare evil.toml --fidelity rigid,coupled --reference coupled",
          "modes evil.geo", "reduce evil.geo -o body.h5"}) {
      const bool needs_material =
          command.find("modes") == 0 || command.find("reduce") == 0;
      const CommandResult result =
          place.limber(command + (needs_material ? kMaterial : ""));
      EXPECT_EQ(result.status, 2) << command << ": " << order.text;
      EXPECT_THAT(result.errors, HasSubstr(order.message)) << command;
    }
  }
  EXPECT_FALSE(has_canary(place));
}

TEST(HarmfulGeometry, UnderAMeshsNameIsNotRun) {
  const Workspace place;
  for (const Order& order : list_orders()) {
    place.write("evil.msh", order.text + "\n" + kBox);
    const CommandResult result = place.limber("info evil.msh");
    EXPECT_EQ(result.status, 2) << order.text;
    EXPECT_THAT(result.errors, HasSubstr("but its content does not"));
  }
  EXPECT_FALSE(has_canary(place));
}

/// Processes that run the mesher for a file below the folder.
int count_meshers(const Workspace& place) {
  int count = 0;
  std::error_code gone;
  for (const auto& process :
       std::filesystem::directory_iterator("/proc", gone)) {
    const std::string words = read_text(process.path() / "cmdline");
    if (words.find("limber-mesh") == std::string::npos) continue;
    if (words.find(place.folder().string()) != std::string::npos) ++count;
  }
  return count;
}

/// Waits until so many run, at most some seconds.
int await_meshers(const Workspace& place, int count) {
  int found = -1;
  for (int i = 0; i < 500 && found != count; ++i) {
    found = count_meshers(place);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return found;
}

TEST(HarmfulGeometry, ThatNeverEndsDiesWithLimber) {
  const Workspace place;
  place.write("endless.geo", "Sleep 1000;\n" + kBox);
  const std::string file = place.folder() / "endless.geo";
  for (const int signal : {SIGKILL, SIGTERM}) {
    const pid_t limber = fork();
    if (limber == 0) {
      execl(LIMBER_COMMAND, "limber", "info", file.c_str(), nullptr);
      _exit(1);
    }
    EXPECT_EQ(await_meshers(place, 1), 1);
    kill(limber, signal);
    waitpid(limber, nullptr, 0);
    EXPECT_EQ(await_meshers(place, 0), 0) << "signal " << signal;
  }
}

TEST(HarmfulGeometry, IsHeldByLimitsThatTheUserSets) {
  if (kIsSanitized) GTEST_SKIP() << "sets limits";
  const Workspace place;
  place.write("endless.geo", "Sleep 1000;\n" + kBox);
  place.write("large.geo", kBox + "Transfinite Curve {1:12} = 200000000;\n");
  setenv("LIMBER_MESH_SECONDS", "1", 1);
  EXPECT_THAT(place.limber("info endless.geo").errors,
              HasSubstr("did not finish within 1 s"));
  setenv("LIMBER_MESH_SECONDS", "60", 1);
  setenv("LIMBER_MESH_MEMORY", "0.75", 1);
  const CommandResult large = place.limber("info large.geo");
  EXPECT_EQ(large.status, 2);
  EXPECT_THAT(large.errors, HasSubstr("0.75 GiB"));
  unsetenv("LIMBER_MESH_SECONDS");
  unsetenv("LIMBER_MESH_MEMORY");
}

}  // namespace
}  // namespace limber::test::harmful_geometry_test
