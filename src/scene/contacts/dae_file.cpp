// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/dae_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "limber/common/errors.hpp"
#include "limber/common/process/child_process.hpp"
#include "limber/common/process/helper_program.hpp"

namespace limber::scene {
namespace {

constexpr double kSeconds = 60.0;
constexpr std::uint64_t kMemory = std::uint64_t{1} << 32;
constexpr std::size_t kVectors = 4;  // a normal and three corners

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

/// Reverts the program's rotation to y up.
void turn_back(const std::string& text, std::string& stl) {
  const bool was_x = text.find(">X_UP<") != std::string::npos;
  const bool was_z = text.find(">Z_UP<") != std::string::npos;
  if (!was_x && !was_z) return;
  for (std::size_t at = kStlHead; at + kStlRecord <= stl.size();
       at += kStlRecord) {
    std::array<float, 3 * kVectors> numbers{};
    std::memcpy(numbers.data(), stl.data() + at, sizeof(numbers));
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      const float x = numbers[i];
      const float y = numbers[i + 1];
      const float z = numbers[i + 2];
      if (was_x) {
        numbers[i] = y;
        numbers[i + 1] = -x;
      } else {
        numbers[i + 1] = -z;
        numbers[i + 2] = y;
      }
    }
    std::memcpy(stl.data() + at, numbers.data(), sizeof(numbers));
  }
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

std::string convert_dae(const std::filesystem::path& file,
                        const std::string& text) {
  ChildTask task;
  task.program = find_assimp(file);
  task.arguments = {"export", std::filesystem::absolute(file).string(),
                    fmt::format("/dev/fd/{}", kReplyDescriptor), "-fstlb"};
  task.seconds = kSeconds;
  task.memory = kMemory;
  ChildEnd end = run_child(task);
  const bool is_done = end.exit_status == 0 && end.signal == 0 &&
                       !end.is_out_of_time && !end.is_reply_too_long &&
                       end.reply.size() >= kStlHead;
  if (!is_done) {
    throw InputError(
        fmt::format("mesh '{}': assimp: {}", file.string(), explain(end)));
  }
  turn_back(text, end.reply);
  return std::move(end.reply);
}

}  // namespace limber::scene
