// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "places.hpp"

namespace limber::test {

Workspace::Workspace(Cache cache)
    : cache_((cache == Cache::own ? folder() : own_folder()) / "cache") {}

void Workspace::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder() / name, std::ios::binary) << text;
}

CommandResult Workspace::limber(const std::string& arguments) const {
  const std::string line = "cd '" + folder().string() + "' && LIMBER_CACHE='" +
                           cache_.string() + "' '" LIMBER_COMMAND "' " +
                           arguments + " >stdout.txt 2>stderr.txt";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          read_text(folder() / "stdout.txt"),
          read_text(folder() / "stderr.txt")};
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace limber::test
