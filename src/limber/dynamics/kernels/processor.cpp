// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/kernels/processor.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "limber/common/errors.hpp"
#include "limber/dynamics/kernels/lanes.hpp"

namespace limber::dynamics::kernels {
namespace {

bool has_avx2() {
#if LIMBER_HAS_AVX2
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace

Instructions find_instructions() {
  const Instructions best =
      has_avx2() ? Instructions::avx2 : Instructions::baseline;
  const char* const text = std::getenv("LIMBER_SIMD");
  const std::string_view requested = text == nullptr ? "" : text;
  if (requested.empty()) return best;
  if (requested == "baseline") return Instructions::baseline;
  if (requested == "avx2" && best == Instructions::avx2) return best;
  throw InputError(fmt::format(
      "environment variable LIMBER_SIMD is '{}'; expected 'baseline'{}",
      requested,
      best == Instructions::avx2
          ? " or 'avx2'"
          : std::string_view(", as this processor has no AVX2")));
}

std::string_view describe(Instructions instructions) {
#if defined(__x86_64__)
  return instructions == Instructions::avx2 ? "AVX2" : "baseline x86-64";
#else
  (void)instructions;
  return "baseline";
#endif
}

bool uses_avx2() {
  static const bool uses = find_instructions() == Instructions::avx2;
  return uses;
}

}  // namespace limber::dynamics::kernels
