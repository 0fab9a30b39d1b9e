// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "limber/scene/build/reductions.hpp"

namespace limber::runs {

/// Receives the time [s] of a body, with its mesh, by its content key.
using NoteSeconds = std::function<void(const std::string& key, double seconds)>;
/// `reducer`, with its times reported to `note`.
[[nodiscard]] scene::Reducer time_reductions(const scene::Reducer& reducer,
                                             const NoteSeconds& note);

}  // namespace limber::runs
