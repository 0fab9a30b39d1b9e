// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/errors.hpp"

/// What calls of HDF5's own functions need. For hdf5_file.cpp alone.
namespace limber::hdf5 {

/// What went wrong inside a file; `with_path` adds which file.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While it lives, HDF5 does not print its own stack of errors: ours is the one
/// clear text. What others have asked of HDF5 holds again after it.
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

/// Passes on what an HDF5 call answers, unless it is the sign of failure.
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
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) closer_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  /// For what was written: closing may be what fills the disk.
  void close() { checked(closer_(std::exchange(id_, -1))); }

 private:
  hid_t id_;
  Closer closer_;
};

/// A file is what was written into it, not when: the same values give the same
/// bytes.
inline void leave_out_times(hid_t creation) {
  checked(H5Pset_obj_track_times(creation, false));
}

}  // namespace limber::hdf5
