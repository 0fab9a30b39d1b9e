// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::mesher {

/// Effect of a forbidden call.
enum class Refusing {
  quietly,       ///< it fails, and a stricter filter may follow
  with_message,  ///< it ends the process with a message, see Sandbox
};

/// Applies a filter of system calls to the process, including later threads: it
/// can compute and read files, nothing else.
/// Source     Linux, Documentation/userspace-api/seccomp_filter.rst
/// @return whether the kernel supports it
bool apply_seccomp(Refusing refusing);

}  // namespace limber::mesher
