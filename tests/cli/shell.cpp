// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "places.hpp"

namespace limber::test {
namespace {

// Where and with what cache a shell's line runs.
std::string find_setting(const Workspace& place) {
  return "cd '" + place.folder().string() + "' && export LIMBER_CACHE='" +
         place.cache().string() +
         "' && limber() { '" LIMBER_COMMAND "' \"$@\"; } && ";
}

}  // namespace

CommandResult run_shell(const Workspace& place, const std::string& line) {
  const std::string whole =
      find_setting(place) + "( " + line + "\n) >stdout.txt 2>stderr.txt";
  const int status = std::system(whole.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          read_text(place.folder() / "stdout.txt"),
          read_text(place.folder() / "stderr.txt")};
}

bool wait_for(const Workspace& place, const std::string& name) {
  for (int i = 0; i < 3000; ++i) {
    if (std::filesystem::exists(place.folder() / name)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

RunningCommand::RunningCommand(const Workspace& place,
                               const std::string& arguments)
    : place_(place), id_(fork()) {
  if (id_ != 0) return;
  const std::string line = find_setting(place) + "exec '" LIMBER_COMMAND "' " +
                           arguments + " >stdout2.txt 2>stderr2.txt";
  execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
  _exit(127);
}

RunningCommand::~RunningCommand() {
  if (id_ <= 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

void RunningCommand::send(int signal) const { kill(id_, signal); }

CommandResult RunningCommand::wait() {
  int status = -1;
  for (int i = 0; i < 3000 && waitpid(id_, &status, WNOHANG) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (status != -1) id_ = -1;
  return {status != -1 && WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          read_text(place_.folder() / "stdout2.txt"),
          read_text(place_.folder() / "stderr2.txt")};
}

}  // namespace limber::test
