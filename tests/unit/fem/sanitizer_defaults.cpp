// SPDX-License-Identifier: BSD-3-Clause
/// What the address sanitizer finds inside Gmsh 4.8 and OpenCASCADE, and we
/// cannot mend: arrays freed as single objects where prisms are set up, and
/// memory kept until the process ends.
#if defined(__SANITIZE_ADDRESS__)
extern "C" {

// Called by the sanitizer, which looks for them by these names.
__attribute__((visibility("default"))) const char* __asan_default_options();
__attribute__((visibility("default"))) const char*
__lsan_default_suppressions();

const char* __asan_default_options() { return "alloc_dealloc_mismatch=0"; }
const char* __lsan_default_suppressions() {
  return "leak:libgmsh.so\nleak:libTK\n";
}

}  // extern "C"
#endif
