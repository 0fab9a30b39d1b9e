// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/process/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/process/landlock.hpp"

namespace limber {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCannotRun = 127;

/// An open descriptor, or -1.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() { close(); }
  [[nodiscard]] int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw InputError(
          fmt::format("no pipe to a child process: {}", std::strerror(errno)));
    }
    out = Descriptor(ends[0]);
    in = Descriptor(move_up(ends[1]));
  }
  Descriptor out;
  Descriptor in;

 private:
  // Above the descriptors that the child redirects.
  static int move_up(int fd) {
    const int high = fcntl(fd, F_DUPFD_CLOEXEC, kReplyDescriptor + 1);
    ::close(fd);
    return high;
  }
};

std::vector<char*> to_pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// All that a child needs between fork and exec, prepared before: there it may
/// call few functions and must not allocate.
struct Launch {
  const char* program = nullptr;
  char* const* arguments = nullptr;
  char* const* environment = nullptr;
  int output = -1;
  int reply = -1;
  int landlock = -1;
  int null = -1;
  pid_t parent = 0;
  rlim_t address_space = 0;
  rlim_t seconds = 0;
};

/// At most the limit of this process.
void limit(__rlimit_resource_t resource, rlim_t value) {
  rlimit bounds{value, value};
  if (getrlimit(resource, &bounds) != 0) return;
  bounds.rlim_cur = std::min(bounds.rlim_cur, value);
  bounds.rlim_max = std::min(bounds.rlim_max, value);
  setrlimit(resource, &bounds);
}

void set_limits(const Launch& launch) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, launch.seconds);
  limit(RLIMIT_AS, launch.address_space);
}

void reset_signals() {
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void become(const Launch& launch) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != launch.parent) _exit(kCannotRun);  // the parent died first
  reset_signals();
  dup2(launch.null, STDIN_FILENO);
  dup2(launch.output, STDOUT_FILENO);
  dup2(launch.output, STDERR_FILENO);
  dup2(launch.reply, kReplyDescriptor);
  apply_landlock(launch.landlock);
  // Where this call is missing, exec closes those with O_CLOEXEC.
  syscall(SYS_close_range, kReplyDescriptor + 1, ~0U, 0);
  set_limits(launch);
  execve(launch.program, launch.arguments, launch.environment);
  const char* why = std::strerror(errno);
  static_cast<void>(!write(STDERR_FILENO, why, std::strlen(why)));
  _exit(kCannotRun);
}

pid_t start(const ChildTask& task, const Pipe& output, const Pipe& reply) {
  std::vector<std::string> arguments = task.arguments;
  arguments.insert(arguments.begin(), task.program.string());
  std::vector<std::string> environment = task.environment;
  const std::vector<char*> argument_list = to_pointers(arguments);
  const std::vector<char*> environment_list = to_pointers(environment);
  const Descriptor null(open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Descriptor landlock(make_landlock(LandlockRule::no_writing));
  const Launch launch{
      arguments.front().c_str(),
      argument_list.data(),
      environment_list.data(),
      output.in.get(),
      reply.in.get(),
      landlock.get(),
      null.get(),
      getpid(),
      task.is_address_space_limited ? rlim_t{task.memory} : RLIM_INFINITY,
      static_cast<rlim_t>(std::min(std::ceil(task.seconds) + 1.0, 1e9))};
  const pid_t child = fork();
  if (child == 0) become(launch);
  if (child > 0) return child;
  throw InputError(fmt::format("{} cannot be started: {}",
                               task.program.string(), std::strerror(errno)));
}

/// Reads a child's output until its end, a size limit or a timeout.
class Listener {
 public:
  Listener(const ChildTask& task, Pipe& output, Pipe& reply, ChildEnd& end)
      : task_(task),
        pipes_{&output, &reply},
        end_(end),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(
                                         std::min(task.seconds, 1e9)))) {}

  void run() {
    while (pipes_[0]->out.get() >= 0 || pipes_[1]->out.get() >= 0) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(
          deadline_ - Clock::now());
      end_.is_out_of_time = left.count() <= 0;
      if (end_.is_out_of_time || end_.is_reply_too_long) return;
      wait(static_cast<int>(std::min<long>(left.count(), 1000)));
    }
  }

 private:
  void wait(int milliseconds) {
    std::array<pollfd, 2> polls{
        {{pipes_[0]->out.get(), POLLIN, 0}, {pipes_[1]->out.get(), POLLIN, 0}}};
    if (poll(polls.data(), polls.size(), milliseconds) <= 0) return;
    if (polls[0].revents != 0) {
      take(pipes_[0]->out, end_.output);
      if (task_.on_output) task_.on_output(end_.output);
    }
    if (polls[1].revents != 0) take(pipes_[1]->out, end_.reply);
    constexpr std::size_t kKept = 4000;
    if (end_.output.size() > 2 * kKept) {
      end_.output.erase(0, end_.output.size() - kKept);
    }
    end_.is_reply_too_long = end_.reply.size() > task_.memory;
  }

  void take(Descriptor& from, std::string& text) {
    const ssize_t count = read(from.get(), buffer_.data(), buffer_.size());
    if (count > 0) text.append(buffer_.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) from.close();
  }

  const ChildTask& task_;
  std::array<Pipe*, 2> pipes_;
  ChildEnd& end_;
  Clock::time_point deadline_;
  std::array<char, 1 << 16> buffer_{};
};

/// Kills the child's process group and collects the child's exit status.
class Reaper {
 public:
  explicit Reaper(pid_t child) : child_(child) {}
  Reaper(const Reaper&) = delete;
  Reaper& operator=(const Reaper&) = delete;
  ~Reaper() {
    if (child_ > 0) static_cast<void>(end(true));
  }
  int end(bool by_force) {
    const pid_t child = std::exchange(child_, 0);
    if (by_force || !ends_itself(child)) kill(child, SIGKILL);
    // Its PID and group are not reused before it is waited for.
    kill(-child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

 private:
  // It closed its descriptors: it is about to exit, unless it is hostile.
  static bool ends_itself(pid_t child) {
    constexpr int kPatience = 10000;  // ms
    for (int i = 0; i < kPatience; ++i) {
      siginfo_t info{};
      constexpr int kLook = WEXITED | WNOHANG | WNOWAIT;
      if (waitid(P_PID, static_cast<id_t>(child), &info, kLook) == 0 &&
          info.si_pid == child) {
        return true;
      }
      poll(nullptr, 0, 1);
    }
    return false;
  }
  pid_t child_;
};

}  // namespace

ChildEnd run_child(const ChildTask& task) {
  Pipe output;
  Pipe reply;
  Reaper reaper(start(task, output, reply));
  output.in.close();
  reply.in.close();
  ChildEnd end;
  Listener(task, output, reply, end).run();
  const int status = reaper.end(end.is_out_of_time || end.is_reply_too_long);
  end.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (end.signal == SIGXCPU) end.is_out_of_time = true;
  if (end.exit_status == kCannotRun && end.reply.empty()) {
    throw InputError(
        fmt::format("{} cannot be run: {}", task.program.string(), end.output));
  }
  return end;
}

}  // namespace limber
