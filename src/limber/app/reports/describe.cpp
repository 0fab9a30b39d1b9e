// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/describe.hpp"

#include <numbers>

#include "limber/app/options/mode_options.hpp"
#include "limber/app/reports/robot_masses.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/results/checkpoint_file.hpp"
#include "limber/results/results_file.hpp"
#include "limber/scene/robot/robot_reader.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/structural/read_structure.hpp"
#endif

namespace limber::app {
namespace {

Json describe_link(const scene::Link& link,
                   const std::optional<LinkMass>& mass) {
  Json json = Json::object();
  json["name"] = link.name;
  json["flexible"] = link.flexible.has_value();
  if (link.flexible) {
    const bool reduced = !link.flexible->reduced_file.empty();
    json["source"] =
        (reduced ? link.flexible->reduced_file : link.flexible->mesh.file)
            .string();
    const int pieces = link.flexible->pieces;
    json["pieces"] = pieces == 0 ? Json("auto") : Json(pieces);
  }
  if (!mass) return json;
  json["mass"] = mass->mass;
  json["center_of_mass"] = to_json(mass->p_LBcm);
  if (mass->size) json["size"] = to_json(*mass->size);
  return json;
}

template <typename Named>
Json names_of(const std::vector<Named>& all) {
  Json names = Json::array();
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

Json describe_loops(const scene::Robot& robot) {
  Json loops = Json::array();
  for (const scene::Loop& loop : robot.loops) {
    loops.push_back(Json{{"name", loop.name},
                         {"kind", std::string(joints::to_string(loop.kind))},
                         {"from", loop.from.where.link},
                         {"to", loop.to.where.link}});
  }
  return loops;
}

Json describe_gears(const scene::Robot& robot) {
  Json gears = Json::array();
  for (const scene::Gear& gear : robot.gears) {
    gears.push_back(Json{{"name", gear.name},
                         {"joint", gear.joint},
                         {"with", gear.with},
                         {"ratio", gear.ratio},
                         {"offset", gear.offset}});
  }
  return gears;
}

Json find_range(const VectorX& values) {
  if (values.size() == 0) return nullptr;
  return Json::array({values.minCoeff(), values.maxCoeff()});
}

Json describe_surfaces(const flexbody::ReducedBody& body) {
  Json surfaces = Json::array();
  for (const flexbody::ContactSurface& surface : body.contact_surfaces) {
    surfaces.push_back(Json{{"name", surface.name},
                            {"nodes", surface.tags.size()},
                            {"faces", surface.faces.size()},
                            {"residual", find_range(surface.residual)},
                            {"patch_radius", find_range(surface.patch_radius)},
                            {"youngs_modulus", surface.youngs_modulus},
                            {"poisson_ratio", surface.poisson_ratio}});
  }
  return surfaces;
}

// Null without stress modes; the averaging's error is that of each mode.
Json describe_stress(const flexbody::ReducedBody& body) {
  if (!body.stress) return nullptr;
  Json json{{"points", body.stress->rows.size()},
            {"materials", body.stress->constants.cols()}};
  const flexbody::SectionModes& sections = body.stress->sections;
  if (sections.exist()) {
    json["beam_ends"] = sections.ends.size();
    return json;
  }
  const VectorX errors = body.stress->averaging.diagonal()
                             .cwiseQuotient(body.lambda)
                             .cwiseMax(0.0)
                             .cwiseSqrt();
  json["averaging_error"] = to_json(errors);
  return json;
}

Json describe_body(const std::filesystem::path& file) {
  const flexbody::ReducedBody body = flexbody::read_body(file);
  std::vector<std::string> interfaces;
  for (const auto& table : body.interfaces) interfaces.push_back(table.name);
  std::vector<std::string> groups;
  for (const auto& group : body.groups) groups.push_back(group.name);
  const VectorX hz =
      body.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
  Json json{{"kind", "reduced body"},
            {"name", body.name},
            {"clamped", body.clamped},
            {"nodes", body.mesh_nodes},
            {"elements", body.mesh_elements},
            {"boundary_nodes", body.mesh_boundary_nodes},
            {"kept_nodes", body.rows.tags.size()},
            {"mass", body.mass},
            {"center_of_mass", to_json(body.p_MoBcm_M)},
            {"inertia", to_json(body.inertia())},
            {"modes", body.mode_count()},
            {"frequencies_hz", to_json(hz)},
            {"interfaces", interfaces},
            {"groups", groups},
            {"contact_surfaces", describe_surfaces(body)},
            {"stress", describe_stress(body)}};
  add_choices(body, json);
  return json;
}

Json describe_results(const std::filesystem::path& file) {
  const results::ResultsContents contents = results::read_contents(file);
  return Json{{"kind", "results"},         {"outputs", contents.outputs},
              {"start", contents.start},   {"end", contents.end},
              {"bodies", contents.bodies}, {"probes", contents.probes},
              {"events", contents.events}};
}

Json describe_field(const flexbody::ProjectedField& field) {
  return Json{{"modes", to_json(MatrixX(field.eta))},
              {"rigid_share", field.rigid_fraction},
              {"missed_share", field.missed_fraction}};
}

}  // namespace

void add_choices(const flexbody::ReducedBody& body, Json& json) {
  if (body.locking) json["locking"] = to_json(*body.locking);
  if (body.selection) json["automatic_modes"] = to_json(*body.selection);
  if (const auto& field = body.initial.displacement)
    json["initial_displacement"] = describe_field(*field);
  if (const auto& field = body.initial.velocity)
    json["initial_velocity"] = describe_field(*field);
}

/// The tolerance, or how it is chosen, and the longest step if there is one.
void add_step_settings(const dynamics::SimulationSettings& settings,
                       Json& json) {
  if (settings.tolerance == scene::kToleranceToChoose) {
    json["tolerance"] = "1e-4 of the smallest group's largest body";
  } else if (settings.tolerance > 0.0) {
    json["tolerance"] = settings.tolerance;
  }
  if (settings.tolerance > 0.0 && settings.step == settings.end_time) return;
  json["step"] = settings.step;
}

Json describe_scenario(const std::filesystem::path& file) {
  const scene::Scenario scenario = scene::read_scenario(file);
  std::vector<std::string> loads;
  for (const auto& load : scenario.loads) loads.push_back(load.name);
  std::vector<std::string> drives;
  for (const auto& drive : scenario.drives) drives.push_back(drive.name);
  std::vector<std::string> probes;
  for (const auto& probe : scenario.probes) probes.push_back(probe.name);
  Json robots = Json::object();
  for (const auto& robot : scenario.robots) {
    robots[robot.name] = robot.file.string();
  }
  Json json{{"kind", "scenario"},
            {"robot", robots.empty() ? Json(scenario.robot.string()) : robots},
            {"duration", scenario.settings.end_time}};
  add_step_settings(scenario.settings, json);
  json["outputs"] = scenario.settings.output_times.size();
  json["fidelity"] = std::string(dynamics::to_string(scenario.fidelity));
  json["loads"] = loads;
  json["drives"] = drives;
  json["probes"] = probes;
  return json;
}

Json describe_robot(const std::filesystem::path& file,
                    const Progress& progress) {
  const scene::Robot robot = scene::read_robot(file);
  const RobotMasses masses = find_masses(robot, progress);
  Json links = Json::array();
  std::vector<std::string> warnings = robot.warnings;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const std::optional<LinkMass>& mass = masses.of_link[i];
    links.push_back(describe_link(robot.links[i], mass));
    if (!mass) continue;
    warnings.insert(warnings.end(), mass->warnings.begin(),
                    mass->warnings.end());
  }
  Json joints = Json::array();
  for (const scene::Joint& joint : robot.joints) {
    const auto name = [&](int link) {
      return robot.links[static_cast<std::size_t>(link)].name;
    };
    joints.push_back(Json{{"name", joint.name},
                          {"type", std::string(joints::to_string(joint.kind))},
                          {"parent", name(joint.parent)},
                          {"child", name(joint.child)}});
  }
  return Json{{"kind", "robot"},
              {"name", robot.name},
              {"units", "m, kg, s, rad"},
              {"mass", masses.total},
              {"center_of_mass", to_json(masses.center)},
              {"links", links},
              {"joints", joints},
              {"connectors", robot.connectors.size()},
              {"loops", describe_loops(robot)},
              {"latches", names_of(robot.latches)},
              {"tendons", names_of(robot.tendons)},
              {"gears", describe_gears(robot)},
              {"warnings", warnings}};
}

Json describe_checkpoint(const std::filesystem::path& file) {
  const results::CheckpointRecord record = results::read_checkpoint(file);
  return Json{{"kind", "checkpoint"},
              {"time", record.run.time},
              {"outputs", record.history.times.size()},
              {"goes_on_by", "limber run SCENARIO --resume"}};
}

Json describe_hdf5(const std::filesystem::path& file) {
  return results::is_results_file(file) ? describe_results(file)
                                        : describe_body(file);
}

#ifdef LIMBER_HAS_REDUCTION
namespace {

/// A deck of beams and shells.
Json describe_structure(const std::filesystem::path& file, double unit) {
  const fem::Structure structure = fem::read_structure(file);
  Json groups = Json::array();
  for (const fem::MatrixNodeSet& set : structure.sets)
    groups.push_back(Json{{"name", set.name}, {"nodes", set.nodes.size()}});
  const Vector3 size =
      structure.x.rowwise().maxCoeff() - structure.x.rowwise().minCoeff();
  Json json = {{"kind", "beams and shells"},
               {"nodes", structure.tags.size()},
               {"beams", structure.beams.size()},
               {"shells", structure.shells.size()},
               {"solids", structure.has_solids},
               {"size", to_json((unit > 0.0 ? unit : 1.0) * size)},
               {"groups", groups}};
  if (!structure.notices.empty()) json["notices"] = structure.notices;
  return json;
}

}  // namespace
#endif

Json describe_mesh(const std::filesystem::path& file, double unit) {
#ifdef LIMBER_HAS_REDUCTION
  if (fem::is_structure(file)) return describe_structure(file, unit);
  fem::MeshOptions options;
  options.unit = unit;
  const fem::TracedMesh traced = fem::read_traced_mesh(file, options);
  const fem::Mesh& mesh = traced.mesh;
  Json groups = Json::array();
  for (const fem::PhysicalGroup& group : mesh.groups) {
    groups.push_back(Json{{"name", group.name},
                          {"dimension", group.dimension},
                          {"nodes", group.nodes.size()}});
  }
  Json json = {{"kind", "mesh"},
               {"nodes", mesh.node_count()},
               {"elements", mesh.element_count()},
               {"boundary_nodes", mesh.boundary_nodes.size()},
               {"size", to_json(mesh.size())},
               {"groups", groups}};
  if (!traced.notices.empty()) json["notices"] = traced.notices;
  return json;
#else
  (void)unit;
  throw InputError(file.string() +
                   ": this limber was built without meshing "
                   "(LIMBER_REDUCTION=OFF)");
#endif
}

}  // namespace limber::app
