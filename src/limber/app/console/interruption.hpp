// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// From now on SIGINT and SIGTERM end the program with status 130 and 143 and a
/// message on standard error, and unfinished files are removed. A signal that
/// was ignored at the start (`nohup`, background jobs) stays ignored.
void install_signal_handlers();

/// From `begin` until its destruction the first such signal is only recorded,
/// and the work polls it between two steps; a second one, at least 0.2 s later,
/// ends the program as usual. One instance at a time.
class DeferredSignals {
 public:
  DeferredSignals() = default;
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;
  ~DeferredSignals();
  void begin();  // NOLINT: while this object lives
};

/// The recorded signal; 0: none.
[[nodiscard]] int find_received_signal();

/// "SIGINT" or "SIGTERM".
[[nodiscard]] const char* name_signal(int signal);

}  // namespace limber::app
