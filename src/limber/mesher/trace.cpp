// SPDX-License-Identifier: BSD-3-Clause
#include "limber/mesher/trace.hpp"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "limber/mesher/refusal.hpp"

namespace limber::mesher {
namespace {

/// Record of the process: global, since functions that replace those of the C
/// library cannot get it otherwise.
class Notes {
 public:
  static Notes& get() {
    static Notes notes;
    return notes;
  }

  void start(Sandbox sandbox) {
    sandbox_ = sandbox;
    is_on_ = true;
  }

  void opened(const char* name) { note(name, true); }
  void looked_for(const char* name) { note(name, false); }
  void listed_folder() {
    if (is_on_) is_repeatable_ = false;
  }

  Trace finish() {
    is_on_ = false;
    Trace trace;
    trace.is_repeatable = is_repeatable_;
    for (auto& [path, stamp] : stamps_) trace.files.push_back(stamp);
    return trace;
  }

 private:
  void note(const char* name, bool is_opened) {
    // Recording opens files too.
    thread_local bool is_busy = false;
    if (!is_on_ || is_busy || !name) return;
    is_busy = true;
    try {
      const std::lock_guard lock(mutex_);
      add(std::filesystem::absolute(name), is_opened);
    } catch (const std::exception&) {
      is_repeatable_ = false;
    }
    is_busy = false;
  }

  void add(const std::filesystem::path& path, bool is_opened) {
    const auto known = stamps_.find(path.string());
    if (known != stamps_.end() && known->second.mark.starts_with("content ")) {
      return;
    }
    if (!is_opened) {
      stamps_.emplace(path.string(), stamp_presence(path));
      return;
    }
    FileStamp stamp = stamp_content(path);
    if (stamp.mark.starts_with("content ")) screen(path);
    const std::string text = path.string();
    // A folder, a device, or a kernel file, whose size is reported as 0.
    if (stamp.mark == "there" || text.starts_with("/proc/") ||
        text.starts_with("/sys/")) {
      is_repeatable_ = false;
      require_end(path);
    }
    stamps_[text] = std::move(stamp);
  }

  // A pipe may never be written to; a device has no end.
  static void require_end(const std::filesystem::path& path) {
    const std::string text = path.string();
    const bool is_known =
        text == "/dev/null" || text == "/dev/urandom" || text == "/dev/random";
    if (!is_known && std::filesystem::is_other(path)) {
      refuse(fmt::format("read '{}', which is no file", text));
    }
  }

  void screen(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (has_unrepeatable_command(text)) is_repeatable_ = false;
    if (sandbox_ == Sandbox::kernel) return;
    if (const auto word = find_dangerous_command(text)) {
      refuse(fmt::format("use '{}' (in {})", *word, path.string()));
    }
  }

  std::mutex mutex_;
  std::map<std::string, FileStamp> stamps_;
  std::atomic<bool> is_on_ = false;
  std::atomic<bool> is_repeatable_ = true;
  Sandbox sandbox_ = Sandbox::kernel;
};

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));  // NOLINT
}

std::set<std::string> list_programs() {
  std::set<std::string> files;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t slash = line.find('/');
    if (slash != std::string::npos &&
        line.find(" r-xp ") != std::string::npos) {
      files.insert(line.substr(slash));
    }
  }
  return files;
}

}  // namespace

void start_trace(Sandbox sandbox) { Notes::get().start(sandbox); }

Trace finish_trace() {
  Trace trace = Notes::get().finish();
  for (const std::string& program : list_programs()) {
    trace.files.push_back(stamp_version(program));
  }
  // The cache maps names to libraries; its change may select another one.
  trace.files.push_back(stamp_version("/etc/ld.so.cache"));
  return trace;
}

}  // namespace limber::mesher

// Replacements of the C library's functions that open files: each records the
// name and calls the original. Headers may define some of them inline; the
// labels avoid the conflict.
#define LIMBER_IN_PLACE_OF(name) \
  __asm__(#name) __attribute__((visibility("default")))

using limber::mesher::next;
using limber::mesher::Notes;

// Like open, where a mode may follow the flags.
#define LIMBER_TRACE_OPEN(own, name)                                      \
  int own(const char* file, int flags, ...) LIMBER_IN_PLACE_OF(name);     \
  int own(const char* file, int flags, ...) {                             \
    static const auto real = next<int (*)(const char*, int, ...)>(#name); \
    Notes::get().opened(file);                                            \
    if ((flags & (O_CREAT | O_TMPFILE)) == 0) return real(file, flags);   \
    va_list rest;                                                         \
    va_start(rest, flags);                                                \
    const unsigned mode = va_arg(rest, unsigned);                         \
    va_end(rest);                                                         \
    return real(file, flags, mode);                                       \
  }

// With two arguments, the first the file's name.
#define LIMBER_TRACE(note, own, name, Result, Second)                      \
  Result own(const char* file, Second second) LIMBER_IN_PLACE_OF(name);    \
  Result own(const char* file, Second second) {                            \
    static const auto real = next<Result (*)(const char*, Second)>(#name); \
    Notes::get().note(file);                                               \
    return real(file, second);                                             \
  }

extern "C" {

LIMBER_TRACE_OPEN(limber_open, open)
LIMBER_TRACE_OPEN(limber_open64, open64)
LIMBER_TRACE(opened, limber_open_2, __open_2, int, int)
LIMBER_TRACE(opened, limber_open64_2, __open64_2, int, int)
LIMBER_TRACE(opened, limber_fopen, fopen, FILE*, const char*)
LIMBER_TRACE(opened, limber_fopen64, fopen64, FILE*, const char*)
LIMBER_TRACE(looked_for, limber_stat, stat, int, struct stat*)
LIMBER_TRACE(looked_for, limber_stat64, stat64, int, struct stat64*)
LIMBER_TRACE(looked_for, limber_lstat, lstat, int, struct stat*)
LIMBER_TRACE(looked_for, limber_lstat64, lstat64, int, struct stat64*)
LIMBER_TRACE(looked_for, limber_access, access, int, int)

FILE* limber_freopen(const char* file, const char* mode, FILE* stream)
    LIMBER_IN_PLACE_OF(freopen);
FILE* limber_freopen(const char* file, const char* mode, FILE* stream) {
  static const auto real =
      next<FILE* (*)(const char*, const char*, FILE*)>("freopen");
  Notes::get().opened(file);
  return real(file, mode, stream);
}

DIR* limber_opendir(const char* file) LIMBER_IN_PLACE_OF(opendir);
DIR* limber_opendir(const char* file) {
  static const auto real = next<DIR* (*)(const char*)>("opendir");
  Notes::get().listed_folder();
  return real(file);
}
}
