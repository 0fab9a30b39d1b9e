// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace limber::fem {

/// What a keyword of Abaqus or CalculiX that is not read means for the body.
enum class KeywordEffect {
  on_body,    ///< a constraint, a mass, or another law of elements
  generator,  ///< makes or moves nodes and elements
  outside,    ///< support, load or start, which the scene has in its own way
  law,        ///< of materials, beside linear elasticity
  none,       ///< settings of analyses, output, what others refer to
  unknown     ///< of no known kind: it may be any of these
};

/// By its name. Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords
/// Reference Guide
[[nodiscard]] KeywordEffect find_keyword_effect(std::string_view name);

}  // namespace limber::fem
