// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "limber/common/errors.hpp"

/// Helpers for calls of the HDF5 C API. Internal to hdf5_*.cpp.
namespace limber::hdf5 {

/// A failure inside a file; `with_path` adds the file's name.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// During its lifetime HDF5 does not print its error stack; our exception
/// carries the message. Restores the previous error handler at the end.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

template <typename Work>
auto with_path(const std::filesystem::path& file, const Work& work) {
  const Quiet quiet;
  try {
    return work();
  } catch (const Failure& failure) {
    throw InputError(fmt::format("'{}': {}", file.string(), failure.what()));
  }
}

/// Returns the result of an HDF5 call; throws Failure if it signals an error.
template <typename Answer>
Answer checked(Answer answer) {
  if (answer < 0) throw Failure("HDF5 reports an error; the file is damaged");
  return answer;
}

/// Closes an HDF5 identifier of any kind.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle(hid_t id, Closer closer) : id_(checked(id)), closer_(closer) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&&) = delete;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) closer_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  /// For written objects: closing flushes, and may fail on a full disk.
  void close() { checked(closer_(std::exchange(id_, -1))); }

 private:
  hid_t id_;
  Closer closer_;
};

/// Stores no time stamps, so that the same values give the same bytes.
inline void leave_out_times(hid_t creation) {
  checked(H5Pset_obj_track_times(creation, false));
}

}  // namespace limber::hdf5
