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
#include "limber/common/files/whole_file.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/results/bodies/body_files.hpp"
#include "limber/results/bodies/matrix_folder.hpp"
#include "limber/results/checkpoint_file.hpp"
#include "limber/results/probes_csv.hpp"
#include "limber/results/xdmf_file.hpp"
#include "limber/view/gltf.hpp"
#include "limber/view/moving_surface.hpp"

namespace limber::app {
namespace {

struct ExportOptions {
  std::string results;
  std::string out;
  double magnification = 1.0;
  double damping_ratio = 0.0;
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
      "-o {}: its data, {}, would replace the results; choose another name",
      file.string(), data.string()));
}

void export_body(const ExportOptions& options) {
  const std::filesystem::path file = options.out;
  const std::string extension = file.extension().string();
  if (options.magnification != 1.0)
    throw InputError("--magnification is for results; a body is at rest");
  const flexbody::ReducedBody body =
      flexbody::read_body(options.results, flexbody::StressTables::skipped);
  const double ratio = options.damping_ratio;
  if (extension.empty()) {
    if (ratio != 0.0)
      throw InputError("--damping-ratio: a folder of matrices has no damping");
    results::write_matrix_folder(file, body);
    fmt::print("{}: {} kg\n", file.string(), body.mass);
    return;
  }
  if (extension == ".mat") {
    write_whole(file, results::make_simscape_file(body, ratio));
  } else if (extension == ".unv" || extension == ".uff") {
    write_whole(file,
                results::make_universal_file(body, ratio, extension == ".uff"));
  } else if (extension == ".txt") {
    std::filesystem::path nodes = file;
    nodes.replace_extension(".yaml");
    write_whole(file, results::make_flex42_file(body, ratio));
    write_whole(nodes, results::make_nodes42_file(body));
    fmt::print("{}\n", nodes.string());
  } else {
    throw InputError(fmt::format(
        "-o {}: a reduced body is written as a folder of matrices (no "
        "extension), .mat (Simscape), .txt (42), .unv or .uff (universal file)",
        options.out));
  }
  fmt::print("{}\n", file.string());
}

/// The probes until the checkpoint.
void export_checkpoint(const ExportOptions& options) {
  const std::filesystem::path file = options.out;
  if (file.extension() != ".csv") {
    throw InputError(
        fmt::format("-o {}: of a checkpoint the probes are written, to a .csv",
                    options.out));
  }
  if (options.magnification != 1.0 || options.damping_ratio != 0.0) {
    throw InputError(
        "--magnification and --damping-ratio are not for checkpoints");
  }
  results::write_probes_csv(file,
                            results::read_checkpoint(options.results).history);
  fmt::print("{}\n", file.string());
}

void export_results(const ExportOptions& options) {
  if (!std::filesystem::exists(options.results)) {
    throw InputError(
        fmt::format("'{}': no such file or folder", options.results));
  }
  if (results::is_checkpoint_file(options.results)) {
    export_checkpoint(options);
    return;
  }
  if (flexbody::is_body_file(options.results)) {
    export_body(options);
    return;
  }
  if (options.damping_ratio != 0.0)
    throw InputError("--damping-ratio is for reduced bodies");
  const std::filesystem::path file = options.out;
  const bool is_xdmf = file.extension() == ".xdmf";
  if (!is_xdmf && file.extension() != ".glb") {
    throw InputError(
        fmt::format("-o {}: export writes .glb (binary glTF 2.0) or .xdmf (for "
                    "ParaView, with an .h5 file next to it)",
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
      "export",
      "Write results as an animated glTF 2.0 scene or for ParaView, the probes "
      "of a run that was killed, or a reduced body for other programs");
  command
      ->add_option("results", options->results,
                   "Folder of a run, or its results.h5; its checkpoint.bin; or "
                   "a reduced body of 'limber reduce'")
      ->required();
  command
      ->add_option("-o,--out", options->out,
                   "The file: of results .glb or .xdmf; of a checkpoint .csv; "
                   "of a body .mat "
                   "(Simscape), .txt (42), .unv or .uff (universal file), or "
                   "a folder of matrices")
      ->required();
  command
      ->add_option("--magnification", options->magnification,
                   "Of the deformation in .glb (default: 1)")
      ->check(make_positive());
  command
      ->add_option("--damping-ratio", options->damping_ratio,
                   "Of all modes of a reduced body (default: 0)")
      ->check(CLI::Range(0.0, 1e6));
  command->callback(
      [&action, options] { action = [options] { export_results(*options); }; });
}

}  // namespace limber::app
