// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// Sets up the process, first of all: opens standard streams, makes failed
/// writes return an error instead of a signal (SIGPIPE, SIGXFSZ), installs
/// handlers of SIGINT and SIGTERM, disables HDF5's exit handler.
void prepare_process();

/// Ends the program with a message and status 3 if a limit (ulimit -v) leaves
/// less address space than the linear algebra needs at its start: OpenBLAS
/// would retry the allocation forever.
void check_address_space();

/// Ends the program with a message and status 3 if a limit (ulimit -s) makes
/// the stacks, also those of the linear algebra's threads, so small that they
/// may overflow.
void check_stack();

/// The return value of main(). Under such a limit it ends the program itself:
/// OpenBLAS's threads without memory must not be joined.
[[nodiscard]] int end_process(int status);

}  // namespace limber::app
