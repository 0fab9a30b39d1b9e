// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace limber {

/// A program to run, and its limits.
struct ChildTask {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::vector<std::string> environment;  ///< NAME=value, nothing else
  double seconds = 0.0;                  ///< wall time after which it is killed
                                         ///< [s]
  std::uint64_t memory = 0;  ///< of address space, and of its reply [bytes]
  /// False for a program under a sanitizer, which reserves a huge address
  /// space.
  bool is_address_space_limited = true;
  /// Called with the end of its output whenever there is more. May be empty.
  std::function<void(std::string_view output)> on_output = {};
};

/// How a child ended.
struct ChildEnd {
  std::string reply;    ///< what it wrote to descriptor kReplyDescriptor
  std::string output;   ///< end of its standard output and error
  int exit_status = 0;  ///< valid if `signal` is 0 [-]
  int signal = 0;       ///< number of the signal that ended it, or 0
  bool is_out_of_time = false;     ///< we ended it
  bool is_reply_too_long = false;  ///< we ended it
};

/// Where a child writes its reply.
inline constexpr int kReplyDescriptor = 3;

/// Runs the program to its end. It has no input, none of our descriptors, its
/// own process group, and cannot write files where the kernel has Landlock. It
/// is killed when the calling thread ends, and no process of its group is left
/// when this returns.
/// @throws InputError if the program cannot be run
[[nodiscard]] ChildEnd run_child(const ChildTask& task);

}  // namespace limber
