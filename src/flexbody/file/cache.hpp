// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "flexbody/mesh_index.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/reduced_body.hpp"

namespace limber::flexbody {

/// A mesh that was made, ready to be reduced.
struct MeshAtHand {
  MeshRecord record;
  std::function<ReducedBody(const Recipe&)> reduce;
};

/// Who makes meshes and bodies; usually flexbody::make_reducer.
struct Reducer {
  /// Who makes meshes: the program and what else a mesh may depend on; empty
  /// if nobody can.
  std::string mesher;
  std::function<MeshAtHand(const MeshSource&)> make_mesh;
};

/// Hash of everything that shapes the reduced body: the recipe's values but its
/// name, the mesh, the format version.
/// @param mesh MeshRecord::content
[[nodiscard]] std::string content_key(const Recipe& recipe,
                                      const std::string& mesh);

/// Hash of what is asked, with the mesh by the place of its file: recipes of
/// one key ask for one body, as long as no file changes.
[[nodiscard]] std::string recipe_key(const Recipe& recipe);

/// Where reduced bodies are kept when a user names no place:
/// $LIMBER_CACHE, else $XDG_CACHE_HOME/limber, else $HOME/.cache/limber.
/// @throws InputError if none of them is set
[[nodiscard]] std::filesystem::path default_cache_folder();

struct CachedBody {
  ReducedBody body;
  bool was_cached = false;
  std::vector<std::string> notices;  ///< of its mesh
};

/// The body from the folder `cache`, by default default_cache_folder(), if it
/// is there and sound, else reduced and then kept. It is kept by what its mesh
/// is, so that equal meshes of whatever files share it. If the folder knows
/// which mesh would result (flexbody/mesh_index.hpp), none is made.
///
/// An entry that is damaged, another's, of another user or for others to
/// write is made anew; a folder that cannot be written only costs the speed-up.
/// Threads and processes may ask for one body at once: each may reduce it, and
/// each gets it whole.
/// @throws what the reducer throws: InputError if the mesh cannot be made; as
/// default_cache_folder()
[[nodiscard]] CachedBody load_or_reduce(const Recipe& recipe,
                                        const std::filesystem::path& cache,
                                        const Reducer& reducer);

}  // namespace limber::flexbody
