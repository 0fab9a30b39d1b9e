// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/results/drawing/canvas.hpp"

namespace limber::results {

/// Source     PNG specification (ISO/IEC 15948)
/// @throws InputError if it cannot be written.
void write_png(const std::filesystem::path& file, const Canvas& canvas);

}  // namespace limber::results
