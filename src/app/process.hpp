// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// What the command needs of its process before anything else: standard
/// streams that are open, writing that fails by an error and not by a signal
/// (SIGPIPE, SIGXFSZ), an end by SIGINT and SIGTERM, HDF5 left alone at exit.
void prepare_process();

/// Ends the program with words and status 3 where a limit (ulimit -v) leaves
/// less address space than the linear algebra takes at its start: OpenBLAS asks
/// for it again and again, for ever.
void check_address_space();

/// Ends the program with words and status 3 where a limit (ulimit -s) leaves so
/// little stack, also to the linear algebra's threads, that it may overflow.
void check_stack();

/// What main() is to return. Under such a limit the program ends here: where
/// OpenBLAS's threads have found no memory, they are not to be waited for.
[[nodiscard]] int end_process(int status);

}  // namespace limber::app
