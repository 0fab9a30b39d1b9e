// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::test {

/// Whether library, command and tests are built with sanitizers: these take
/// terabytes of address space, and do not live within limits.
#ifdef LIMBER_SANITIZED
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace limber::test
