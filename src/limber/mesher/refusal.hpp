// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace limber::mesher {

/// Ends the process: the file is not allowed to do `what`.
[[noreturn]] void refuse(std::string_view what);

}  // namespace limber::mesher
