// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/help_text.hpp"

#include "limber/app/build_options.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/kernels/processor.hpp"
#include "limber/version.hpp"

namespace limber::app {
namespace {

// Or why a run will not begin.
std::string describe_instructions() {
  try {
    return std::string(
        dynamics::kernels::describe(dynamics::kernels::find_instructions()));
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

std::string describe_build() {
  return "limber " LIMBER_VERSION
         "\n"
         "build                " LIMBER_BUILD_TYPE ", " LIMBER_BUILD_COMPILER
         "\n"
         "BUILD_SHARED_LIBS    " LIMBER_BUILD_SHARED
         "\n"
         "LIMBER_REDUCTION     " LIMBER_BUILD_REDUCTION
         "  (meshes and reductions: Gmsh, CHOLMOD)\n"
         "LIMBER_REFERENCE     " LIMBER_BUILD_REFERENCE
         "  (limber verify: Simbody)\n"
         "LIMBER_SANITIZE      " LIMBER_BUILD_SANITIZE
         "\n"
         "LIMBER_SIMD          " +
         describe_instructions();
}

std::string describe_citation() {
  return "@software{limber,\n"
         "  author  = {{The Limber authors}},\n"
         "  title   = {Limber: simulation of flexible capture arms with "
         "contact},\n"
         "  version = {" LIMBER_VERSION
         "},\n"
         "  date    = {" LIMBER_RELEASED
         "},\n"
         "}";
}

std::string describe_surroundings() {
  return "Environment:\n"
         "  LIMBER_CACHE    folder of reduced bodies that are kept between "
         "runs, unless\n"
         "                  --cache is given; without it limber in "
         "XDG_CACHE_HOME, else\n"
         "                  .cache/limber in HOME (see limber cache)\n"
         "  LIMBER_SIMD     instructions of a step's inner loops: baseline or "
         "avx2\n"
         "                  (default: what the processor has); results have "
         "the "
         "same bits\n"
         "  NO_COLOR        if not empty, messages have no colours\n"
         "  OPENBLAS_NUM_THREADS\n"
         "                  threads of linear algebra in reductions\n"
         "\n"
         "Exit status:\n"
         "  0    done\n"
         "  2    wrong input\n"
         "  3    a computation that failed\n"
         "  70   a defect of Limber\n"
         "  130, 143\n"
         "       ended by SIGINT, SIGTERM\n";
}

}  // namespace limber::app
