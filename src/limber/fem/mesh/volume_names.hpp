// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Names of all volume groups, each once.
[[nodiscard]] inline std::set<std::string> find_volume_names(const Mesh& mesh) {
  std::set<std::string> all;
  for (const auto& names : mesh.volume_groups)
    all.insert(names.begin(), names.end());
  return all;
}

}  // namespace limber::fem
