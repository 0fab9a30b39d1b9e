// SPDX-License-Identifier: BSD-3-Clause
#include "results/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <ctime>

namespace limber::results {
namespace {

// While it lives, writing to a program that has ended fails in this thread,
// and does not end ours too.
class BrokenPipesFail {
 public:
  BrokenPipesFail() {
    sigemptyset(&broken_pipe_);
    sigaddset(&broken_pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
  }
  BrokenPipesFail(const BrokenPipesFail&) = delete;
  BrokenPipesFail& operator=(const BrokenPipesFail&) = delete;
  ~BrokenPipesFail() {
    if (sigismember(&before_, SIGPIPE) == 0) {
      const timespec at_once = {};
      sigtimedwait(&broken_pipe_, nullptr, &at_once);
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t broken_pipe_;
  sigset_t before_;
};

}  // namespace

std::string quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\n') {
      quoted += ' ';
    } else if (c == '\'') {
      quoted += "''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

GnuplotScript::GnuplotScript(const std::filesystem::path& file, int width,
                             int height)
    : file_(file) {
  add(
      fmt::format("set terminal pngcairo noenhanced size {},{} font "
                  "'sans,14' linewidth 1.6",
                  width, height));
  add("set output " + quote(file.string()));
  add("set encoding utf8");
}

void GnuplotScript::add(const std::string& line) {
  text_ += line;
  text_ += '\n';
}

std::string GnuplotScript::run() const {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  // The command is fixed; names travel inside the script, quoted. A picture
  // without a place would go to our own output.
  std::FILE* pipe = popen("gnuplot >/dev/null 2>&1", "w");
  if (pipe == nullptr) return "no picture: gnuplot cannot be started";
  // After the start: gnuplot itself gets the usual signals.
  const BrokenPipesFail guard;
  const std::size_t written = std::fwrite(text_.data(), 1, text_.size(), pipe);
  const int status = pclose(pipe);
  if (status == 0 && written == text_.size() &&
      std::filesystem::exists(file_, ignored)) {
    return {};
  }
  constexpr int kNotFound = 127;  // the shell's word for a missing program
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) {
    return "no pictures: gnuplot is not installed (Debian: gnuplot-nox)";
  }
  return fmt::format("no picture '{}': gnuplot could not draw or write it",
                     file_.string());
}

}  // namespace limber::results
