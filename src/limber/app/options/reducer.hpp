// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/common/progress.hpp"
#include "limber/reduction/mode_study.hpp"
#include "limber/runs/level_judgement.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/scene/build/full_bodies.hpp"
#include "limber/scene/build/reductions.hpp"

namespace limber::app {

/// flexbody::make_reducer; throws InputError in a build without Gmsh and
/// CHOLMOD.
[[nodiscard]] scene::Reducer make_reducer(const Progress& progress);

/// Both, for runs; the mesher's and reducer's progress is shown by `progress`.
/// @param cache empty for the default one
[[nodiscard]] runs::Reductions make_reductions(
    const std::filesystem::path& cache, const Progress& progress);

/// runs::advise_scene with them.
[[nodiscard]] runs::SceneAdvice advise(const scene::Scene& scene,
                                       const std::filesystem::path& cache,
                                       const Progress& progress);

/// flexbody::make_full_body, or nothing in a build without Gmsh and CHOLMOD.
[[nodiscard]] scene::FullMaker make_full_maker(const Progress& progress);

/// flexbody::study_modes (study_basis if its recipe `has_static` modes); throws
/// likewise.
[[nodiscard]] flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe,
                                                 bool has_static,
                                                 const Progress& progress);

/// flexbody::find_part_mass; throws likewise.
[[nodiscard]] flexbody::PartMass find_part_mass(const flexbody::Recipe& recipe,
                                                const Progress& progress);

}  // namespace limber::app
