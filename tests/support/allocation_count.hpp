// SPDX-License-Identifier: BSD-3-Clause
// Counts every heap allocation of the program. Included by one file of an
// executable: it is that executable's malloc. Not for sanitized programs, whose
// own it would replace.
#pragma once

#include <atomic>
#include <cstddef>

extern "C" {
void* __libc_malloc(std::size_t size);                       // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);    // NOLINT
void* __libc_realloc(void* old, std::size_t size);           // NOLINT
void* __libc_memalign(std::size_t align, std::size_t size);  // NOLINT
}

namespace limber::testing {
/// So far. Atomic, since compilers take malloc for a function that changes no
/// variable of the program.
inline std::atomic<long> allocations = 0;
}  // namespace limber::testing

extern "C" {
void* malloc(std::size_t size) {
  ++limber::testing::allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++limber::testing::allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++limber::testing::allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t align, std::size_t size) {
  ++limber::testing::allocations;
  return __libc_memalign(align, size);
}
}
