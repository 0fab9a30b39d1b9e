// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/load_modes_record.hpp"

#include <fmt/format.h>

namespace limber::flexbody {

std::optional<std::string> describe_left_out(const LoadModesRecord& record) {
  constexpr double kLeast = 5e-5;  // less is 0.00 %
  if (record.is_whole && record.left_out < kLeast) return {};
  return fmt::format(
      "nodal forces '{}' deform the body in {}{} independent ways; only the {} "
      "largest become static-deformation modes. The others have {:.3g} % of "
      "the static responses (norm of elastic energy){}; modes of a load that "
      "moves over the body are better made by interfaces along its path.",
      record.name, record.is_whole ? "" : "more than ", record.directions,
      record.taken, 100.0 * record.left_out,
      record.is_whole ? "" : ", not counting those that were not examined");
}

}  // namespace limber::flexbody
