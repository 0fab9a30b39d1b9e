// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "flexbody/recipe.hpp"
#include "flexbody/reduced_body.hpp"

namespace limber::flexbody {

/// Hash of everything that shapes the reduced body: the recipe's values but its
/// name, the bytes of the mesh file and of the files that a .geo names word for
/// word, there or not, the format version. Of a .geo that puts names together
/// as it runs the key is one of this run of the program, and nothing is kept.
/// @throws InputError if the mesh file cannot be read.
[[nodiscard]] std::string content_key(const Recipe& recipe);

/// Where reduced bodies are kept when a user names no place:
/// $LIMBER_CACHE, else $XDG_CACHE_HOME/limber, else $HOME/.cache/limber.
/// @throws InputError if none of them is set
[[nodiscard]] std::filesystem::path default_cache_folder();

/// The body from `folder` if it is there and sound, else from `reduce`, then
/// kept. An entry that is damaged, another's, of another user or for others to
/// write is made anew; a folder that cannot be written only costs the speed-up.
/// Threads and processes may ask for one body at once: each may reduce it, and
/// each gets it whole.
struct CachedBody {
  ReducedBody body;
  bool was_cached = false;
};
[[nodiscard]] CachedBody load_or_reduce(
    const Recipe& recipe, const std::filesystem::path& folder,
    const std::function<ReducedBody(const Recipe&)>& reduce);

}  // namespace limber::flexbody
