// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/reducer.hpp"

#include "limber/common/errors.hpp"
#include "limber/runs/numbered_stages.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/reduce.hpp"
#endif

namespace limber::app {

runs::Reductions make_reductions(const std::filesystem::path& cache,
                                 const Progress& progress) {
  return {make_reducer(progress), cache, make_full_maker(progress)};
}

runs::SceneAdvice advise(const scene::Scene& scene,
                         const std::filesystem::path& cache,
                         const Progress& progress) {
  return runs::advise_scene(
      scene, make_reductions(cache, runs::number_stage(progress, 1, 2)),
      progress);
}

#ifdef LIMBER_HAS_REDUCTION

scene::Reducer make_reducer(const Progress& progress) {
  return flexbody::make_reducer(progress);
}

scene::FullMaker make_full_maker(const Progress& progress) {
  return [progress](const flexbody::Recipe& recipe,
                    const flexbody::FullOptions& options,
                    const flexbody::ReducedBody& reduced) {
    return flexbody::make_full_body(recipe, options, progress, &reduced);
  };
}

flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe,
                                   bool has_static, const Progress& progress) {
  return has_static ? flexbody::study_basis(recipe, progress)
                    : flexbody::study_modes(recipe, progress);
}

flexbody::PartMass find_part_mass(const flexbody::Recipe& recipe,
                                  const Progress& progress) {
  return flexbody::find_part_mass(recipe, progress);
}

#else

namespace {

[[noreturn]] void refuse(const flexbody::MeshSource& mesh) {
  throw InputError(mesh.file.string() +
                   ": this limber was built without meshing and reduction "
                   "(LIMBER_REDUCTION=OFF). Give a saved reduced body by "
                   "<reduced file=.../>, or add both: in Python by "
                   "'pip install limber[reduction]'.");
}

}  // namespace

scene::Reducer make_reducer(const Progress&) {
  return {"", [](const flexbody::MeshSource& mesh) -> flexbody::MeshAtHand {
            refuse(mesh);
          }};
}

scene::FullMaker make_full_maker(const Progress&) { return {}; }

flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe, bool,
                                   const Progress&) {
  refuse(recipe.mesh);
}

flexbody::PartMass find_part_mass(const flexbody::Recipe& recipe,
                                  const Progress&) {
  refuse(recipe.mesh);
}

#endif

}  // namespace limber::app
