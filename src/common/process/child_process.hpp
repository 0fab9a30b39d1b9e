// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace limber {

/// A program that is to do something for us, under limits.
struct ChildTask {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::vector<std::string> environment;  ///< NAME=value, nothing else
  double seconds = 0.0;                  ///< of wall time, then it is ended [s]
  std::uint64_t memory = 0;  ///< bytes of address space and of its reply
};

/// How a child ended.
struct ChildEnd {
  std::string reply;    ///< what it wrote to its descriptor kReplyDescriptor
  std::string words;    ///< the end of what it wrote to its output and error
  int exit_status = 0;  ///< if `signal` is 0
  int signal = 0;       ///< that ended it
  bool is_out_of_time = false;     ///< we ended it
  bool is_reply_too_long = false;  ///< we ended it
};

/// Where a child writes its reply.
inline constexpr int kReplyDescriptor = 3;

/// Runs the program to its end. It gets nothing to read, no descriptor of
/// ours, a process group of its own, and cannot write any file where the
/// kernel has Landlock. It dies when the calling thread does, however that
/// ends, and none of its group is left when this returns.
/// @throws InputError if the program cannot be run
[[nodiscard]] ChildEnd run_child(const ChildTask& task);

}  // namespace limber
