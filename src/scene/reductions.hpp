// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/body_plan.hpp"
#include "scene/scene.hpp"

namespace limber::scene {

struct Reductions {
  std::vector<ReducedPointer> of_link;  ///< null where the link is rigid
  int reduced = 0;
  int cached = 0;
  std::vector<std::string> warnings;  ///< what the bodies fall short of
};

/// Reduced bodies of all flexible links: from a file, from the cache, or from
/// `reducer`; links with equal recipes or one file share one.
/// @throws InputError naming the link.
[[nodiscard]] Reductions find_reductions(const Scene& scene,
                                         const Reducer& reducer,
                                         const std::filesystem::path& cache);

}  // namespace limber::scene
