// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

/// Which instructions the kernels use.
namespace limber::dynamics::kernels {

enum class Instructions { baseline, avx2 };

/// The instructions of this processor, or those that the environment variable
/// LIMBER_SIMD
/// (`baseline` or `avx2`) selects; results have the same bits.
/// @throws InputError for another value of it, and for instructions that this
/// processor lacks.
[[nodiscard]] Instructions find_instructions();

/// "AVX2" or "baseline x86-64".
[[nodiscard]] std::string_view describe(Instructions instructions);

/// Whether kernels use AVX2: find_instructions(), determined once.
[[nodiscard]] bool uses_avx2();

}  // namespace limber::dynamics::kernels
