// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// Disables HDF5's exit handler, which crashes on files that a full disk kept
/// it from closing (h5py issue 914). For a program that closes all its files
/// itself or has reported an error; call before the first use of HDF5. It acts
/// on the whole process, so a library must not call it.
void leave_hdf5_alone_at_exit();

}  // namespace limber
