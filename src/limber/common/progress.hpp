// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

namespace limber {

/// Called during long work with the current task and the fraction done, in
/// [0, 1] [-]. May be empty.
using Progress = std::function<void(std::string_view what, double fraction)>;

inline void report(const Progress& progress, std::string_view what,
                   double fraction) {
  if (progress) progress(what, fraction);
}

}  // namespace limber
