// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody::test {

/// A body of three nodes, two modes, two groups and one interface, in which
/// no two numbers are equal. It is not physical, which files do not require.
[[nodiscard]] ReducedBody make_small_body(unsigned seed);

/// Every field's name with all its sizes and bits.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> list_fields(
    const ReducedBody& body);

/// Name of the first field in which the two differ by as little as a bit, or
/// nothing.
[[nodiscard]] std::string find_difference(const ReducedBody& a,
                                          const ReducedBody& b);

}  // namespace limber::flexbody::test
