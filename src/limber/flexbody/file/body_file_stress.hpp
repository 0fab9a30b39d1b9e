// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/file/body_file_reader.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Stress modes in a body file; files of bodies without them have none of these
/// datasets.
namespace limber::flexbody {

/// Writes nothing if there are no stress modes.
void write_stress_modes(Hdf5File& out, const ReducedBody& body);

/// Which other optional tables a file with stress modes has.
struct OtherTables {
  bool surfaces = false;
  bool manifold = false;
};
[[nodiscard]] OtherTables read_other_tables(const BodyFileReader& reader);

/// Reads the stress modes of a body whose rows and interfaces are read.
/// @param products of paired modes, number
/// @param has_sections whether the body is of beams and shells
void read_stress_modes(const BodyFileReader& reader, Eigen::Index products,
                       bool has_sections, ReducedBody& body);

}  // namespace limber::flexbody
