// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limber::app {

/// Each text once, in the order in which they come first. What is equal except
/// for the name that it begins with, "link 'NAME': ...", is one text for all
/// names, "links 'a', 'b': ..."; further ones are counted.
[[nodiscard]] std::vector<std::string> group_texts(
    const std::vector<std::string>& texts);

}  // namespace limber::app
