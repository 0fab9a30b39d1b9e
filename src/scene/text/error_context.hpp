// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/errors.hpp"

namespace limber::scene {

/// Runs `work`; what it refuses is told with `who` in front.
template <typename Work>
auto naming(const std::string& who, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    std::vector<std::string> texts;
    for (const std::string& text : error.problems()) {
      texts.push_back(who + ": " + text);
    }
    throw InputError(texts);
  }
}

}  // namespace limber::scene
