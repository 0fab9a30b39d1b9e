// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/reduced_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::flexbody {

std::size_t find_interface(const ReducedBody& body, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    if (body.interfaces[i].name == name) return i;
    known.push_back(body.interfaces[i].name);
  }
  throw InputError(fmt::format("body '{}': {}", body.name,
                               describe_unknown("interface", name, known)));
}

std::size_t find_row(const ReducedBody& body, std::size_t tag) {
  const std::vector<std::size_t>& tags = body.rows.tags;
  const auto found = std::find(tags.begin(), tags.end(), tag);
  if (found != tags.end())
    return static_cast<std::size_t>(found - tags.begin());
  throw InputError(fmt::format(
      "body '{}': node {} is not among the {} nodes that it keeps. Name a "
      "node of an interface or of the surface, or keep all rows.",
      body.name, tag, tags.size()));
}

std::size_t find_nearest_row(const ReducedBody& body, const Vector3& point_M) {
  if (body.rows.tags.empty())
    throw InputError(fmt::format(
        "body '{}' keeps no nodes; keep those of its surface.", body.name));
  const Vector3 point_B = point_M - body.p_MoBcm_M;
  Eigen::Index nearest = 0;
  (body.rows.x_B.colwise() - point_B)
      .colwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return static_cast<std::size_t>(nearest);
}

}  // namespace limber::flexbody
