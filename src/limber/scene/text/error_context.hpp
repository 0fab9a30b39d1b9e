// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::scene {

/// Runs `work` and prefixes its InputError with `who`.
template <typename Work>
auto with_context(const std::string& who, const Work& work) {
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
