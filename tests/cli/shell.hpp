// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

#include "cli/command.hpp"

namespace limber::test {

/// Runs any line of a shell in the folder, `limber` being the command. Where
/// the line sends them nowhere else, its outputs are those of the result.
[[nodiscard]] CommandResult run_shell(const Workspace& place,
                                      const std::string& line);

/// Waits until a file is there, 30 s at most. @returns whether it is
[[nodiscard]] bool wait_for(const Workspace& place, const std::string& name);

/// A command that runs beside the test; killed at the end at the latest.
class RunningCommand {
 public:
  RunningCommand(const Workspace& place, const std::string& arguments);
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;
  ~RunningCommand();

  [[nodiscard]] pid_t id() const { return id_; }
  void send(int signal) const;
  /// Waits for its end, 30 s at most. A signal that ends it is -1 as status.
  CommandResult wait();

 private:
  const Workspace& place_;
  pid_t id_;
};

}  // namespace limber::test
