// SPDX-License-Identifier: BSD-3-Clause
// Tells programs of the build tree where its mesher is.
#include <cstdlib>

namespace {
const int kIsSet = setenv("LIMBER_MESHER", LIMBER_MESHER_FILE, 0);
}  // namespace

// Linked as an object, so that it is there without being asked for.
int limber_mesher_is_set() { return kIsSet; }
