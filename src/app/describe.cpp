// SPDX-License-Identifier: BSD-3-Clause
#include "app/describe.hpp"

#include <numbers>

#include "common/errors.hpp"
#include "dynamics/fidelity.hpp"
#include "flexbody/body_file.hpp"
#include "scene/robot_reader.hpp"
#include "scene/scenario_reader.hpp"
#ifdef LIMBER_HAS_REDUCTION
#include "fem/mesh_reader.hpp"
#endif

namespace limber::app {
namespace {

std::string kind_name(joints::JointKind kind) {
  switch (kind) {
    case joints::JointKind::fixed:
      return "fixed";
    case joints::JointKind::revolute:
      return "revolute";
    case joints::JointKind::continuous:
      return "continuous";
    case joints::JointKind::prismatic:
      return "prismatic";
    case joints::JointKind::planar:
      return "planar";
    case joints::JointKind::floating:
      return "floating";
  }
  return "";
}

Json describe_link(const scene::Link& link) {
  Json json = Json::object();
  json.add("name", link.name);
  json.add("flexible", link.flexible.has_value());
  if (link.flexible) {
    const bool reduced = !link.flexible->reduced_file.empty();
    json.add("source",
             (reduced ? link.flexible->reduced_file : link.flexible->mesh.file)
                 .string());
  } else if (link.inertia) {
    json.add("mass", link.inertia->mass);
  }
  return json;
}

}  // namespace

Json describe_scenario(const std::filesystem::path& file) {
  const scene::Scenario scenario = scene::read_scenario(file);
  std::vector<std::string> loads;
  for (const auto& load : scenario.loads) loads.push_back(load.name);
  std::vector<std::string> probes;
  for (const auto& probe : scenario.probes) probes.push_back(probe.name);
  return Json::object()
      .add("kind", "scenario")
      .add("robot", scenario.robot.string())
      .add("duration", scenario.settings.end_time)
      .add("step", scenario.settings.step)
      .add("outputs", scenario.settings.output_times.size())
      .add("fidelity", std::string(dynamics::to_string(scenario.fidelity)))
      .add("loads", loads)
      .add("probes", probes);
}

Json describe_robot(const std::filesystem::path& file) {
  const scene::Robot robot = scene::read_robot(file);
  Json links = Json::array();
  for (const scene::Link& link : robot.links) links.push(describe_link(link));
  Json joints = Json::array();
  for (const scene::Joint& joint : robot.joints) {
    const auto name = [&](int link) {
      return robot.links[static_cast<std::size_t>(link)].name;
    };
    joints.push(Json::object()
                    .add("name", joint.name)
                    .add("type", kind_name(joint.kind))
                    .add("parent", name(joint.parent))
                    .add("child", name(joint.child)));
  }
  return Json::object()
      .add("kind", "robot")
      .add("name", robot.name)
      .add("links", links)
      .add("joints", joints)
      .add("connectors", robot.connectors.size())
      .add("warnings", robot.warnings);
}

Json describe_hdf5(const std::filesystem::path& file) {
  const flexbody::ReducedBody body = flexbody::read_body(file);
  std::vector<std::string> interfaces;
  for (const auto& table : body.interfaces) interfaces.push_back(table.name);
  std::vector<std::string> groups;
  for (const auto& group : body.groups) groups.push_back(group.name);
  const VectorX hz =
      body.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
  return Json::object()
      .add("kind", "reduced body")
      .add("name", body.name)
      .add("clamped", body.clamped)
      .add("nodes", body.mesh_nodes)
      .add("elements", body.mesh_elements)
      .add("boundary_nodes", body.mesh_boundary_nodes)
      .add("kept_nodes", body.rows.tags.size())
      .add("mass", body.mass)
      .add("center_of_mass", VectorX(body.p_MoBcm_M))
      .add("inertia", Json::matrix(body.inertia()))
      .add("modes", body.mode_count())
      .add("frequencies_hz", hz)
      .add("interfaces", interfaces)
      .add("groups", groups);
}

Json describe_mesh(const std::filesystem::path& file, double unit) {
#ifdef LIMBER_HAS_REDUCTION
  fem::MeshOptions options;
  options.unit = unit;
  const fem::Mesh mesh = fem::read_mesh(file, options);
  Json groups = Json::array();
  for (const fem::PhysicalGroup& group : mesh.groups) {
    groups.push(Json::object()
                    .add("name", group.name)
                    .add("dimension", group.dimension)
                    .add("nodes", group.nodes.size()));
  }
  return Json::object()
      .add("kind", "mesh")
      .add("nodes", mesh.node_count())
      .add("elements", mesh.element_count())
      .add("boundary_nodes", mesh.boundary_nodes.size())
      .add("size", VectorX(mesh.size()))
      .add("groups", groups);
#else
  (void)unit;
  throw InputError(file.string() +
                   ": this limber was built without meshing "
                   "(LIMBER_REDUCTION=OFF)");
#endif
}

}  // namespace limber::app
