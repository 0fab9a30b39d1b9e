// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/reports/describe.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/results/checkpoint_file.hpp"

namespace limber::app {
namespace {

struct InfoOptions {
  std::string file;
  double unit = 0.0;
  bool json = false;
};

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

Json describe(const InfoOptions& options) {
  if (!std::filesystem::exists(options.file)) {
    throw InputError(fmt::format("{}: no such file", options.file));
  }
  const std::string extension = extension_of(options.file);
  const auto& meshes = fem::kMeshFileExtensions;
  const bool is_mesh = std::count(meshes.begin(), meshes.end(), extension) > 0;
  if (options.unit > 0.0 && !is_mesh) {
    throw InputError(fmt::format(
        "--unit applies to a mesh, and '{}' is not a mesh; leave it out",
        options.file));
  }
  if (results::is_checkpoint_file(options.file)) {
    return describe_checkpoint(options.file);
  }
  if (extension == ".toml") return describe_scenario(options.file);
  if (extension == ".urdf" || extension == ".xml") {
    const Json robot = describe_robot(options.file, make_progress_bar());
    clear_progress_bar();
    return robot;
  }
  if (extension == ".h5" || extension == ".hdf5") {
    return describe_hdf5(options.file);
  }
  if (is_mesh) return describe_mesh(options.file, options.unit);
  throw InputError(
      fmt::format("{}: info knows .toml, .urdf and .h5 files, checkpoints, and "
                  "meshes: {}",
                  options.file, fmt::join(meshes, ", ")));
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand(
      "info", "Describe a mesh, reduced body, scenario, robot or results file");
  command->add_option("file", options->file, "File")->required();
  add_unit(*command, options->unit);
  add_json(*command, options->json);
  command->callback([&action, options] {
    action = [options] {
      const Json json = describe(*options);
      fmt::print("{}\n", options->json ? to_text(json) : outline(json));
    };
  });
}

}  // namespace limber::app
