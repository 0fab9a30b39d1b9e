// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/app/console/json.hpp"
#include "limber/common/progress.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Reports of `limber info` for each kind of file.
namespace limber::app {

[[nodiscard]] Json describe_scenario(const std::filesystem::path& file);
/// With masses, of flexible links by their meshes.
[[nodiscard]] Json describe_robot(const std::filesystem::path& file,
                                  const Progress& progress);
[[nodiscard]] Json describe_checkpoint(const std::filesystem::path& file);
/// A reduced body or the results of a run.
[[nodiscard]] Json describe_hdf5(const std::filesystem::path& file);
/// @param unit metres per mesh unit [m].
[[nodiscard]] Json describe_mesh(const std::filesystem::path& file,
                                 double unit);

/// Adds the locking of its mesh, the selection of a body's modes and its
/// initial deformation, if any.
void add_choices(const flexbody::ReducedBody& body, Json& json);

}  // namespace limber::app
