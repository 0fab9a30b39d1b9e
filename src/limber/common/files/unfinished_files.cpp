// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/unfinished_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): POSIX
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <climits>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";
constexpr std::size_t kRandomLetters = 6;
constexpr std::chrono::hours kStale(1);

// Signal handlers may only use static memory. A file without a free slot stays
// behind after a signal, until the next run.
struct Slot {
  std::atomic<bool> is_taken = false;
  std::atomic<bool> is_set = false;
  std::array<char, PATH_MAX> path = {};
};

std::array<Slot, 16>& all_slots() {
  static std::array<Slot, 16> slots;
  return slots;
}

int take_slot(const fs::path& path) {
  const std::string& name = path.native();
  if (name.size() >= PATH_MAX) return -1;
  auto& slots = all_slots();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].is_taken.exchange(true)) continue;
    std::memcpy(slots[i].path.data(), name.c_str(), name.size() + 1);
    slots[i].is_set = true;
    return static_cast<int>(i);
  }
  return -1;
}

void release_slot(int i) {
  if (i < 0) return;
  Slot& slot = all_slots()[static_cast<std::size_t>(i)];
  slot.is_set = false;
  slot.is_taken = false;
}

std::string draw_letters() {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string letters;
  for (std::size_t i = 0; i < kRandomLetters; ++i) {
    letters += kLetters[random() % kLetters.size()];
  }
  return letters;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(
      fmt::format("'{}' cannot be written: {}", file.string(), why));
}

fs::path make_part(const fs::path& file) {
  while (true) {
    fs::path part = file;
    part += fmt::format("{}{}-{}", kMark, getpid(), draw_letters());
    const int made =
        open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made >= 0) {
      close(made);
      return part;
    }
    if (errno != EEXIST) refuse(file, describe_errno());
  }
}

// The process in a name "FILE.part-PID-XXXXXX".
std::optional<pid_t> find_writer(std::string_view name) {
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string_view::npos) return std::nullopt;
  const char* const end = name.data() + name.size();
  pid_t pid = 0;
  const auto [after, error] =
      std::from_chars(name.data() + mark + kMark.size(), end, pid);
  if (error != std::errc() || pid <= 0 ||
      end - after != 1 + std::ptrdiff_t{kRandomLetters} || *after != '-') {
    return std::nullopt;
  }
  return pid;
}

bool is_gone(pid_t pid) { return kill(pid, 0) != 0 && errno == ESRCH; }

template <typename IsStale>
void remove_parts(const fs::path& folder, const IsStale& is_stale) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (!find_writer(name) || !entry->is_regular_file(ignored)) continue;
    if (is_stale(*entry, name)) fs::remove(entry->path(), ignored);
  }
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void remove_stale_parts_of(const fs::path& file) {
  const std::string start = file.filename().string() + std::string(kMark);
  remove_parts(folder_of(file),
               [&](const fs::directory_entry& entry, const std::string& name) {
                 return name.starts_with(start) && is_stale_part(entry.path());
               });
}

// Some file systems do not support this fsync and return EINVAL.
void sync(const fs::path& path, int flags, const fs::path& file) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (descriptor < 0) refuse(file, describe_errno());
  const bool fails = fsync(descriptor) != 0 && errno != EINVAL;
  const std::string why = fails ? describe_errno() : "";
  close(descriptor);
  if (fails) refuse(file, why);
}

}  // namespace

UnfinishedFile::UnfinishedFile(const fs::path& file) {
  remove_stale_parts_of(file);
  path_ = make_part(file);
  slot_ = take_slot(path_);
}

UnfinishedFile::~UnfinishedFile() {
  release_slot(slot_);
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

void UnfinishedFile::move_to(const fs::path& file) {
  sync(path_, 0, file);
  std::error_code error;
  fs::rename(path_, file, error);
  if (error) refuse(file, error.message());
  path_.clear();
  sync(folder_of(file), O_DIRECTORY, file);
}

void remove_unfinished_files() noexcept {
  for (const Slot& slot : all_slots()) {
    if (slot.is_set) unlink(slot.path.data());
  }
}

// Only after an hour: the process may run on another machine.
bool is_stale_part(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::optional<pid_t> writer = find_writer(name);
  if (!writer || !is_gone(*writer)) return false;
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - changed > kStale;
}

void remove_stale_parts(const fs::path& folder) {
  remove_parts(folder, [](const fs::directory_entry&, const std::string& name) {
    return *find_writer(name) != getpid();
  });
}

}  // namespace limber
