// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/fem/mesh/reference_element.hpp"

namespace limber::fem {

/// Corners of the beams or shells of first order that an element of a curve or
/// surface is made into, in its order of nodes: itself, or, of second order,
/// two, or four, with its mid-side (and middle) nodes.
/// @param place of the element, for messages
/// @throws InputError for another order, and for eight nodes on a quadrilateral
[[nodiscard]] const std::vector<std::vector<int>>& list_element_parts(
    const ReferenceElement& element, const std::string& place);

}  // namespace limber::fem
