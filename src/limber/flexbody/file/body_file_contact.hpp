// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/file/body_file_reader.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

/// Contact surfaces in a body file; files of bodies without them have none of
/// these datasets.
namespace limber::flexbody {

/// Writes nothing if there are no surfaces.
void write_contact_surfaces(Hdf5File& out,
                            const std::vector<ContactSurface>& surfaces);

/// @param m number of modes; @param products of paired modes, 0 without a
/// manifold
[[nodiscard]] std::vector<ContactSurface> read_contact_surfaces(
    const BodyFileReader& reader, Eigen::Index m, Eigen::Index products);

}  // namespace limber::flexbody
