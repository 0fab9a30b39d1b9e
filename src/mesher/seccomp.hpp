// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::mesher {

/// What happens to a call that goes beyond.
enum class Refusing {
  quietly,     ///< it fails, and a stricter filter may follow
  with_words,  ///< it ends the process, see Walls
};

/// Lays a filter of system calls on the process, all threads to come included:
/// it computes and reads files, and nothing else.
/// Source     Linux, Documentation/userspace-api/seccomp_filter.rst
/// @return whether the kernel has it
bool apply_seccomp(Refusing refusing);

}  // namespace limber::mesher
