// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace limber::app {

/// Accepts finite numbers above zero; says so where the value is another.
[[nodiscard]] CLI::Validator make_positive();
/// The same for numbers that are not below zero.
[[nodiscard]] CLI::Validator make_not_negative();

}  // namespace limber::app
