// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/unused_cache.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"

namespace limber::runs {

void warn_of_unused_cache(const std::filesystem::path& cache,
                          scene::BuiltScene& built) {
  if (cache.empty() || built.bodies_reduced + built.bodies_cached > 0) return;
  built.warnings.push_back(
      fmt::format("--cache '{}' changes nothing: no link has a mesh",
                  echo(cache.string())));
}

}  // namespace limber::runs
