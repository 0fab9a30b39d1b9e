// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "limber/app/commands/commands.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/common/errors.hpp"
#include "limber/results/xdmf_file.hpp"
#include "limber/view/gltf.hpp"
#include "limber/view/moving_surface.hpp"

namespace limber::app {
namespace {

struct ExportOptions {
  std::string results;
  std::string out;
  double magnification = 1.0;
};

/// The data beside the file would replace the results if both had one name.
void check_data_file(const std::filesystem::path& file,
                     const std::filesystem::path& results) {
  std::filesystem::path data = file;
  data.replace_extension(".h5");
  std::error_code unknown;
  if (!std::filesystem::equivalent(data, view::find_results(results),
                                   unknown)) {
    return;
  }
  throw InputError(fmt::format(
      "-o {}: its data, {}, would replace the results; take another name",
      file.string(), data.string()));
}

void export_results(const ExportOptions& options) {
  const std::filesystem::path file = options.out;
  const bool is_xdmf = file.extension() == ".xdmf";
  if (!is_xdmf && file.extension() != ".glb") {
    throw InputError(
        fmt::format("-o {}: export writes .glb (binary glTF 2.0) or .xdmf (for "
                    "ParaView, with .h5 beside it)",
                    options.out));
  }
  if (is_xdmf && options.magnification != 1.0) {
    throw InputError(
        "--magnification is for .glb; ParaView magnifies by its filter Warp By "
        "Vector");
  }
  const view::Recording recording = view::read_recording(options.results);
  if (is_xdmf) {
    check_data_file(file, options.results);
    results::write_xdmf_file(file, view::gather_surfaces(recording));
  } else {
    view::write_gltf(file, recording, options.magnification);
  }
  fmt::print("{}\n", file.string());
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand(
      "export", "Write results as an animated glTF 2.0 scene or for ParaView");
  command
      ->add_option("results", options->results,
                   "Folder of a run, or its results.h5")
      ->required();
  command->add_option("-o,--out", options->out, "The file, .glb or .xdmf")
      ->required();
  command
      ->add_option("--magnification", options->magnification,
                   "Of the deformation in .glb (default: 1)")
      ->check(make_positive());
  command->callback(
      [&action, options] { action = [options] { export_results(*options); }; });
}

}  // namespace limber::app
