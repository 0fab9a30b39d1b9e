// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/app/commands/verify_command.hpp"

namespace limber::app {

/// Runs `limber verify`. @throws InputError, NumericalError
/// as reading, building and simulating the scene do
void verify(const VerifyOptions& options);

}  // namespace limber::app
