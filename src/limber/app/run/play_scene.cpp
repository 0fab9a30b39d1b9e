// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/play_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <map>
#include <set>
#include <string>
#include <variant>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/play_controls.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/files/scratch_folder.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/flexbody/file/flat_body.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/reductions.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

constexpr InputKind kSceneFile = {"file of a scene", std::uint64_t{1} << 28};
constexpr InputKind kFlatBody = {"flat body", std::uint64_t{1} << 31};
constexpr std::size_t kMostOutputs = 200;

/// Paths of the files that a scene reads, except for meshes of flexible links.
std::set<fs::path> list_files(const scene::Scene& scene) {
  std::set<fs::path> files = {scene.scenario.file};
  if (!scene.scenario.robot.empty()) files.insert(scene.scenario.robot);
  for (const scene::RobotSpec& robot : scene.scenario.robots) {
    files.insert(robot.file);
  }
  const auto add_mesh = [&](const scene::Geometry& geometry) {
    if (const auto* mesh = std::get_if<scene::MeshGeometry>(&geometry)) {
      files.insert(mesh->file);
    }
  };
  for (const scene::Link& link : scene.robot.links) {
    for (const auto& shape : link.visuals) add_mesh(shape.geometry);
    for (const auto& shape : link.collisions) add_mesh(shape.geometry);
  }
  for (const auto& obstacle : scene.scenario.obstacles) {
    add_mesh(obstacle.geometry);
  }
  return files;
}

fs::path find_shared_folder(const std::set<fs::path>& files) {
  fs::path shared = files.begin()->parent_path();
  for (const fs::path& file : files) {
    while (!shared.empty() && shared != shared.root_path() &&
           file.lexically_relative(shared).string().starts_with("..")) {
      shared = shared.parent_path();
    }
  }
  return shared;
}

/// At their places relative to each other; paths of this machine stay here.
void add_files(const scene::Scene& scene, view::Playground& playground) {
  std::map<fs::path, fs::path> given;
  std::set<fs::path> all;
  for (const fs::path& file : list_files(scene)) {
    const fs::path whole = fs::absolute(file).lexically_normal();
    given[whole] = file;
    all.insert(whole);
  }
  const fs::path shared = find_shared_folder(all);
  const auto place_of = [&](const fs::path& whole) {
    return "/scene/" + whole.lexically_relative(shared).generic_string();
  };
  for (const fs::path& whole : all) {
    playground.files[place_of(whole)] = read_input(given[whole], kSceneFile);
  }
  playground.scenario =
      place_of(fs::absolute(scene.scenario.file).lexically_normal());
}

void add_bodies(const scene::Scene& scene,
                const std::vector<scene::ReducedPieces>& bodies,
                view::Playground& playground) {
  const ScratchFolder scratch(fs::temp_directory_path() / "limber-play-");
  std::map<const flexbody::ReducedBody*, std::string> written;
  for (std::size_t i = 0; i < scene.robot.links.size(); ++i) {
    const scene::ReducedPieces& pieces = bodies[i];
    if (pieces.empty()) continue;
    const std::string& link = scene.robot.links[i].name;
    if (pieces.size() > 1) {
      throw InputError(fmt::format(
          "link '{}' is in {} pieces; a page simulates links of one", link,
          pieces.size()));
    }
    std::string& name = written[pieces.front().get()];
    if (name.empty()) {
      name = fmt::format("/bodies/{}", written.size());
      const fs::path file = scratch.path() / "body";
      flexbody::write_flat_body(*pieces.front(), file);
      playground.files[name] = read_input(file, kFlatBody);
    }
    playground.bodies[link] = name;
  }
}

void refuse_full(const scene::Scene& scene) {
  for (const scene::Link& link : scene.robot.links) {
    if (!link.flexible ||
        scene.scenario.level_of(link.name) != dynamics::Fidelity::full) {
      continue;
    }
    throw InputError(
        fmt::format("link '{}' has level full, for which a page lacks the "
                    "mesh; choose another level",
                    link.name));
  }
}

[[noreturn]] void refuse_needs(const std::string& what) {
  throw InputError(
      fmt::format("a page contains only the scenario, its robots and the "
                  "meshes of their shapes; this scene also needs: {}",
                  what));
}

/// Files of fields on nodes, which are read with a mesh.
void refuse_nodal_files(const scene::Scenario& scenario) {
  for (const scene::LoadSpec& load : scenario.loads) {
    if (!load.nodal_forces.empty()) refuse_needs(load.nodal_forces.string());
  }
  for (const auto& [link, start] : scenario.link_starts) {
    for (const fs::path& file : {start.displacement, start.velocity}) {
      if (!file.empty()) refuse_needs(file.string());
    }
  }
}

/// Whether the page's files are all that the scene needs, and its settings are
/// possible: it is read from a copy of them alone.
void check_whole(const view::Playground& playground) {
  const ScratchFolder scratch(fs::temp_directory_path() / "limber-play-");
  const auto place_of = [&](const std::string& name) {
    return scratch.path() / fs::path(name).relative_path();
  };
  for (const auto& [name, content] : playground.files) {
    fs::create_directories(place_of(name).parent_path());
    write_whole(place_of(name), content);
  }
  scene::Overrides overrides;
  for (const std::string& setting : playground.settings) {
    overrides.settings.push_back(scene::parse_setting(setting));
  }
  try {
    (void)scene::load_scene(place_of(playground.scenario), overrides);
  } catch (const InputError& error) {
    refuse_needs(error.what());
  }
}

/// A page shows no more outputs than it can draw at once. Which are fewer of
/// those that the file lists, or at an interval.
std::vector<std::string> limit_outputs(const scene::Scene& scene) {
  const auto& times = scene.scenario.settings.output_times;
  if (times.size() <= kMostOutputs + 1) return {};
  const auto file = toml::parse_file(scene.scenario.file.string());
  if (!file["time"]["output_times"]) {
    const double duration = times.back() - times.front();
    return {fmt::format("time.output_interval={}", duration / kMostOutputs)};
  }
  std::vector<double> kept;
  for (std::size_t i = 0; i <= kMostOutputs; ++i) {
    kept.push_back(times[i * (times.size() - 1) / kMostOutputs]);
  }
  return {fmt::format("time.output_times=[{}]", fmt::join(kept, ", "))};
}

}  // namespace

view::Playground make_playground(const scene::Scene& scene,
                                 const std::filesystem::path& cache,
                                 const Progress& progress) {
  refuse_full(scene);
  refuse_nodal_files(scene.scenario);
  view::Playground playground;
  playground.name = scene.scenario.name;
  playground.settings = limit_outputs(scene);
  for (const scene::Setting& setting : scene.overrides.settings) {
    if (setting.value) {
      playground.settings.push_back(setting.path + "=" + *setting.value);
    }
  }
  add_files(scene, playground);
  check_whole(playground);
  view::find_playground();  // before bodies are reduced
  const auto bodies =
      scene::find_reductions(scene, make_reducer(progress), cache).of_link;
  add_bodies(scene, bodies, playground);
  playground.controls = list_controls(scene, bodies);
  playground.has_rigid = !playground.bodies.empty();
  return playground;
}

}  // namespace limber::app
