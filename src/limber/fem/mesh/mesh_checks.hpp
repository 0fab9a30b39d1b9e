// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Node positions of one element, 3 x nodes [m].
[[nodiscard]] Matrix3X element_positions(const Mesh& mesh,
                                         const ElementBlock& block,
                                         std::size_t element);

/// Whether the element is an affine image of its reference element, so that
/// its Jacobian is constant.
[[nodiscard]] bool is_parallel_sided(const ReferenceElement& element,
                                     const Matrix3X& x);

/// A face that two elements share, once as a face of each.
using SharedFace = std::array<BoundaryFace, 2>;
[[nodiscard]] std::vector<SharedFace> find_shared_faces(const Mesh& mesh);

/// Fills boundary_faces and boundary_nodes: faces of exactly one element.
/// @throws InputError if more than two elements share a face.
void find_boundary(Mesh& mesh);

/// @throws InputError for elements that are inverted or degenerate (with tag
/// and Jacobian), for boundary faces that share three corners but not all, for
/// shared faces whose mid-side nodes differ, and for a mesh in several parts
/// that share no face.
void check_elements(const Mesh& mesh);
void check_faces(const Mesh& mesh);
void check_connected(const Mesh& mesh);

}  // namespace limber::fem
