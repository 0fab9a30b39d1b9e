// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scenario_writer.hpp"

#include <algorithm>
#include <sstream>

#include "limber/scene/text/toml_file.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {
namespace {

/// The table called `key`, made if there is none.
toml::table& get_table(toml::table& parent, const std::string& key) {
  if (parent.get_as<toml::table>(key) == nullptr) {
    parent.insert_or_assign(key, toml::table{});
  }
  return *parent.get_as<toml::table>(key);
}

/// Converts paths relative to one folder to paths relative to another.
class Mover {
 public:
  Mover(const std::filesystem::path& from, const std::filesystem::path& to)
      : from_(resolve(from)), to_(resolve(to)) {}

  void move(toml::table& table, const std::string& key) const {
    const auto path = table[key].value<std::string>();
    if (!path || std::filesystem::path(*path).is_absolute()) return;
    table.insert_or_assign(key, (from_ / *path)
                                    .lexically_normal()
                                    .lexically_relative(to_)
                                    .generic_string());
  }

 private:
  /// An empty path is the current folder.
  static std::filesystem::path resolve(const std::filesystem::path& folder) {
    return std::filesystem::weakly_canonical(std::filesystem::current_path() /
                                             folder);
  }

  std::filesystem::path from_;
  std::filesystem::path to_;
};

/// Every key of docs/reference/scenario.md that names a file.
void move_paths(toml::table& root, const Mover& mover) {
  mover.move(root, "robot");
  if (toml::table* robot = root.get_as<toml::table>("robot")) {
    mover.move(*robot, "file");
  }
  if (toml::table* packages = root["urdf"]["packages"].as_table()) {
    std::vector<std::string> names;
    for (const auto& [name, folder] : *packages) names.emplace_back(name.str());
    for (const std::string& name : names) mover.move(*packages, name);
  }
  if (toml::array* robots = root.get_as<toml::array>("robot")) {
    for (toml::node& item : *robots) mover.move(*item.as_table(), "file");
  }
  if (toml::array* loads = root.get_as<toml::array>("load")) {
    for (toml::node& item : *loads) {
      toml::table& load = *item.as_table();
      mover.move(load, "nodal_forces");
      toml::table* time = load.get_as<toml::table>("time");
      if (time != nullptr) mover.move(*time, "file");
    }
  }
  if (toml::array* drives = root.get_as<toml::array>("drive")) {
    for (toml::node& item : *drives) {
      toml::table* signal = item.as_table()->get_as<toml::table>("signal");
      if (signal != nullptr) mover.move(*signal, "file");
    }
  }
  toml::table* links = root["initial"]["links"].as_table();
  if (links == nullptr) return;
  for (auto&& [name, item] : *links) {
    toml::table* start = item.as_table();
    if (start == nullptr) continue;
    mover.move(*start, "displacement");
    mover.move(*start, "velocity");
  }
}

/// Sets a key of [basis] and removes it from every [basis.links.NAME]. The
/// values of static_deformation are a sub-table there.
template <typename Value>
void set_basis(toml::table& basis, const std::string& table,
               const std::string& key, const std::optional<Value>& value) {
  if (!value) return;
  const auto find = [&](toml::table& at) {
    return table.empty() ? &at : at.get_as<toml::table>(table);
  };
  (table.empty() ? basis : get_table(basis, table))
      .insert_or_assign(key, *value);
  toml::table* links = basis.get_as<toml::table>("links");
  if (links == nullptr) return;
  for (auto&& [name, item] : *links) {
    toml::table* own = item.is_table() ? find(*item.as_table()) : nullptr;
    if (own != nullptr) own->erase(key);
  }
}

void set_basis(toml::table& root, const BasisChoice& choice) {
  if (choice == BasisChoice{}) return;
  toml::table& basis = get_table(root, "basis");
  set_basis(basis, "", "eigenmodes", choice.eigenmodes);
  if (choice.pieces == 0) {
    set_basis(basis, "", "pieces", std::optional<std::string>("auto"));
  } else {
    set_basis(basis, "", "pieces", choice.pieces);
  }
  set_basis(basis, "static_deformation", "interfaces", choice.interfaces);
  set_basis(basis, "static_deformation", "loads", choice.loads);
  set_basis(basis, "static_deformation", "terms", choice.terms);
}

void set_step(toml::table& root, double step) {
  toml::table& time = get_table(root, "time");
  const auto interval = time["output_interval"].value<double>();
  const auto old_step = time["step"].value<double>();
  if (!time.contains("output_times") && (interval || old_step)) {
    const double old = interval ? *interval : *old_step;
    time.insert_or_assign("output_interval", std::max(old, step));
  }
  time.erase("steps");
  time.erase("tolerance");
  time.insert_or_assign("step", step);
}

}  // namespace

std::string rewrite_scenario(const std::filesystem::path& file,
                             const Overrides& overrides,
                             const std::filesystem::path& folder) {
  toml::table root = parse_toml_file(file);
  apply_settings(sort_settings(overrides.settings, root).scenario, root);
  move_paths(root, Mover(file.parent_path(), folder));
  if (overrides.fidelity) {
    const std::string level(dynamics::to_string(*overrides.fidelity));
    root.insert_or_assign("fidelity", toml::table{{"default", level}});
  }
  set_basis(root, overrides.basis);
  if (overrides.step) set_step(root, *overrides.step);
  if (overrides.integrator) {
    get_table(root, "time")
        .insert_or_assign("integrator",
                          dynamics::to_string(*overrides.integrator));
  }
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

}  // namespace limber::scene
