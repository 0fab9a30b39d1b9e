// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/cholmod_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

// Its headers and its file's name count the same versions of the interface.
std::string find_name() {
  return fmt::format("libcholmod.so.{}", CHOLMOD_MAIN_VERSION);
}

[[noreturn]] void refuse() {
  const char* const why = dlerror();
  throw InputError(
      fmt::format("{} cannot be loaded; it is needed to make bodies from "
                  "meshes ({}). Install SuiteSparse's CHOLMOD.",
                  find_name(), why == nullptr ? "no reason given" : why));
}

template <typename Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) refuse();
}

CholmodLibrary load() {
  // Its BLAS is globally visible: SerialBlas looks it up by name.
  void* const library = dlopen(find_name().c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) refuse();
  CholmodLibrary found;
  find(library, "cholmod_start", found.start);
  find(library, "cholmod_finish", found.finish);
  find(library, "cholmod_metis", found.metis);
  find(library, "cholmod_amd", found.amd);
  find(library, "cholmod_analyze_p", found.analyze_p);
  find(library, "cholmod_factorize", found.factorize);
  find(library, "cholmod_solve2", found.solve2);
  find(library, "cholmod_free_dense", found.free_dense);
  find(library, "cholmod_free_factor", found.free_factor);
  return found;
}

}  // namespace

const CholmodLibrary& cholmod() {
  static const CholmodLibrary library = load();
  return library;
}

}  // namespace limber::fem
