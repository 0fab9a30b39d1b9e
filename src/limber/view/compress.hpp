// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::view {

/// zlib's format. @throws ContractError if memory is short.
[[nodiscard]] std::string compress(const std::string& bytes);

}  // namespace limber::view
