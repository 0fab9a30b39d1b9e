// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/mesh_locking.hpp"

#include <fmt/format.h>

namespace limber::flexbody {

std::optional<std::string> describe_locking(
    const std::optional<MeshLocking>& locking) {
  constexpr double kTolerable = 0.01;
  if (!locking || locking->error() <= kTolerable) return std::nullopt;
  return fmt::format(
      "the mesh has elements of first order, which are too stiff in bending: "
      "its first elastic frequency, {:.4g} Hz, is about {:.{}f} % too high "
      "({:.4g} Hz with second-order elements on the same mesh). Give the mesh "
      "order 2 (order=\"2\" of <mesh>, --order 2)",
      locking->frequency, 100.0 * locking->error(),
      locking->error() < 0.1 ? 1 : 0, locking->refined_frequency);
}

}  // namespace limber::flexbody
