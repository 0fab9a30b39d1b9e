// SPDX-License-Identifier: BSD-3-Clause
// Options of the address sanitizer, which asks this function for them. They
// are built in because the program starts with an empty environment.
extern "C" __attribute__((visibility("default"))) const char*
__asan_default_options();
extern "C" const char* __asan_default_options() {
  return "alloc_dealloc_mismatch=0"  // Gmsh 4.8 ends `new[]` by `delete`
         ":detect_leaks=0";  // it leaks; the sandbox lets no report be made
}
