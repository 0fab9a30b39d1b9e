// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/mesh_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/reports/operate.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/whole_file.hpp"

namespace limber::app {
namespace {

/// GROUP FX FY FZ
using LoadWords = std::tuple<std::string, double, double, double>;

struct OperateOptions {
  MeshOptions mesh;
  std::vector<std::string> clamps;
  std::string state = "accelerating";
  std::vector<LoadWords> loads;
  std::vector<double> axis;
  std::vector<double> point;
  OperatingRequest request;
  std::string out;
  bool json = false;
};

Vector3 to_vector(const std::vector<double>& values) {
  return values.empty() ? Vector3(Vector3::Zero())
                        : Vector3(values[0], values[1], values[2]);
}

OperatingRequest make_request(const OperateOptions& options) {
  OperatingRequest request = options.request;
  request.kind = parse_operating_kind(options.state);
  request.axis = to_vector(options.axis);
  request.point = to_vector(options.point);
  for (const auto& [group, x, y, z] : options.loads) {
    request.loads.push_back({group, Vector3(x, y, z)});
  }
  return request;
}

void write_fields(const OperatingAnswer& answer,
                  const std::filesystem::path& file) {
  write_whole(file, [&](const std::filesystem::path& part) {
    Hdf5File out = Hdf5File::create(part);
    out.write("tags",
              std::vector<std::int64_t>(answer.tags.begin(), answer.tags.end()),
              "1", "Gmsh tags of the nodes");
    out.write("x", MatrixX(answer.surface.points), "m",
              "undeformed nodes, mesh frame, 3 x N");
    out.write("u", MatrixX(answer.u), "m", "their displacements, 3 x N");
    out.write("internal_force", MatrixX(answer.internal_force), "N",
              "elastic nodal forces K u, 3 x N");
    out.write("stress_tags",
              std::vector<std::int64_t>(answer.stress_tags.begin(),
                                        answer.stress_tags.end()),
              "1", "Gmsh tags of the nodes of 'stress'");
    out.write("stress", MatrixX(answer.stress), "Pa",
              "nodal stress, 6 x p: xx, yy, zz, xy, yz, xz");
    out.close();
  });
}

/// Magnifies displacements to a tenth of the body's size if they are smaller.
double find_exaggeration(const OperatingAnswer& answer) {
  constexpr double kSeen = 0.1;
  const double fraction =
      answer.figures.at("deformation").get<double>() / answer.size;
  if (!(fraction > 0.0) || fraction > 0.2 * kSeen) return 1.0;
  return std::pow(10.0, std::floor(std::log10(kSeen / fraction)));
}

void write(const OperatingAnswer& answer, const std::string& title,
           const std::filesystem::path& folder) {
  write_fields(answer, folder / "state.h5");
  write_text(folder / "summary.json", to_text(answer.figures));
  const std::string why_none =
      results::draw_deformation(folder / "state.png", title, answer.surface,
                                answer.u, find_exaggeration(answer));
  if (!why_none.empty()) print_warnings({why_none});
}

void operate(const OperateOptions& options) {
  flexbody::Recipe recipe = make_recipe(options.mesh);
  recipe.clamped_groups = options.clamps;
  const OperatingRequest request = make_request(options);
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) folder.emplace(options.out);
  const OperatingAnswer answer =
      find_operating_state(recipe, request, make_progress_bar());
  clear_progress_bar();
  if (folder) {
    folder->write([&](const std::filesystem::path& place) {
      write(answer, recipe.name + ", " + options.state, place);
    });
  }
  print_warnings(answer.notices);
  if (!answer.trust.empty()) print_warnings({answer.trust});
  fmt::print("{}\n",
             options.json ? to_text(answer.figures) : outline(answer.figures));
}

}  // namespace

void add_operate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<OperateOptions>();
  CLI::App* command = app.add_subcommand(
      "operate",
      "Deformation of a mesh in steady motion: constant acceleration, "
      "velocity, spin");
  add_mesh_options(*command, options->mesh);
  command->add_option("--clamp", options->clamps,
                      "Group that is fixed; may be repeated");
  command->add_option("--state", options->state,
                      "accelerating under the load (default), drifting "
                      "against friction, spinning, or driven-spin: a torque "
                      "against friction");
  command->add_option(
      "--load", options->loads,
      "GROUP FX FY FZ: a force spread over a group [N]; may be repeated");
  command->add_option("--axis", options->axis, "X Y Z: direction of the spin")
      ->expected(3);
  command
      ->add_option("--through", options->point,
                   "X Y Z: a point of the axis (0 0 0) [m]")
      ->expected(3);
  command->add_option("--speed", options->request.speed, "Of the spin [rad/s]");
  command->add_option("--drag-rate", options->request.drag_rate,
                      "Friction per mass and speed, Rayleigh's alpha [1/s]");
  command->add_option("--surface-drag", options->request.surface_drag,
                      "Friction per area and speed [N s/m^3]");
  command->add_option("--after", options->request.after,
                      "Of a drift: time since rest, with quasi-static "
                      "deformation (default: infinite) [s]");
  command->add_option("--out", options->out,
                      "Folder for state.h5, summary.json and a picture");
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { operate(*options); }; });
}

}  // namespace limber::app
