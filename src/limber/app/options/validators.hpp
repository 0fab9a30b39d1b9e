// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace limber::app {

/// Accepts finite positive numbers, with a message for others.
[[nodiscard]] CLI::Validator make_positive();
/// The same for non-negative numbers.
[[nodiscard]] CLI::Validator make_not_negative();

}  // namespace limber::app
