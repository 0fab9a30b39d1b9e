// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/scenario_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <variant>

#include "limber/common/echo.hpp"
#include "limber/scene/robot/place_reader.hpp"
#include "limber/scene/scenario/added_body_reader.hpp"
#include "limber/scene/scenario/basis_reader.hpp"
#include "limber/scene/scenario/contact_probe_reader.hpp"
#include "limber/scene/scenario/contact_reader.hpp"
#include "limber/scene/scenario/controller_reader.hpp"
#include "limber/scene/scenario/coupler_probe_reader.hpp"
#include "limber/scene/scenario/drive_reader.hpp"
#include "limber/scene/scenario/time_function_reader.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"
#include "limber/scene/text/toml_file.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {
namespace {

dynamics::Fidelity read_level(TomlTable& table, const std::string& key,
                              dynamics::Fidelity otherwise) {
  return read_name(table, key, otherwise, &dynamics::parse_fidelity);
}

void read_full(TomlTable& table, Scenario& scenario) {
  flexbody::FullOptions& full = scenario.full;
  full.law = read_name(table, "law", full.law, &flexbody::parse_material_law);
  full.mass = read_name(table, "mass", full.mass, &flexbody::parse_nodal_mass);
}

/// TOML reads a key with a dot as a table in a table.
void fail_unquoted(TomlTable& table, const std::string& robot,
                   const toml::table& inner) {
  const std::string name(inner.begin()->first.str());
  table.skip(robot);
  table.fail(robot, fmt::format("is a table; a name with a dot is a key in "
                                "quotes: \"{}.{}\"",
                                echo(robot), echo(name)));
}

void read_fidelity(TomlTable& table, Scenario& scenario) {
  scenario.fidelity = read_level(table, "default", scenario.fidelity);
  const toml::table* links = table.table("links");
  if (links == nullptr) return;
  TomlTable levels(*links, "fidelity.links", table.problems());
  for (const auto& [key, node] : *links) {
    const std::string link(key.str());
    if (node.is_table() && !node.as_table()->empty()) {
      fail_unquoted(levels, link, *node.as_table());
      continue;
    }
    scenario.fidelity_of_link[link] =
        read_level(levels, link, scenario.fidelity);
  }
}

LoadSpec read_nodal_load(TomlTable& table,
                         const std::filesystem::path& folder) {
  LoadSpec load;
  load.name = table.required_text("name");
  load.where.link = table.required_text("link");
  load.nodal_forces =
      (folder / table.required_text("nodal_forces")).lexically_normal();
  return load;
}

LoadSpec read_load(TomlTable& table, const SignalContext& context,
                   std::vector<std::string>& warnings) {
  if (table.has("nodal_forces")) return read_nodal_load(table, context.folder);
  LoadSpec load;
  load.name = table.required_text("name");
  load.where = read_place(table);
  load.force = table.vector("force").value_or(Vector3::Zero());
  load.moment = table.vector("moment").value_or(Vector3::Zero());
  if (!table.has("force") && !table.has("moment")) {
    table.fail("needs 'force', 'moment' or 'nodal_forces'");
  }
  load.frame =
      read_choice<dynamics::LoadFrame>(table, "frame",
                                       {{"body", dynamics::LoadFrame::body},
                                        {"world", dynamics::LoadFrame::world}},
                                       dynamics::LoadFrame::body);
  if (const toml::table* time = table.table("time")) {
    TomlTable function(*time, "load '" + load.name + "' time",
                       table.problems());
    load.time = read_time_function(function, context, warnings);
  }
  return load;
}

// { link = .. }, and where on it.
std::optional<Place> read_robot_base(TomlTable& table) {
  const toml::table* given = table.table("relative_to");
  if (given == nullptr) return std::nullopt;
  TomlTable base(*given, table.path() + ".relative_to", table.problems());
  const Place place = read_place(base);
  base.finish();
  return place;
}

StressProbeSpec read_stress_probe(TomlTable& table, StressQuantity quantity) {
  for (const char* key : {"relative_to", "distribution"}) {
    if (!table.has(key)) continue;
    table.skip(key);
    table.fail(key,
               "does not apply to stress, which is at a node, in the link's "
               "axes; leave it out");
  }
  SectionSelection section;
  section.layer = read_choice<SectionLayer>(table, "layer",
                                            {{"bottom", SectionLayer::bottom},
                                             {"middle", SectionLayer::middle},
                                             {"top", SectionLayer::top}},
                                            SectionLayer::all);
  constexpr int kMost = std::numeric_limits<int>::max();
  section.ply = table.integer("ply", 1, kMost).value_or(0);
  section.element = table.integer("element", 1, kMost).value_or(0);
  section.axes = read_choice<StressAxes>(table, "axes",
                                         {{"link", StressAxes::link},
                                          {"layer", StressAxes::layer},
                                          {"material", StressAxes::material}},
                                         StressAxes::link);
  if (section.axes != StressAxes::link && quantity != StressQuantity::stress) {
    table.fail("axes",
               "is for the components of quantity 'stress'; leave it out");
  }
  return {read_place(table), quantity, section};
}

ProbeSpec read_link_probe(TomlTable& table, const std::string& name) {
  using Either = std::variant<Quantity, StressQuantity>;
  const auto quantity =
      read_choice<Either>(table, "quantity",
                          {{"displacement", Quantity::displacement},
                           {"position", Quantity::position},
                           {"velocity", Quantity::velocity},
                           {"rotation", Quantity::rotation},
                           {"angular_velocity", Quantity::angular_velocity},
                           {"deformation", Quantity::deformation},
                           {"stress", StressQuantity::stress},
                           {"von_mises", StressQuantity::von_mises},
                           {"max_principal", StressQuantity::max_principal},
                           {"tsai_wu", StressQuantity::tsai_wu},
                           {"maximum_stress", StressQuantity::maximum_stress},
                           {"section_force", StressQuantity::section_force}},
                          Quantity::displacement);
  if (const auto* stress = std::get_if<StressQuantity>(&quantity)) {
    return {name, read_stress_probe(table, *stress)};
  }
  PointProbeSpec probe;
  probe.where = read_place(table);
  probe.relative_to = read_robot_base(table);
  probe.quantity = std::get<Quantity>(quantity);
  return {name, probe};
}

ProbeSpec read_probe(TomlTable& table) {
  const std::string name = table.required_text("name");
  if (table.has("contact")) return {name, read_contact_probe(table)};
  if (table.has("controller")) {
    return {name, ControllerProbeSpec{table.required_text("controller")}};
  }
  if (table.has("joint") || table.has("coupler")) {
    return {name, read_coupler_probe(table)};
  }
  return read_link_probe(table, name);
}

JointStart read_joint_start(TomlTable& table) {
  return {table.number_or_numbers("position"),
          table.number_or_numbers("velocity")};
}

LinkStart read_link_start(TomlTable& table,
                          const std::filesystem::path& folder) {
  LinkStart start;
  const auto path_of = [&](const std::string& key) {
    const auto file = table.text(key);
    return file ? (folder / *file).lexically_normal() : "";
  };
  start.displacement = path_of("displacement");
  start.velocity = path_of("velocity");
  const toml::table* modes = table.table("modes");
  if (modes == nullptr) return start;
  if (table.has("displacement") || table.has("velocity")) {
    table.fail("has 'modes' and nodal fields; give only one of the two");
  }
  TomlTable values(*modes, "initial.links modes", table.problems());
  start.eta = values.number_or_numbers("position");
  start.etadot = values.number_or_numbers("velocity");
  values.finish();
  return start;
}

/// Tables by name inside [initial]: `NAME = { ... }`.
template <typename Start, typename Read>
void read_starts(TomlTable& table, const std::string& section,
                 std::map<std::string, Start>& starts, Read read) {
  const toml::table* items = table.table(section);
  if (items == nullptr) return;
  const std::string path = "initial." + section;
  TomlTable by_name(*items, path, table.problems());
  for (const auto& [key, node] : *items) {
    const std::string name(key.str());
    const toml::table* item = by_name.table(name);
    if (item == nullptr) continue;
    if (!item->empty() && item->begin()->second.is_table() &&
        item->begin()->first.str() != "modes") {
      fail_unquoted(by_name, name, *item);
      continue;
    }
    TomlTable values(*item, path + "." + name, table.problems());
    starts[name] = read(values);
    values.finish();
  }
}

void read_equilibrium(TomlTable& table, Scenario& scenario) {
  const bool is_requested = table.boolean("equilibrium").value_or(false);
  const auto method = read_name(table, "equilibrium_method",
                                dynamics::EquilibriumMethod::newton,
                                dynamics::parse_equilibrium_method);
  if (!is_requested) {
    if (table.has("equilibrium_method")) {
      table.fail("'equilibrium_method' needs 'equilibrium = true'");
    }
    return;
  }
  scenario.equilibrium = method;
}

void read_initial(TomlTable& table, Scenario& scenario) {
  if (const toml::table* base = table.table("base")) {
    TomlTable values(*base, "initial.base", table.problems());
    scenario.base = read_body_start(values);
    values.finish();
    if (!scenario.robots.empty()) {
      table.fail(
          "base moves the only robot; of several, each [[robot]] has its own "
          "'position', 'orientation_rpy', 'velocity' and 'angular_velocity'");
    }
  }
  read_starts(table, "joints", scenario.joints, read_joint_start);
  read_starts(table, "links", scenario.link_starts, [&](TomlTable& values) {
    return read_link_start(values, scenario.file.parent_path());
  });
  read_equilibrium(table, scenario);
}

OutputSpec read_output(TomlTable& table) {
  OutputSpec output;
  const std::optional<std::string> folder = table.text("folder");
  output.folder = folder.value_or("");
  if (folder && folder->empty()) {
    table.fail("folder", "is empty; leave it out for out/SCENARIO");
  }
  output.xdmf = table.boolean("xdmf").value_or(false);
  output.pictures = table.boolean("pictures").value_or(true);
  output.stress = table.boolean("stress").value_or(false);
  output.errors = table.boolean("errors").value_or(false);
  output.checkpoint_interval = table.number("checkpoint_interval", kNonNegative)
                                   .value_or(output.checkpoint_interval);
  return output;
}

dynamics::AdviceSettings read_advice(TomlTable& table) {
  dynamics::AdviceSettings advice;
  advice.displacement = table.number("displacement", kPositive);
  advice.linear_limit = table.number("linear_limit", kPositive);
  advice.force = table.number("force", kPositive);
  return advice;
}

/// Reads one sub-table if it is there, and checks its keys.
template <typename Read>
void read_section(TomlTable& root, const std::string& name, Read read) {
  const toml::table* table = root.table(name);
  if (table == nullptr) return;
  TomlTable section(*table, name, root.problems());
  read(section);
  section.finish();
}

/// Reads every [[name]] table; names of items are unique.
template <typename Item, typename Read>
std::vector<Item> read_items(TomlTable& root, const std::string& name,
                             Read read) {
  std::vector<Item> items;
  std::set<std::string> names;
  for (const toml::table* table : root.tables(name)) {
    TomlTable element(*table, fmt::format("{} {}", name, items.size() + 1),
                      root.problems());
    items.push_back(read(element));
    element.finish();
    if (!names.insert(items.back().name).second) {
      element.fail(fmt::format("'{}' is given twice", items.back().name));
    }
  }
  return items;
}

void read_robots(TomlTable& root, Scenario& scenario) {
  const std::filesystem::path folder = scenario.file.parent_path();
  if (!root.has("robot")) {
    root.skip("robot");
    root.fail(
        "needs 'robot', the path of a URDF file, [robot] with 'file', or "
        "[[robot]]s");
  } else if (root.is_array("robot")) {
    scenario.robots = read_items<RobotSpec>(root, "robot", [&](TomlTable& t) {
      return read_placed_robot(t, folder);
    });
    if (scenario.robots.empty() && root.problems().empty()) {
      root.fail("robot", "is empty; give one at least");
    }
  } else if (root.is_table("robot")) {
    TomlTable robot(*root.table("robot"), "robot", root.problems());
    scenario.robot = (folder / robot.required_text("file")).lexically_normal();
    scenario.robot_base = read_base(robot);
    scenario.robot_joint = read_joint_model(robot);
    robot.finish();
  } else if (const auto file = root.text("robot")) {
    scenario.robot = (folder / *file).lexically_normal();
  }
}

void read_packages(TomlTable& table, const std::filesystem::path& folder,
                   RobotOptions& options) {
  const toml::table* packages = table.table("packages");
  if (packages == nullptr) return;
  TomlTable by_name(*packages, "urdf.packages", table.problems());
  for (const auto& [key, node] : *packages) {
    const std::string name(key.str());
    const std::filesystem::path place =
        (folder / by_name.required_text(name)).lexically_normal();
    options.packages[name] = place;
    if (std::filesystem::is_directory(place)) continue;
    by_name.fail(name, fmt::format("'{}' is not a folder", place.string()));
  }
}

void read_urdf(TomlTable& table, Scenario& scenario) {
  read_packages(table, scenario.file.parent_path(), scenario.urdf);
  scenario.urdf.repair_inertia =
      table.boolean("repair_inertia").value_or(false);
}

void read_root(TomlTable& root, Scenario& scenario) {
  read_robots(root, scenario);
  read_section(root, "urdf", [&](TomlTable& t) { read_urdf(t, scenario); });
  if (!root.has("time")) root.fail("needs [time] with 'duration' and 'step'");
  read_section(root, "time", [&](TomlTable& t) {
    scenario.settings = read_time_settings(t, scenario.warnings);
  });
  read_section(root, "fidelity",
               [&](TomlTable& t) { read_fidelity(t, scenario); });
  read_section(root, "full", [&](TomlTable& t) { read_full(t, scenario); });
  read_section(root, "basis", [&](TomlTable& t) { read_basis(t, scenario); });
  read_section(root, "gravity", [&](TomlTable& t) {
    scenario.gravity = t.vector("acceleration").value_or(Vector3::Zero());
    if (!t.has("acceleration")) t.fail("needs 'acceleration'");
  });
  scenario.projectiles =
      read_items<ProjectileSpec>(root, "projectile", read_projectile);
  scenario.obstacles =
      read_items<ObstacleSpec>(root, "obstacle", read_obstacle);
  root.skip("coupler");  // read with the robots (add_couplers)
  read_contacts(root, scenario);
  read_section(root, "initial",
               [&](TomlTable& t) { read_initial(t, scenario); });
  read_section(root, "output",
               [&](TomlTable& t) { scenario.output = read_output(t); });
  read_section(root, "advice",
               [&](TomlTable& t) { scenario.advice = read_advice(t); });
  const std::filesystem::path folder = scenario.file.parent_path();
  const std::vector<std::string> controllers = list_controllers(root);
  const SignalContext context{folder, controllers};
  scenario.controllers = read_items<ControllerSpec>(
      root, "controller",
      [&](TomlTable& t) { return read_controller(t, context); });
  scenario.loads = read_items<LoadSpec>(root, "load", [&](TomlTable& t) {
    return read_load(t, context, scenario.warnings);
  });
  scenario.drives = read_items<DriveSpec>(
      root, "drive", [&](TomlTable& t) { return read_drive(t, context); });
  for (const toml::table* table : root.tables("release")) {
    TomlTable release(*table, "release", root.problems());
    read_release(release, scenario.releases);
    release.finish();
  }
  scenario.probes = read_items<ProbeSpec>(root, "probe", read_probe);
  root.finish();
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file) {
  return read_scenario(parse_toml_file(file), file);
}

Scenario read_scenario(const toml::table& table,
                       const std::filesystem::path& file) {
  Problems problems(file.string());
  Scenario scenario;
  scenario.file = file;
  scenario.name = file.stem().string();
  TomlTable root(table, "", problems);
  read_root(root, scenario);
  problems.raise();
  return scenario;
}

}  // namespace limber::scene
