// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/progress.hpp"
#include "flexbody/reduce_mode_study.hpp"
#include "scene/scene.hpp"

namespace limber::app {

/// flexbody::make_reducer, or a refusal in a build without Gmsh and CHOLMOD.
[[nodiscard]] scene::Reducer make_reducer(const Progress& progress);

/// Notes how long a body took, with its mesh [s], by its content key.
using NoteSeconds = std::function<void(const std::string& key, double seconds)>;
/// `reducer`, watched.
[[nodiscard]] scene::Reducer time_reductions(const scene::Reducer& reducer,
                                             const NoteSeconds& note);

/// flexbody::make_full_body, or nothing in a build without Gmsh and CHOLMOD.
[[nodiscard]] scene::FullMaker make_full_maker(const Progress& progress);

/// flexbody::study_modes (study_basis if its recipe `has_static` modes), or the
/// same refusal.
[[nodiscard]] flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe,
                                                 bool has_static,
                                                 const Progress& progress);

}  // namespace limber::app
