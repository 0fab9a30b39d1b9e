// SPDX-License-Identifier: BSD-3-Clause
#include "app/reducer.hpp"

#include "common/errors.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "flexbody/fem_full_body.hpp"
#include "flexbody/reduce.hpp"
#endif

namespace limber::app {

#ifdef LIMBER_HAS_REDUCTION

scene::Reducer make_reducer(const Progress& progress) {
  return [progress](const flexbody::Recipe& recipe) {
    return flexbody::reduce(recipe, progress);
  };
}

scene::FullMaker make_full_maker(const Progress& progress) {
  return [progress](const flexbody::Recipe& recipe,
                    const flexbody::FullOptions& options) {
    return flexbody::make_full_body(recipe, options, progress);
  };
}

flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe,
                                   bool has_static, const Progress& progress) {
  return has_static ? flexbody::study_basis(recipe, progress)
                    : flexbody::study_modes(recipe, progress);
}

#else

namespace {

[[noreturn]] void refuse(const flexbody::Recipe& recipe) {
  throw InputError(recipe.mesh.file.string() +
                   ": this limber was built without meshing and reduction "
                   "(LIMBER_REDUCTION=OFF); give a saved reduced body by "
                   "<reduced file=.../>");
}

}  // namespace

scene::Reducer make_reducer(const Progress&) {
  return [](const flexbody::Recipe& recipe) -> flexbody::ReducedBody {
    refuse(recipe);
  };
}

scene::FullMaker make_full_maker(const Progress&) { return {}; }

flexbody::ModeStudy run_mode_study(const flexbody::Recipe& recipe, bool,
                                   const Progress&) {
  refuse(recipe);
}

#endif

}  // namespace limber::app
