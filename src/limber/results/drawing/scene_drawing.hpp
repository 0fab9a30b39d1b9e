// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/scene_view.hpp"

namespace limber::results {

/// A state of a scene, drawn in one colour.
struct Shot {
  std::string name;  ///< for the key
  std::vector<Surface> surfaces;
};

/// A plane without an end, fixed to the world.
struct EndlessPlane {
  Vector3 point = Vector3::Zero();  ///< [m]
  Vector3 normal = Vector3::UnitZ();
};

struct DrawnScene {
  std::string title;
  std::string note;         ///< below; may be empty
  std::vector<Shot> shots;  ///< the first of several is translucent
  std::vector<Surface> fixed;
  std::vector<EndlessPlane> planes;
  ViewAngles view;
};

/// Draws surfaces without perspective, lit from above the left shoulder, with
/// a key, the directions of the axes, and a scale bar, into a PNG of 1200 x
/// 1000 pixels. Planes are squares as large as the scene; those seen from below
/// are left out.
/// @throws InputError if the file cannot be written.
void write_scene(const std::filesystem::path& file, const DrawnScene& scene);

/// The length of a scale bar: the largest of 1, 2 and 5 times a power of ten
/// up to `longest` > 0 [m].
[[nodiscard]] double choose_bar(double longest);

}  // namespace limber::results
