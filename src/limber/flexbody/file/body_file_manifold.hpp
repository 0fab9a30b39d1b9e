// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/file/body_file_reader.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Second-order kinematics in a body file; files of bodies without it have none
/// of these datasets.
namespace limber::flexbody {

/// Writes nothing if there is no manifold.
void write_manifold(Hdf5File& out, const ReducedBody& body);

/// Whether a file with a manifold has contact surfaces, too.
[[nodiscard]] bool has_surfaces(const BodyFileReader& reader);

/// Products of paired modes in a file with a manifold of m modes.
[[nodiscard]] Eigen::Index count_products(const BodyFileReader& reader,
                                          Eigen::Index m);

/// Reads the manifold, and its part of the interfaces, which exist.
void read_manifold(const BodyFileReader& reader, ReducedBody& body);

}  // namespace limber::flexbody
