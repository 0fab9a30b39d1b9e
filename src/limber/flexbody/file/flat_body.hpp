// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// A reduced body as a flat file (common/files/flat_file.hpp) behind a seal of
/// its own, for the module of the playground, whose read_body reads it.
/// @throws InputError if it cannot be written.
void write_flat_body(const ReducedBody& body,
                     const std::filesystem::path& file);

}  // namespace limber::flexbody
