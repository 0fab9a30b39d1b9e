// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_manifest.hpp"

#include "common/build_id.hpp"
#include "dynamics/archives.hpp"
#include "scene/fields.hpp"

namespace limber::app {

Manifest make_manifest(const scene::Scene& scene,
                       const scene::BuiltScene& built) {
  Manifest manifest;
  manifest.add("version of Limber", std::string_view(LIMBER_VERSION));
  manifest.add("build of Limber", find_build_id());
  describe(manifest, "settings", built.settings);
  describe(manifest, "level full", scene.scenario.full);
  describe(manifest, "", built.model);
  describe(manifest, "probes", built.probes);
  describe(manifest, "start", built.initial);
  return manifest;
}

}  // namespace limber::app
