// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/dae_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "limber/common/errors.hpp"
#include "limber/common/process/child_process.hpp"
#include "limber/common/process/helper_program.hpp"

namespace limber::scene {
namespace {

constexpr double kSeconds = 60.0;
constexpr std::uint64_t kMemory = std::uint64_t{1} << 32;

std::filesystem::path find_assimp(const std::filesystem::path& file) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    const std::filesystem::path program =
        std::filesystem::absolute(folder) / "assimp";
    if (can_run(program)) return program;
  }
  throw InputError(fmt::format(
      "mesh '{}': COLLADA is read by the program 'assimp', which is not "
      "installed (Debian: assimp-utils); or convert it to .stl",
      file.string()));
}

/// The program's own words, or how it ended.
std::string explain(const ChildEnd& end) {
  if (end.is_out_of_time) return fmt::format("not read in {:g} s", kSeconds);
  if (end.is_reply_too_long || end.signal != 0) return "it cannot be read";
  const std::size_t at = end.output.find("ERROR: ");
  if (at == std::string::npos) return "it cannot be read";
  return end.output.substr(at + 7, end.output.find('\n', at) - at - 7);
}

}  // namespace

std::string convert_dae(const std::filesystem::path& file) {
  ChildTask task;
  task.program = find_assimp(file);
  task.arguments = {"export", std::filesystem::absolute(file).string(),
                    fmt::format("/dev/fd/{}", kReplyDescriptor), "-fobjnomtl"};
  task.seconds = kSeconds;
  task.memory = kMemory;
  ChildEnd end = run_child(task);
  const bool is_done = end.exit_status == 0 && end.signal == 0 &&
                       !end.is_out_of_time && !end.is_reply_too_long &&
                       !end.reply.empty();
  if (!is_done) {
    throw InputError(
        fmt::format("mesh '{}': assimp: {}", file.string(), explain(end)));
  }
  return std::move(end.reply);
}

Matrix3 find_dae_axes(const std::string& text) {
  Matrix3 axes = Matrix3::Identity();
  if (text.find(">X_UP<") != std::string::npos) {
    axes << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  } else if (text.find(">Z_UP<") != std::string::npos) {
    axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  return axes;
}

}  // namespace limber::scene
