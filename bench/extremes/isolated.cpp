// SPDX-License-Identifier: BSD-3-Clause
#include "isolated.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace limber::bench {
namespace {

using Clock = std::chrono::steady_clock;

// What waits for nothing gets this fraction of a core, even of a busy machine.
constexpr double kLeastFraction = 0.1;

// The first byte of a complete result.
constexpr char kWhole = '+';

struct Child {
  std::size_t index = 0;
  pid_t process = 0;
  int pipe = -1;
  Clock::time_point begin;
  std::string text;
};

void write_all(int pipe, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = write(pipe, text.data() + written, text.size() - written);
    if (n <= 0) return;
    written += static_cast<std::size_t>(n);
  }
}

// The system then ends this process by SIGXCPU.
void limit_processor_time(double seconds) {
  const auto whole = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit limit{whole, whole + 1};
  setrlimit(RLIMIT_CPU, &limit);
}

Child start(std::size_t index, const std::function<std::string()>& work,
            double limit) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) {
    close(ends[0]);
    limit_processor_time(limit);
    write_all(ends[1], kWhole + work());
    _exit(0);
  }
  close(ends[1]);
  return {index, process, ends[0], Clock::now(), {}};
}

double seconds_of(const Child& child) {
  return std::chrono::duration<double>(Clock::now() - child.begin).count();
}

Ending finish(const Child& child, bool is_over_time) {
  if (is_over_time) kill(child.process, SIGKILL);
  close(child.pipe);
  int status = 0;
  waitpid(child.process, &status, 0);
  Ending ending;
  ending.seconds = seconds_of(child);
  if (is_over_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
    ending.kind = Ending::Kind::hung;
  } else if (child.text.empty() || child.text[0] != kWhole ||
             !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    ending.kind = Ending::Kind::crashed;
  } else {
    ending.answer = child.text.substr(1);
  }
  return ending;
}

// Reads what is there. @returns whether the child has closed its end.
bool read_some(Child& child) {
  char block[4096];
  const ssize_t n = read(child.pipe, block, sizeof(block));
  if (n > 0) child.text.append(block, static_cast<std::size_t>(n));
  return n <= 0;
}

}  // namespace

std::vector<Ending> do_isolated(
    const std::vector<std::function<std::string()>>& work, double limit,
    int at_a_time, const std::function<void(std::size_t)>& tell) {
  constexpr int kPollMilliseconds = 50;
  std::vector<Ending> endings(work.size());
  std::vector<Child> children;
  std::size_t next = 0;
  std::size_t done = 0;
  while (done < work.size()) {
    while (next < work.size() && std::ssize(children) < at_a_time) {
      children.push_back(start(next, work[next], limit));
      ++next;
    }
    std::vector<pollfd> polls;
    for (const Child& child : children) {
      polls.push_back({child.pipe, POLLIN, 0});
    }
    poll(polls.data(), polls.size(), kPollMilliseconds);
    for (std::size_t i = children.size(); i-- > 0;) {
      Child& child = children[i];
      const bool is_closed = polls[i].revents != 0 && read_some(child);
      const bool is_over_time =
          !is_closed && kLeastFraction * seconds_of(child) > limit;
      if (!is_closed && !is_over_time) continue;
      endings[child.index] = finish(child, is_over_time);
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
      if (tell)
        tell(++done);
      else
        ++done;
    }
  }
  return endings;
}

}  // namespace limber::bench
