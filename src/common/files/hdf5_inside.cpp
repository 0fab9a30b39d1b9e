// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_inside.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"

namespace limber::hdf5 {
namespace {

Failure make_outside(const std::string& name, const char* reason) {
  return Failure(fmt::format(
      "'{}' {}; only values inside the file are read, since others could be "
      "anybody's",
      echo(name), reason));
}

// Called before the other file is opened; a negative answer ends the search.
herr_t refuse_link(const char*, const char*, const char*, const char*,
                   unsigned*, hid_t, void* met) {
  *static_cast<bool*>(met) = true;
  return -1;
}

// Answer of `work`, a call of HDF5 with access properties that refuse external
// links, wherever on the way they are.
template <typename Work>
auto follow_inside(const std::string& name, hid_t kind, const Work& work) {
  bool met = false;
  const Handle access(H5Pcreate(kind), H5Pclose);
  checked(H5Pset_elink_cb(access.get(), refuse_link, &met));
  const auto answer = work(access.get());
  if (met) throw make_outside(name, "is reached by a link to another file");
  return answer;
}

void check_storage(hid_t set, const std::string& name) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  if (checked(H5Pget_external_count(creation.get())) > 0) {
    throw make_outside(name, "keeps its values in another file");
  }
  if (checked(H5Pget_layout(creation.get())) == H5D_VIRTUAL) {
    throw make_outside(name, "is a virtual data set, a view of other ones");
  }
}

}  // namespace

bool has_inside(hid_t file, const std::string& name) {
  // An error here means that a parent group does not exist.
  const htri_t found = follow_inside(name, H5P_LINK_ACCESS, [&](hid_t access) {
    return H5Lexists(file, name.c_str(), access);
  });
  return found > 0;
}

Handle open_dataset_inside(hid_t file, const std::string& name) {
  const hid_t id = follow_inside(name, H5P_DATASET_ACCESS, [&](hid_t access) {
    return H5Dopen2(file, name.c_str(), access);
  });
  if (id < 0) throw Failure(fmt::format("it has no '{}'", echo(name)));
  Handle set(id, H5Dclose);
  check_storage(set.get(), name);
  return set;
}

Handle open_group_inside(hid_t file, const std::string& name) {
  return {follow_inside(name, H5P_GROUP_ACCESS,
                        [&](hid_t access) {
                          return H5Gopen2(file, name.c_str(), access);
                        }),
          H5Gclose};
}

}  // namespace limber::hdf5
