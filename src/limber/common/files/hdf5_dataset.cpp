// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace limber::hdf5 {
namespace {

void add_text_attribute(hid_t object, const char* name,
                        const std::string& text) {
  const Handle type = make_text_type(text);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle attribute(H5Acreate2(object, name, type.get(), space.get(),
                              H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  checked(H5Awrite(attribute.get(), type.get(), text.c_str()));
  attribute.close();
}

// A checksum needs chunks.
void add_checksum(hid_t creation, std::vector<hsize_t> shape, hsize_t chunk) {
  const hsize_t most = hsize_t{1} << 26;
  const hsize_t row = std::accumulate(shape.begin() + 1, shape.end(),
                                      hsize_t{8}, std::multiplies<>());
  if (chunk == 0) chunk = most / row;
  shape[0] = std::clamp(chunk, hsize_t{1}, shape[0]);
  checked(H5Pset_chunk(creation, static_cast<int>(shape.size()), shape.data()));
  checked(H5Pset_fletcher32(creation));
}

hid_t make_space(const std::vector<hsize_t>& shape) {
  if (shape.empty()) return H5Screate(H5S_SCALAR);
  return H5Screate_simple(static_cast<int>(shape.size()), shape.data(),
                          nullptr);
}

}  // namespace

bool Dataset::is_empty() const {
  return std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
}

Failure cannot_write(const std::string& name) {
  return Failure(
      fmt::format("'{}' cannot be written; is the disk full?", name));
}

Handle create_dataset(hid_t file, const Dataset& set, hsize_t chunk) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  checked(H5Pset_create_intermediate_group(links.get(), 1));
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  leave_out_times(creation.get());
  if (!set.shape.empty() && !set.is_empty()) {
    add_checksum(creation.get(), set.shape, chunk);
  }
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  if (chunk != 0) checked(H5Pset_chunk_cache(access.get(), 0, 0, 0.0));
  const Handle space(make_space(set.shape), H5Sclose);
  return {H5Dcreate2(file, set.name.c_str(), set.type, space.get(), links.get(),
                     creation.get(), access.get()),
          H5Dclose};
}

void add_attributes(const Handle& made, const Dataset& set) {
  if (!set.unit.empty()) add_text_attribute(made.get(), "unit", set.unit);
  add_text_attribute(made.get(), "meaning", set.meaning);
}

Handle make_text_type(const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // One more than the characters, for the terminating zero.
  checked(H5Tset_size(type.get(), text.size() + 1));
  return type;
}

}  // namespace limber::hdf5
