// SPDX-License-Identifier: BSD-3-Clause
// A run that is killed resumes where it was.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): POSIX
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "cli/command.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "places.hpp"

namespace limber::test::resume_slow {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using std::chrono::steady_clock;

/// The claw's example, in longer steps and without pictures: tendons, latches
/// that close after three quarters of the time, stops.
void write_scenario(const Workspace& place) {
  std::string text = read_text(LIMBER_SOURCE_DIR "/examples/claw.toml");
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("../models/", LIMBER_SOURCE_DIR "/models/");
  replace("tolerance = 1e-6", "step = 3e-4");
  place.write("claw.toml", text + "\n[output]\npictures = false\n");
}

/// Starts `limber run` on its own, to be killed.
pid_t start_run(const Workspace& place, const fs::path& out, bool resumes) {
  const pid_t child = fork();
  if (child != 0) return child;
  const std::string program = LIMBER_COMMAND;
  std::vector<std::string> words = {
      program, "run",     place.folder() / "claw.toml", "--out",
      out,     "--cache", place.folder() / "cache",     "--checkpoint-interval",
      "0",     "--json"};
  if (resumes) words.emplace_back("--resume");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  if (std::freopen("/dev/null", "w", stdout) == nullptr ||
      std::freopen("/dev/null", "w", stderr) == nullptr) {
    _exit(1);
  }
  execv(program.c_str(), arguments.data());
  _exit(127);
}

int wait_for(pid_t child) {
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

/// No file in a results folder is incomplete at any time.
void expect_readable(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name == "results.h5") {
      EXPECT_NO_THROW((void)Hdf5File::open(entry.path())) << name;
    }
  }
}

TEST(KilledRun, GoesOnToTheSameResultsFromTwentyRandomMoments) {
  const Workspace place;
  write_scenario(place);
  const fs::path whole = place.folder() / "whole";
  ASSERT_EQ(wait_for(start_run(place, whole, false)), 0);
  const auto begin = steady_clock::now();
  ASSERT_EQ(wait_for(start_run(place, whole, false)), 0);
  const duration<double> time = steady_clock::now() - begin;
  const std::string probes = read_text(whole / "probes.csv");
  const std::string results = read_text(whole / "results.h5");
  ASSERT_FALSE(fs::exists(whole / "checkpoint.bin"));
  ASSERT_FALSE(fs::exists(whole / "checkpoint-1.log"));

  std::mt19937 random(2026);
  std::uniform_real_distribution<double> moment(0.0, time.count());
  int with_checkpoint = 0;
  for (int i = 0; i < 20; ++i) {
    const fs::path out = place.folder() / fmt::format("killed{}", i);
    const pid_t child = start_run(place, out, false);
    std::this_thread::sleep_for(duration<double>(moment(random)));
    kill(child, SIGKILL);
    wait_for(child);
    if (fs::exists(out)) expect_readable(out);
    with_checkpoint += fs::exists(out / "checkpoint.bin") ? 1 : 0;
    ASSERT_EQ(wait_for(start_run(place, out, true)), 0);
    EXPECT_EQ(read_text(out / "probes.csv"), probes) << i;
    EXPECT_TRUE(read_text(out / "results.h5") == results) << i;
    EXPECT_FALSE(fs::exists(out / "checkpoint.bin"));
  }
  EXPECT_GE(with_checkpoint, 5);  // else it was killed before it began
}

}  // namespace
}  // namespace limber::test::resume_slow
