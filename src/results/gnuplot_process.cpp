// SPDX-License-Identifier: BSD-3-Clause
#include "results/gnuplot_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
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

constexpr int kMissing = 127;  // a shell's word for it

// Between fork and exec: only what a signal handler may do.
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
  // A picture without a place would go to our own output.
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere < 0 || dup2(script, STDIN_FILENO) < 0 ||
      dup2(nowhere, STDOUT_FILENO) < 0 || dup2(nowhere, STDERR_FILENO) < 0) {
    _exit(1);
  }
  execlp("gnuplot", "gnuplot", static_cast<char*>(nullptr));
  _exit(errno == ENOENT ? kMissing : 1);
}

// Ends the process at the latest when it goes.
class Child {
 public:
  Child(int script, pid_t parent) : id_(fork()) {
    if (id_ == 0) become_gnuplot(script, parent);
    if (id_ > 0) setpgid(id_, id_);  // whoever of the two is first
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ <= 0) return;
    kill(-id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  [[nodiscard]] bool has_started() const { return id_ > 0; }

  // Its status, if it ends in time.
  std::optional<int> wait_until(Clock::time_point deadline) {
    for (milliseconds pause(1);;
         pause = std::min(2 * pause, milliseconds(10))) {
      int status = 0;
      if (waitpid(id_, &status, WNOHANG) == id_) {
        kill(-id_, SIGKILL);  // what it started and left
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

int milliseconds_until(Clock::time_point deadline) {
  const auto left =
      std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::max<milliseconds::rep>(left.count(), 0));
}

// A reader that has ended, or does not read, is no reason to wait.
void send_script(int to, std::string_view script, Clock::time_point deadline) {
  while (!script.empty()) {
    pollfd ready = {to, POLLOUT, 0};
    const int count = poll(&ready, 1, milliseconds_until(deadline));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    const ssize_t sent =
        send(to, script.data(), script.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return;
    script.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
  }
}

GnuplotEnd judge(int status) {
  if (status == 0) return GnuplotEnd::done;
  return WIFEXITED(status) && WEXITSTATUS(status) == kMissing
             ? GnuplotEnd::missing
             : GnuplotEnd::failed;
}

}  // namespace

GnuplotEnd run_gnuplot(const std::string& script, milliseconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  int ends[2] = {};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return GnuplotEnd::failed;
  }
  Child child(ends[1], getpid());
  close(ends[1]);
  if (child.has_started()) send_script(ends[0], script, deadline);
  close(ends[0]);
  if (!child.has_started()) return GnuplotEnd::failed;
  const std::optional<int> status = child.wait_until(deadline);
  return status ? judge(*status) : GnuplotEnd::hung;
}

}  // namespace limber::results
