// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// Replaces this program by `limber-verify`, which links Simbody, with the same
/// command line.
/// @param argv of main()
/// @throws InputError if Limber was built without it, or it is not installed
[[noreturn]] void become_verifier(char** argv);

}  // namespace limber::app
