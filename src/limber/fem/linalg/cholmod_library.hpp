// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For sources of src/limber/fem/linalg only: they alone see CHOLMOD's types.
#include <cholmod.h>

namespace limber::fem {

/// CHOLMOD's functions, and with them BLAS, loaded at first use: a
/// program that never factors a matrix starts without them, in half the
/// time.
struct CholmodLibrary {
  decltype(&cholmod_start) start = nullptr;
  decltype(&cholmod_finish) finish = nullptr;
  decltype(&cholmod_metis) metis = nullptr;
  decltype(&cholmod_amd) amd = nullptr;
  decltype(&cholmod_analyze_p) analyze_p = nullptr;
  decltype(&cholmod_factorize) factorize = nullptr;
  decltype(&cholmod_solve2) solve2 = nullptr;
  decltype(&cholmod_free_dense) free_dense = nullptr;
  decltype(&cholmod_free_factor) free_factor = nullptr;
};

/// The library of the process. Thread-safe.
/// @throws InputError if it cannot be loaded, with the loader's message
[[nodiscard]] const CholmodLibrary& cholmod();

}  // namespace limber::fem
