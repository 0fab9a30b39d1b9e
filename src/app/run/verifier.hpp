// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// Has `limber-verify`, which links Simbody, go on in place of this program
/// with the same command line.
/// @param argv of main()
/// @throws InputError if Limber was built without it, or it is not installed
[[noreturn]] void become_verifier(char** argv);

}  // namespace limber::app
