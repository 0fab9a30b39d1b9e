// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_inside.hpp"

#include <fmt/format.h>

#include <string>

#include "limber/common/echo.hpp"
#include "limber/common/files/hdf5_handle.hpp"

namespace limber::hdf5 {
namespace {

const char* find_outside(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  if (checked(H5Pget_external_count(creation.get())) > 0) {
    return "keeps its values in another file";
  }
  if (checked(H5Pget_layout(creation.get())) == H5D_VIRTUAL) {
    return "is a virtual data set, a view of others";
  }
  return nullptr;
}

// Why the object of a link is not in the file, if it is not. What cannot be
// opened has no values; reading it fails.
const char* find_outside(hid_t file, const char* name, H5L_type_t type) {
  if (type == H5L_TYPE_SOFT) return nullptr;  // to a link of this file
  if (type != H5L_TYPE_HARD) return "is a link to another file";
  const hid_t id = H5Oopen(file, name, H5P_DEFAULT);
  if (id < 0) return nullptr;
  const Handle object(id, H5Oclose);
  return H5Iget_type(id) == H5I_DATASET ? find_outside(id) : nullptr;
}

}  // namespace

void check_inside(hid_t file) {
  std::string problem;
  // A positive answer ends the visit. No exception may pass through HDF5.
  const auto look = [](hid_t root, const char* name, const H5L_info_t* link,
                       void* out) -> herr_t {
    try {
      const char* why = find_outside(root, name, link->type);
      if (why == nullptr) return 0;
      *static_cast<std::string*>(out) = fmt::format("'{}' {}", echo(name), why);
      return 1;
    } catch (const Failure&) {
      return -1;
    }
  };
  checked(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, look, &problem));
  if (problem.empty()) return;
  throw Failure(problem +
                "; only self-contained files are read, since references could "
                "expose other files");
}

}  // namespace limber::hdf5
