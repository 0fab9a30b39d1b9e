// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// From now on SIGINT and SIGTERM end the program with status 130 and 143 and
/// words on standard error; unfinished files go. One that was ignored at the
/// start, as `nohup` and shells do for jobs in the background, stays so.
void install_signal_handlers();

/// From `begin` to its end the first such signal is only noted, and the work
/// looks for it between two steps; a second one ends the program as ever. One
/// at a time.
class DeferredSignals {
 public:
  DeferredSignals() = default;
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;
  ~DeferredSignals();
  void begin();  // NOLINT: while this object lives
};

/// The signal that was noted; 0: none.
[[nodiscard]] int find_noted_signal();

/// "SIGINT" or "SIGTERM".
[[nodiscard]] const char* name_signal(int signal);

}  // namespace limber::app
