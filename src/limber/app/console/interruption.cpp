// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>

#include "limber/common/files/unfinished_files.hpp"

namespace limber::app {
namespace {

// Signal handlers can only use global variables.
std::atomic<bool> is_deferred = false;
std::atomic<int> received = 0;
std::atomic<std::int64_t> received_at = 0;  // [ns]

/// A signal that comes this soon after the first is the same request:
/// timeout(1) and shells signal both the program and its process group. [ns]
constexpr std::int64_t kSameRequest = 200'000'000;

std::int64_t read_clock() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1'000'000'000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec;
}

void say(const char* text) {
  static_cast<void>(!write(STDERR_FILENO, text, std::strlen(text)));
}

// Only what POSIX allows in a signal handler.
void handle(int signal) {
  int none = 0;
  if (is_deferred && received.compare_exchange_strong(none, signal)) {
    received_at = read_clock();
    say("\nlimber: stopping after this step; a second signal stops "
        "immediately\n");
    return;
  }
  if (is_deferred && read_clock() - received_at < kSameRequest) return;
  remove_unfinished_files();
  say("\nlimber: ended by ");
  say(name_signal(signal));
  say("; all files are complete\n");
  _exit(128 + signal);
}

}  // namespace

void install_signal_handlers() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action = {};
    action.sa_handler = handle;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

void DeferredSignals::begin() { is_deferred = true; }
DeferredSignals::~DeferredSignals() { is_deferred = false; }

int find_received_signal() { return received; }

const char* name_signal(int signal) {
  return signal == SIGINT ? "SIGINT" : "SIGTERM";
}

}  // namespace limber::app
