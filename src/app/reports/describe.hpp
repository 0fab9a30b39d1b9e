// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "app/json.hpp"
#include "flexbody/reduced_body.hpp"

/// What `limber info` tells about each kind of file.
namespace limber::app {

[[nodiscard]] Json describe_scenario(const std::filesystem::path& file);
[[nodiscard]] Json describe_robot(const std::filesystem::path& file);
[[nodiscard]] Json describe_checkpoint(const std::filesystem::path& file);
/// A reduced body or the results of a run.
[[nodiscard]] Json describe_hdf5(const std::filesystem::path& file);
/// @param unit metres per mesh unit [m].
[[nodiscard]] Json describe_mesh(const std::filesystem::path& file,
                                 double unit);

/// Adds how a body's modes were chosen and what it starts with, if at all.
void add_choices(const flexbody::ReducedBody& body, Json& json);

}  // namespace limber::app
