// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/file_stamp.hpp"
#include "mesher/walls.hpp"

namespace limber::mesher {

/// From now on notes every file that this process opens or looks for, by
/// whichever library: this program's own fopen, open, stat and their like come
/// before those of the C library. With Walls::words, files with a dangerous
/// word end the process.
void start_trace(Walls walls);

struct Trace {
  std::vector<FileStamp> files;
  /// Nothing was read that stamps do not cover: no folder was listed, no
  /// device or pipe opened, no text asked for the clock or the like.
  bool is_repeatable = true;
};
/// Ends the notes. With the program itself and its libraries.
[[nodiscard]] Trace finish_trace();

}  // namespace limber::mesher
