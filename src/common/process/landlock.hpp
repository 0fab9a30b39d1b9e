// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// Linux's Landlock: rules that a process lays on itself, and cannot take
/// off again.
/// Source     Linux, Documentation/userspace-api/landlock.rst
enum class LandlockRule {
  no_writing,    ///< no file or folder is made, changed or taken away
  no_execution,  ///< no program is run
};

/// A descriptor of the rule, to be closed; -1 where the kernel has none.
/// With `no_writing` there is no network either, where the kernel can.
[[nodiscard]] int make_landlock(LandlockRule rule);

/// Lays the rule on the calling thread. Safe between fork and exec.
/// @return whether it holds
bool apply_landlock(int descriptor);

}  // namespace limber
