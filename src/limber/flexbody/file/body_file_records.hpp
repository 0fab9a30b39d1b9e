// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/flexbody/file/body_file_reader.hpp"
#include "limber/flexbody/model/initial_deformation.hpp"
#include "limber/flexbody/model/load_modes_record.hpp"
#include "limber/flexbody/model/mesh_locking.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/flexbody/model/selection_record.hpp"

/// Further content of a body file: how the modes were chosen, and the initial
/// deformation.
namespace limber::flexbody {

void write_selection(Hdf5File& out,
                     const std::optional<SelectionRecord>& selection);
[[nodiscard]] std::optional<SelectionRecord> read_selection(
    const BodyFileReader& reader);

void write_locking(Hdf5File& out, const std::optional<MeshLocking>& locking);
/// None if the body has no record of it.
[[nodiscard]] std::optional<MeshLocking> read_locking(
    const BodyFileReader& reader);

void write_inertia_record(Hdf5File& out, const InertiaRecord& record);
/// Empty if the body has no record of it.
[[nodiscard]] InertiaRecord read_inertia_record(const BodyFileReader& reader);

void write_load_modes(Hdf5File& out,
                      const std::vector<LoadModesRecord>& records);
[[nodiscard]] std::vector<LoadModesRecord> read_load_modes(
    const BodyFileReader& reader);

/// @param at group, ending in a slash; @param unit of the coordinates
void write_field(Hdf5File& out, const std::string& at,
                 const std::optional<ProjectedField>& projected,
                 const std::string& unit);
/// @param m number of modes
[[nodiscard]] std::optional<ProjectedField> read_field(
    const BodyFileReader& reader, const std::string& at, Eigen::Index m);

}  // namespace limber::flexbody
