// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/mesher/sandbox.hpp"

namespace limber::mesher {

/// From now on records every file that this process opens or searches for,
/// through any library: this program's fopen, open, stat and the like replace
/// those of the C library. With Sandbox::text_search, files with a dangerous
/// command end the process.
void start_trace(Sandbox sandbox);

struct Trace {
  std::vector<FileStamp> files;
  /// Everything read is covered by stamps: no folder was listed, no device or
  /// pipe opened, no geometry reads the clock or the like.
  bool is_repeatable = true;
};
/// Ends the recording. Includes the program itself and its libraries.
[[nodiscard]] Trace finish_trace();

}  // namespace limber::mesher
