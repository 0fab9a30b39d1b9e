// SPDX-License-Identifier: BSD-3-Clause
#include "app/reducer.hpp"

#include "common/errors.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "flexbody/reduce.hpp"
#endif

namespace limber::app {

scene::Reducer make_reducer(const Progress& progress) {
#ifdef LIMBER_HAS_REDUCTION
  return [progress](const flexbody::Recipe& recipe) {
    return flexbody::reduce(recipe, progress);
  };
#else
  (void)progress;
  return [](const flexbody::Recipe& recipe) -> flexbody::ReducedBody {
    throw InputError(recipe.mesh.file.string() +
                     ": this limber was built without meshing and reduction "
                     "(LIMBER_REDUCTION=OFF); give a saved reduced body by "
                     "<reduced file=.../>");
  };
#endif
}

}  // namespace limber::app
