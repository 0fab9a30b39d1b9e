// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/gnuplot_process.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "unit/results/temporary_folder.hpp"

namespace limber::results::gnuplot_process_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

/// A shell script that stands for gnuplot while this object lives.
class FalseGnuplot {
 public:
  explicit FalseGnuplot(const std::string& script) {
    const auto file = folder_.path() / "gnuplot";
    std::ofstream(file) << "#!/bin/sh\n" << script << '\n';
    chmod(file.c_str(), 0755);
    setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  FalseGnuplot(const FalseGnuplot&) = delete;
  FalseGnuplot& operator=(const FalseGnuplot&) = delete;
  ~FalseGnuplot() { setenv("PATH", path_.c_str(), 1); }

  [[nodiscard]] std::string read(const std::string& name) const {
    return test::read_bytes(folder_.path() / name);
  }
  [[nodiscard]] std::string folder() const { return folder_.path(); }

 private:
  test::TemporaryFolder folder_;
  std::string path_ = std::getenv("PATH");
};

TEST(GnuplotProcess, GetsTheWholeScript) {
  const FalseGnuplot gnuplot("cat > \"$(dirname \"$0\")/script\"");
  std::string script;
  for (int i = 0; i < 100000; ++i) script += "plot sin(x)\n";
  EXPECT_EQ(run_gnuplot(script, seconds(20)), GnuplotEnd::done);
  EXPECT_EQ(gnuplot.read("script"), script);
}

TEST(GnuplotProcess, ThatHangsIsEndedWithAllThatItStarted) {
  const FalseGnuplot gnuplot(
      "sleep 1000 & echo $! > \"$(dirname \"$0\")/id\"\n"
      "sleep 1000");
  const auto begin = steady_clock::now();
  EXPECT_EQ(run_gnuplot("plot", milliseconds(500)), GnuplotEnd::hung);
  EXPECT_LT(steady_clock::now() - begin, seconds(10));
  const pid_t sleeper = std::stoi(gnuplot.read("id"));
  for (int i = 0; i < 500 && kill(sleeper, 0) == 0; ++i) {
    std::this_thread::sleep_for(milliseconds(10));
    std::ifstream state("/proc/" + std::to_string(sleeper) + "/stat");
    std::string word;
    for (int k = 0; k < 3; ++k) state >> word;
    if (word == "Z") return;  // nobody here waits for it
  }
  EXPECT_NE(kill(sleeper, 0), 0);
}

TEST(GnuplotProcess, ThatReadsNothingDoesNotBlock) {
  const FalseGnuplot gnuplot("sleep 1000");
  const std::string script(10000000, '#');
  EXPECT_EQ(run_gnuplot(script, milliseconds(500)), GnuplotEnd::hung);
}

TEST(GnuplotProcess, ThatEndsEarlyIsAFailureAndNoSignal) {
  const FalseGnuplot gnuplot("exit 3");
  const std::string script(10000000, '#');
  EXPECT_EQ(run_gnuplot(script, seconds(20)), GnuplotEnd::failed);
}

TEST(GnuplotProcess, ThatIsNotThereIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/no/such/folder", 1);
  EXPECT_EQ(run_gnuplot("plot", seconds(20)), GnuplotEnd::missing);
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace limber::results::gnuplot_process_test
