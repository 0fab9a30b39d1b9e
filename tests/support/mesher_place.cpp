// SPDX-License-Identifier: BSD-3-Clause
// Sets the path of the mesher for programs of the build tree.
#include <cstdlib>

namespace {
const int kIsSet = setenv("LIMBER_MESHER", LIMBER_MESHER_FILE, 0);
}  // namespace

// Linked as an object, so that it is always included.
int limber_mesher_is_set() { return kIsSet; }
