// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// The reference motion of the linearisation, and remarks for the user.
struct FrequencyReport {
  std::string scenario;  ///< its file
  std::string name;
  dynamics::NaturalModes modes;
  VectorX undamped;  ///< natural frequencies without damping, increasing [Hz]
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< as scene::BuiltScene
};

/// Natural modes of a scene about its start.
/// @param cache empty for the default one
/// @throws as scene::build_system and dynamics::find_natural_modes
[[nodiscard]] FrequencyReport find_frequencies(
    const scene::Scene& scene, const std::filesystem::path& cache,
    const Progress& progress);

/// @param count most modes, from the lowest
[[nodiscard]] Json to_json(const FrequencyReport& report, int count);
[[nodiscard]] std::string to_text(const FrequencyReport& report, int count);

}  // namespace limber::app
