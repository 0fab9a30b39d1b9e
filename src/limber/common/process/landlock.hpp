// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber {

/// Linux Landlock: restrictions that a process puts on itself for good.
/// Source     Linux, Documentation/userspace-api/landlock.rst
enum class LandlockRule {
  no_writing,    ///< no file or folder is created, changed or removed
  no_execution,  ///< no program is run
};

/// A descriptor of the rule, to be closed; -1 where the kernel has none.
/// `no_writing` also denies network access, where the kernel supports it.
[[nodiscard]] int make_landlock(LandlockRule rule);

/// Applies the rule to the calling thread. Safe between fork and exec.
/// @return whether it is in force
bool apply_landlock(int descriptor);

}  // namespace limber
