// SPDX-License-Identifier: BSD-3-Clause
#include "mesher/trace.hpp"

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

namespace limber::mesher {
namespace {

/// Notes of one process: a function in place of the C library's own has no
/// other way to reach them.
class Notes {
 public:
  static Notes& get() {
    static Notes notes;
    return notes;
  }

  void start(Walls walls) {
    walls_ = walls;
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
    // Taking notes opens files too.
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
    // A folder, a device, or a file of the kernel's, which looks empty.
    if (stamp.mark == "there" || text.starts_with("/proc/") ||
        text.starts_with("/sys/")) {
      is_repeatable_ = false;
      require_end(path);
    }
    stamps_[text] = std::move(stamp);
  }

  // A pipe may never be written to, and a device has no end.
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
    if (has_fleeting_word(text)) is_repeatable_ = false;
    if (walls_ == Walls::kernel) return;
    if (const auto word = find_dangerous_word(text)) {
      refuse(fmt::format("use '{}' (in {})", *word, path.string()));
    }
  }

  std::mutex mutex_;
  std::map<std::string, FileStamp> stamps_;
  std::atomic<bool> is_on_ = false;
  std::atomic<bool> is_repeatable_ = true;
  Walls walls_ = Walls::kernel;
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

void start_trace(Walls walls) { Notes::get().start(walls); }

Trace finish_trace() {
  Trace trace = Notes::get().finish();
  for (const std::string& program : list_programs()) {
    trace.files.push_back(stamp_version(program));
  }
  return trace;
}

}  // namespace limber::mesher

// The C library's functions by which files are reached. Their headers may
// define some of them inline; the labels keep clear of that.
#define LIMBER_IN_PLACE_OF(name) \
  __asm__(#name) __attribute__((visibility("default")))

extern "C" {

using limber::mesher::next;
using limber::mesher::Notes;

FILE* limber_fopen(const char* name, const char* mode)
    LIMBER_IN_PLACE_OF(fopen);
FILE* limber_fopen(const char* name, const char* mode) {
  static const auto real = next<FILE* (*)(const char*, const char*)>("fopen");
  Notes::get().opened(name);
  return real(name, mode);
}

FILE* limber_fopen64(const char* name, const char* mode)
    LIMBER_IN_PLACE_OF(fopen64);
FILE* limber_fopen64(const char* name, const char* mode) {
  static const auto real = next<FILE* (*)(const char*, const char*)>("fopen64");
  Notes::get().opened(name);
  return real(name, mode);
}

FILE* limber_freopen(const char* name, const char* mode, FILE* file)
    LIMBER_IN_PLACE_OF(freopen);
FILE* limber_freopen(const char* name, const char* mode, FILE* file) {
  static const auto real =
      next<FILE* (*)(const char*, const char*, FILE*)>("freopen");
  Notes::get().opened(name);
  return real(name, mode, file);
}

// Whether a mode follows the flags.
static bool has_mode(int flags) { return (flags & (O_CREAT | O_TMPFILE)) != 0; }

int limber_open(const char* name, int flags, ...) LIMBER_IN_PLACE_OF(open);
int limber_open(const char* name, int flags, ...) {
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  Notes::get().opened(name);
  if (!has_mode(flags)) return real(name, flags);
  va_list rest;
  va_start(rest, flags);
  const unsigned mode = va_arg(rest, unsigned);
  va_end(rest);
  return real(name, flags, mode);
}

int limber_open64(const char* name, int flags, ...) LIMBER_IN_PLACE_OF(open64);
int limber_open64(const char* name, int flags, ...) {
  static const auto real = next<int (*)(const char*, int, ...)>("open64");
  Notes::get().opened(name);
  if (!has_mode(flags)) return real(name, flags);
  va_list rest;
  va_start(rest, flags);
  const unsigned mode = va_arg(rest, unsigned);
  va_end(rest);
  return real(name, flags, mode);
}

int limber_open_2(const char* name, int flags) LIMBER_IN_PLACE_OF(__open_2);
int limber_open_2(const char* name, int flags) {
  static const auto real = next<int (*)(const char*, int)>("__open_2");
  Notes::get().opened(name);
  return real(name, flags);
}

int limber_open64_2(const char* name, int flags) LIMBER_IN_PLACE_OF(__open64_2);
int limber_open64_2(const char* name, int flags) {
  static const auto real = next<int (*)(const char*, int)>("__open64_2");
  Notes::get().opened(name);
  return real(name, flags);
}

int limber_stat(const char* name, struct stat* info) LIMBER_IN_PLACE_OF(stat);
int limber_stat(const char* name, struct stat* info) {
  static const auto real = next<int (*)(const char*, struct stat*)>("stat");
  Notes::get().looked_for(name);
  return real(name, info);
}

int limber_stat64(const char* name, struct stat64* info)
    LIMBER_IN_PLACE_OF(stat64);
int limber_stat64(const char* name, struct stat64* info) {
  static const auto real = next<int (*)(const char*, struct stat64*)>("stat64");
  Notes::get().looked_for(name);
  return real(name, info);
}

int limber_access(const char* name, int mode) LIMBER_IN_PLACE_OF(access);
int limber_access(const char* name, int mode) {
  static const auto real = next<int (*)(const char*, int)>("access");
  Notes::get().looked_for(name);
  return real(name, mode);
}

DIR* limber_opendir(const char* name) LIMBER_IN_PLACE_OF(opendir);
DIR* limber_opendir(const char* name) {
  static const auto real = next<DIR* (*)(const char*)>("opendir");
  Notes::get().listed_folder();
  return real(name);
}
}
