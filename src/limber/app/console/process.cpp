// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "limber/app/console/exit_status.hpp"
#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/common/files/hdf5_exit.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::app {
namespace {

constexpr std::size_t kMebi = std::size_t{1} << 20;
constexpr std::size_t kBufferOfAThread = 129 * kMebi;  // OpenBLAS's own
constexpr rlim_t kStack = kMebi;  // of each thread: 64 KiB overflow
// The least that any command takes, and the libraries that come with the first
// factor of a matrix.
constexpr std::size_t kRest = (256 + 80) * kMebi;

// Otherwise a file would get the descriptor of a closed stream, and receive its
// output. Opened read-only, so that printing fails.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      static_cast<void>(open("/dev/null", O_RDONLY));
    }
  }
}

std::size_t count_blas_threads() {
  const auto cores =
      std::max<std::size_t>(1, std::thread::hardware_concurrency());
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    const char* const text = std::getenv(name);
    const std::optional<double> count =
        text == nullptr ? std::nullopt : parse_number(text);
    if (count && *count >= 1.0 && *count < static_cast<double>(cores)) {
      return static_cast<std::size_t>(*count);
    }
  }
  return cores;
}

bool is_limited() {
  rlimit limit = {};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

bool has_address_space(std::size_t bytes) {
  void* const found = mmap(nullptr, bytes, PROT_NONE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) return false;
  munmap(found, bytes);
  return true;
}

}  // namespace

void prepare_process() {
  open_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  install_signal_handlers();
  leave_hdf5_alone_at_exit();
}

void check_address_space() {
  if (!is_limited()) return;
  const std::size_t threads = count_blas_threads();
  const std::size_t needed = threads * kBufferOfAThread + kRest;
  if (has_address_space(needed)) return;
  print_error(
      fmt::format("out of memory: the limit of address space (ulimit -v) "
                  "leaves less than the {} MiB that linear algebra with {} "
                  "threads needs; raise it, or set OPENBLAS_NUM_THREADS=1",
                  needed / kMebi, threads));
  _exit(kNoSolution);  // an OpenBLAS thread may never end
}

void check_stack() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStack) return;
  print_error(fmt::format(
      "the limit of the stack (ulimit -s) is {} KiB, {} are needed; raise it",
      limit.rlim_cur / 1024, kStack / 1024));
  _exit(kNoSolution);
}

int end_process(int status) {
  if (!is_limited()) return status;
  std::fflush(nullptr);
  _exit(status);
}

}  // namespace limber::app
