// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber::flexbody {

/// Size of the block before the datasets of a body's file, which holds its
/// seal: HDF5's user block, or the front of a flat file [B].
inline constexpr std::size_t kBodySealSize = 512;

}  // namespace limber::flexbody
