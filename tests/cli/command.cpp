// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "places.hpp"

namespace limber::test {
namespace {

std::filesystem::path make_folder() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "limber-cli-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("cannot make a folder for the test");
  }
  return pattern;
}

}  // namespace

Workspace::Workspace() : folder_(make_folder()) {}

Workspace::~Workspace() {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

void Workspace::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

CommandResult Workspace::limber(const std::string& arguments) const {
  const std::string line = "cd '" + folder_.string() + "' && LIMBER_CACHE='" +
                           folder_.string() + "/cache' '" LIMBER_COMMAND "' " +
                           arguments + " >stdout.txt 2>stderr.txt";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          read_text(folder_ / "stdout.txt"), read_text(folder_ / "stderr.txt")};
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace limber::test
