// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "limber/app/commands/commands.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/common/errors.hpp"
#include "limber/view/gltf.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string results;
  std::string out;
  double magnification = 1.0;
};

void export_results(const Options& options) {
  const std::filesystem::path file = options.out;
  if (file.extension() != ".glb") {
    throw InputError(fmt::format(
        "-o {}: export writes .glb (binary glTF 2.0); for ParaView take "
        "`limber run --xdmf`",
        options.out));
  }
  view::write_gltf(file, view::read_recording(options.results),
                   options.magnification);
  fmt::print("{}\n", file.string());
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "export", "Write results as an animated glTF 2.0 scene");
  command
      ->add_option("results", options->results,
                   "Folder of a run, or its results.h5")
      ->required();
  command->add_option("-o,--out", options->out, "The file, .glb")->required();
  command
      ->add_option("--magnification", options->magnification,
                   "Of the deformation (default: 1)")
      ->check(make_positive());
  command->callback(
      [&action, options] { action = [options] { export_results(*options); }; });
}

}  // namespace limber::app
