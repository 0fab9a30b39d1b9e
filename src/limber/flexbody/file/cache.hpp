// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limber/flexbody/file/mesh_index.hpp"
#include "limber/flexbody/file/shipped_mesh.hpp"
#include "limber/flexbody/model/piece.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// A finished mesh, ready to be reduced.
struct MeshAtHand {
  MeshRecord record;
  std::function<ReducedBody(const Recipe&)> reduce;
  /// A piece of it, whose content is find_piece_content(). Null if this program
  /// cannot cut.
  std::function<MeshAtHand(const Piece&)> take_piece = {};
  std::function<PieceAdvice()> advise_pieces = {};
};

/// Identifies a piece of a mesh. @param mesh MeshRecord::content
[[nodiscard]] std::string find_piece_content(const std::string& mesh,
                                             const Piece& piece);

/// Functions that make meshes and bodies; usually flexbody::make_reducer.
struct Reducer {
  /// Identifies the mesher: the program and whatever else a mesh may depend on;
  /// empty if there is none.
  std::string mesher;
  std::function<MeshAtHand(const MeshSource&)> make_mesh;
};

/// Hash of everything that determines the reduced body: the recipe's values
/// except its name and whether stress modes are needed, the mesh, the format
/// version.
/// @param mesh MeshRecord::content
[[nodiscard]] std::string content_key(const Recipe& recipe,
                                      const std::string& mesh);

/// Hash of the whole request, stress modes too, with the mesh identified by its
/// file's path: recipes of one key give the same body as long as no file
/// changes.
[[nodiscard]] std::string recipe_key(const Recipe& recipe,
                                     const Piece& piece = {});

/// Default folder of the cache: $LIMBER_CACHE, else $XDG_CACHE_HOME/limber,
/// else $HOME/.cache/limber.
/// @throws InputError if none of them is set
[[nodiscard]] std::filesystem::path default_cache_folder();

struct CachedBody {
  ReducedBody body;
  bool was_cached = false;
  std::vector<std::string> notices;  ///< of its mesh
  std::vector<std::string>
      found;  ///< a line for each file of matrices, or material of a deck
};

/// Loads the body from the folder `cache`, by default default_cache_folder(),
/// or reduces it and stores it there. The key contains the mesh's content, so
/// that equal meshes from different files share an entry. If the folder records
/// which mesh would result (flexbody/file/mesh_index.hpp), none is made; nor if
/// the body came with Limber, in the folder `shipped`
/// (flexbody/file/shipped_mesh.hpp).
/// Entries have stress modes whether the recipe requires them or not, except
/// with second-order kinematics; one without is replaced when they are needed.
///
/// An entry that is damaged, has another key, belongs to another user or is
/// writable by others is replaced; a folder that cannot be written only loses
/// the speed-up. Safe for concurrent threads and processes: each may reduce the
/// body, and each gets it complete.
/// @throws what the reducer throws: InputError if the mesh cannot be made; as
/// default_cache_folder()
[[nodiscard]] CachedBody load_or_reduce(
    const Recipe& recipe, const std::filesystem::path& cache,
    const Reducer& reducer, const Piece& piece = {},
    const std::filesystem::path& shipped = find_shipped_bodies());

}  // namespace limber::flexbody
