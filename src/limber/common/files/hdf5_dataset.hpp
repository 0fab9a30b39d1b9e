// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "limber/common/files/hdf5_handle.hpp"

/// Datasets as we write them. Internal to hdf5_*.cpp.
namespace limber::hdf5 {

/// What a dataset is to hold, with its unit and meaning.
struct Dataset {
  const std::string& name;
  hid_t type;
  std::vector<hsize_t> shape;  ///< empty for one scalar
  const std::string& unit;
  const std::string& meaning;

  [[nodiscard]] bool is_empty() const;
};

/// The failure for a dataset that cannot be written.
[[nodiscard]] Failure cannot_write(const std::string& name);

/// Creates a dataset with intermediate groups and, unless it is empty or a
/// scalar, a checksum.
/// @param chunk rows of a checksum, 0: all up to HDF5's limit. A dataset with
/// chunks is written chunk by chunk, without a cache.
/// @throws Failure; likewise below
[[nodiscard]] Handle create_dataset(hid_t file, const Dataset& set,
                                    hsize_t chunk = 0);

/// Adds unit and meaning.
void add_attributes(const Handle& made, const Dataset& set);

/// A type for texts of this length.
[[nodiscard]] Handle make_text_type(const std::string& text);

}  // namespace limber::hdf5
