// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/run_manifest.hpp"

#include "limber/common/files/build_id.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/integrators/settings_fields.hpp"
#include "limber/scene/probes/probe_fields.hpp"
#include "limber/version.hpp"

namespace limber::runs {

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

}  // namespace limber::runs
