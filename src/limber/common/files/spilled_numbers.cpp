// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/spilled_numbers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

// A temporary file without a name in a folder; -1 if there can be none.
int open_nameless(const std::filesystem::path& folder) {
  std::string name = (folder / "limber-XXXXXX").string();
  const int handle = mkostemp(name.data(), O_CLOEXEC);
  if (handle >= 0) unlink(name.c_str());
  return handle;
}

int open_temporary() {
  const char* const chosen = std::getenv("TMPDIR");
  if (chosen != nullptr && *chosen != '\0') return open_nameless(chosen);
  const int handle = open_nameless("/var/tmp");
  return handle >= 0 ? handle : open_nameless("/tmp");
}

}  // namespace

class SpilledNumbers::File {
 public:
  File() : handle_(open_temporary()) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (handle_ >= 0) close(handle_);
  }

  [[nodiscard]] bool is_open() const { return handle_ >= 0; }

  /// Place of so many bytes that nobody else has.
  std::uint64_t reserve(std::size_t bytes) { return end_.fetch_add(bytes); }

  bool write(const void* data, std::size_t bytes, std::uint64_t place) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
      const ssize_t done =
          pwrite(handle_, from, bytes, static_cast<off_t>(place));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      from += done;
      place += static_cast<std::uint64_t>(done);
      bytes -= static_cast<std::size_t>(done);
    }
    return true;
  }

  void read(void* data, std::size_t bytes, std::uint64_t place) const {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
      const ssize_t done = pread(handle_, to, bytes, static_cast<off_t>(place));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) {
        throw InputError(fmt::format(
            "the temporary file of a run's outputs cannot be read: {}",
            done == 0 ? "it is cut short" : describe_errno()));
      }
      to += done;
      place += static_cast<std::uint64_t>(done);
      bytes -= static_cast<std::size_t>(done);
    }
  }

 private:
  int handle_;
  std::atomic<std::uint64_t> end_ = 0;
};

void SpilledNumbers::append(const std::vector<double>& row) {
  numbers_.insert(numbers_.end(), row.begin(), row.end());
  ends_.push_back(numbers_.size());
  if (held_bytes() >= most_) spill();
}

std::size_t SpilledNumbers::held_bytes() const {
  return sizeof(double) * numbers_.size() +
         sizeof(std::uint64_t) * ends_.size();
}

void SpilledNumbers::spill() {
  if (!file_ || !file_->is_open()) file_ = std::make_shared<File>();
  const std::size_t table = sizeof(std::uint64_t) * ends_.size();
  const std::uint64_t place = file_->reserve(held_bytes());
  const bool is_written =
      file_->is_open() && file_->write(ends_.data(), table, place) &&
      file_->write(numbers_.data(), held_bytes() - table, place + table);
  if (!is_written) {
    most_ *= 2;
    return;
  }
  blocks_.push_back({spilled_, place});
  spilled_ += ends_.size();
  numbers_.clear();
  ends_.clear();
  if (most_ == kBlock) return;
  numbers_.shrink_to_fit();
  most_ = kBlock;
}

std::vector<double> SpilledNumbers::read(std::size_t i) const {
  LIMBER_EXPECT(i < size());
  if (i < spilled_) return read_spilled(i);
  const std::size_t k = i - spilled_;
  const auto from = static_cast<std::ptrdiff_t>(k == 0 ? 0 : ends_[k - 1]);
  return {numbers_.begin() + from,
          numbers_.begin() + static_cast<std::ptrdiff_t>(ends_[k])};
}

std::vector<double> SpilledNumbers::read_spilled(std::size_t i) const {
  const auto next = std::upper_bound(
      blocks_.begin(), blocks_.end(), i,
      [](std::size_t row, const Block& block) { return row < block.first; });
  const Block& block = *std::prev(next);
  const std::size_t rows =
      (next == blocks_.end() ? spilled_ : next->first) - block.first;
  const std::size_t k = i - block.first;
  // The end of the row before it, and its own.
  std::array<std::uint64_t, 2> ends = {0, 0};
  constexpr std::size_t kSize = sizeof(std::uint64_t);
  if (k == 0) {
    file_->read(&ends[1], kSize, block.place);
  } else {
    file_->read(ends.data(), 2 * kSize, block.place + kSize * (k - 1));
  }
  std::vector<double> row(ends[1] - ends[0]);
  file_->read(row.data(), sizeof(double) * row.size(),
              block.place + kSize * rows + sizeof(double) * ends[0]);
  return row;
}

}  // namespace limber
