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
  /// What the bodies fall short of, and notices of their meshes.
  std::vector<std::string> warnings;
  KnownBodies known;  ///< those given, reduced and cached
};

/// Reduced bodies of all flexible links: from a file, from the cache, or from
/// `reducer`; links with equal recipes or one file share one. Those in `known`
/// are taken first.
/// @throws InputError naming the link.
[[nodiscard]] Reductions find_reductions(const Scene& scene,
                                         const Reducer& reducer,
                                         const std::filesystem::path& cache,
                                         const KnownBodies& known = {});

}  // namespace limber::scene
