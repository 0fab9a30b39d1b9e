// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// At the end of a program HDF5 would close what a full disk kept it from
/// closing, and crash (h5py issue 914). A program that closes all its files
/// before, or has failed with an error, calls this before its first use of
/// HDF5. Of the whole process, so no matter of a library's.
void leave_hdf5_alone_at_exit();

}  // namespace limber
