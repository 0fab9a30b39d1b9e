// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/scene_loading.hpp"

#include <algorithm>
#include <iterator>

#include "limber/app/console/terminal.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {

scene::Scene load_with_notes(const std::filesystem::path& file,
                             const scene::Overrides& overrides) {
  scene::Scene scene = scene::load_scene(file, overrides);
  print_notes(scene.scenario.notes);
  return scene;
}

void print_more_notes(const scene::Scene& scene,
                      const std::vector<std::string>& notes) {
  const std::vector<std::string>& printed = scene.scenario.notes;
  std::vector<std::string> more;
  std::copy_if(notes.begin(), notes.end(), std::back_inserter(more),
               [&](const std::string& text) {
                 return std::find(printed.begin(), printed.end(), text) ==
                        printed.end();
               });
  print_notes(more);
}

}  // namespace limber::app
