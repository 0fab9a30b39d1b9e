// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <string>

#include "limber/common/files/hdf5_handle.hpp"

/// Access to objects whose data lie in the opened file. HDF5 lets a file
/// refer to others by external links, external raw storage and virtual data
/// sets; a file that somebody else made could show any file that its reader may
/// read. Internal to hdf5_file.cpp.
namespace limber::hdf5 {

/// Whether a link of this name exists. @throws Failure if the way to it leaves
/// the file.
[[nodiscard]] bool has_inside(hid_t file, const std::string& name);

/// Opens a data set. @throws Failure if there is none, if the way to it leaves
/// the file, or if it keeps values outside. No other file is opened.
[[nodiscard]] Handle open_dataset_inside(hid_t file, const std::string& name);

/// Opens a group. @throws Failure as above.
[[nodiscard]] Handle open_group_inside(hid_t file, const std::string& name);

}  // namespace limber::hdf5
