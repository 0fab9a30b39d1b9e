// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::scene {

/// Nodal forces over time, as a text file of numbers: the first row the times
/// from which each column of forces applies [s], then a row for each free
/// degree of freedom [N], x, y, z node by node in the order of the mesh's tags.
///
/// Source     Appendix A of the WOBBLE report (EPFL LSMS, 2023).
struct ForceFile {
  std::vector<double> times;  ///< T, increasing [s]
  MatrixX forces;             ///< free degrees of freedom x T [N]
};

/// Omits columns equal to the previous one.
/// @throws InputError with file and line: a row of another length, times that
/// do not increase, an entry that is not a finite number.
[[nodiscard]] ForceFile read_force_file(const std::filesystem::path& file);

/// A nodal field, as a text file of numbers: a row for each free degree of
/// freedom with one value, in the order of a force file and without its times.
/// Displacements [m] or velocities [m/s], mesh frame.
/// @throws InputError with file and line.
[[nodiscard]] VectorX read_nodal_field(const std::filesystem::path& file);

}  // namespace limber::scene
