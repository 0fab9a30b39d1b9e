// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

namespace limber::hdf5 {

/// Checks that all values of a file are in it. HDF5 allows a file to refer to
/// others by external links, external raw storage and virtual data sets; one
/// that somebody else made could show any file that its reader may read. No
/// other file is opened. Internal to hdf5_file.cpp.
/// @throws Failure naming the first object that is elsewhere.
void check_inside(hid_t file);

}  // namespace limber::hdf5
