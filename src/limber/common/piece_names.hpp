// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Names of the bodies of a link in pieces: "arm.1", "arm.2", ...
namespace limber {

/// @param piece counted from zero
[[nodiscard]] std::string name_piece(const std::string& link, int piece);

/// The link of a body with the name of a piece, else the body's own name.
[[nodiscard]] std::string find_whole(const std::string& body);

}  // namespace limber
