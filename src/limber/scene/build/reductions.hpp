// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/modal/piece_check.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Makes meshes and reduced bodies; usually flexbody::make_reducer.
using Reducer = flexbody::Reducer;

/// Available reduced bodies, by flexbody::recipe_key of recipe and piece.
using KnownBodies =
    std::map<std::string, std::shared_ptr<const flexbody::ReducedBody>>;

struct Reductions {
  std::vector<ReducedPieces> of_link;
  int reduced = 0;  ///< number of reductions done now
  int cached = 0;   ///< number of reductions from the cache
  std::vector<flexbody::PieceCheck> piece_checks;  ///< of links in pieces
  /// Shortfalls of the bodies' bases, and notices of their meshes.
  std::vector<std::string> warnings;
  std::vector<std::string> found;  ///< of matrices: what each file is
  KnownBodies known;               ///< given, reduced and cached ones
};

/// Reduced bodies of all flexible links, of each of their pieces: from a file,
/// from the cache, or from `reducer`; links with equal recipes or one file
/// share one. Those in `known` take precedence.
/// @throws InputError naming the link.
[[nodiscard]] Reductions find_reductions(const Scene& scene,
                                         const Reducer& reducer,
                                         const std::filesystem::path& cache,
                                         const KnownBodies& known = {});

}  // namespace limber::scene
