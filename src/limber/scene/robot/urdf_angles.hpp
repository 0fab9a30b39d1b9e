// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <optional>
#include <string>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// One question for all `rpy` of a robot's file with an angle beyond a full
/// turn, about the first of them, by its line.
[[nodiscard]] std::optional<std::string> question_rpy(const TiXmlElement& robot,
                                                      const Problems& problems);

}  // namespace limber::scene
