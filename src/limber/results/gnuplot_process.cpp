// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/gnuplot_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <optional>
#include <string_view>
#include <thread>

namespace limber::results {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kMissing = 127;  // as a shell reports it

// Between fork and exec: async-signal-safe calls only.
[[noreturn]] void become_gnuplot(int script, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  // A picture without a file name would go to our standard output.
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere < 0 || dup2(script, STDIN_FILENO) < 0 ||
      dup2(nowhere, STDOUT_FILENO) < 0 || dup2(nowhere, STDERR_FILENO) < 0) {
    _exit(1);
  }
  // By name, since gnuplot reads standard input byte by byte.
  execlp("gnuplot", "gnuplot", "/dev/stdin", static_cast<char*>(nullptr));
  _exit(errno == ENOENT ? kMissing : 1);
}

// Owns the process; the destructor ends it.
class Child {
 public:
  Child(int script, pid_t parent) : id_(fork()) {
    if (id_ == 0) become_gnuplot(script, parent);
    if (id_ > 0) setpgid(id_, id_);  // in parent and child, whichever is first
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ <= 0) return;
    kill(-id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  [[nodiscard]] bool has_started() const { return id_ > 0; }

  // Its exit status, if it ends in time.
  std::optional<int> wait_until(Clock::time_point deadline) {
    for (milliseconds pause(1);;
         pause = std::min(2 * pause, milliseconds(10))) {
      int status = 0;
      if (waitpid(id_, &status, WNOHANG) == id_) {
        kill(-id_, SIGKILL);  // its remaining children
        id_ = -1;
        return status;
      }
      if (Clock::now() >= deadline) return std::nullopt;
      std::this_thread::sleep_for(pause);
    }
  }

 private:
  pid_t id_;
};

// An anonymous file in memory.
class ScriptFile {
 public:
  explicit ScriptFile(std::string_view script)
      : id_(memfd_create("script", MFD_CLOEXEC)) {
    if (id_ < 0) return;
    while (!script.empty()) {
      const ssize_t count = write(id_, script.data(), script.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return;
      script.remove_prefix(static_cast<std::size_t>(count));
    }
    is_whole_ = lseek(id_, 0, SEEK_SET) == 0;
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  ~ScriptFile() {
    if (id_ >= 0) close(id_);
  }
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  [[nodiscard]] int id() const { return id_; }

 private:
  int id_;
  bool is_whole_ = false;
};

GnuplotEnd judge(int status) {
  if (status == 0) return GnuplotEnd::done;
  return WIFEXITED(status) && WEXITSTATUS(status) == kMissing
             ? GnuplotEnd::missing
             : GnuplotEnd::failed;
}

}  // namespace

GnuplotEnd run_gnuplot(const std::string& script, milliseconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  const ScriptFile file(script);
  if (!file.is_whole()) return GnuplotEnd::failed;
  Child child(file.id(), getpid());
  if (!child.has_started()) return GnuplotEnd::failed;
  const std::optional<int> status = child.wait_until(deadline);
  return status ? judge(*status) : GnuplotEnd::hung;
}

}  // namespace limber::results
