// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scene_checks.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "limber/common/names.hpp"
#include "limber/scene/contacts/touching_pairs.hpp"
#include "limber/scene/probes/contact_probe.hpp"
#include "limber/scene/probes/coupler_probe.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

class Checker {
 public:
  Checker(const Scenario& scenario, const Robot& robot)
      : scenario_(scenario), robot_(robot), problems_(scenario.file.string()) {
    for (const Link& link : robot.links) {
      names_.push_back(link.name);
      if (link.flexible) flexible_.push_back(link.name);
    }
  }

  void run() {
    for (const auto& [link, level] : scenario_.fidelity_of_link) {
      check_flexible("[fidelity.links]", link);
    }
    for (const auto& [link, basis] : scenario_.basis_of_link) {
      check_flexible("[basis.links]", link);
    }
    for (const auto& [link, start] : scenario_.link_starts) {
      check_flexible("[initial.links]", link);
    }
    for (const LoadSpec& load : scenario_.loads) {
      const std::string who = "load '" + load.name + "'";
      if (load.nodal_forces.empty()) {
        check_place(who, load.where);
      } else {
        check_flexible(who, load.where.link);
      }
    }
    find_touching();
    for (const ProbeSpec& probe : scenario_.probes) {
      const std::string who = "probe '" + probe.name + "'";
      std::visit([&](const auto& of) { check_probe(who, of); }, probe.of);
    }
    for (const ControllerSpec& one : scenario_.controllers) {
      check_controller(one);
    }
    for (const DriveSpec& drive : scenario_.drives) check_drive(drive);
    for (const auto& [latch, time] : scenario_.releases) {
      find_named("[[release]]", "latch", latch, robot_.latches);
    }
    check_added_names();
    problems_.raise();
  }

 private:
  void find_touching() {
    try {
      touching_ = find_touching_pairs(scenario_, robot_).pairs;
    } catch (const InputError& error) {
      problems_.add(error, 0);
    }
  }

  void check_added_names() {
    std::set<std::string> taken = {"world"};
    for (const RobotSpec& robot : scenario_.robots) taken.insert(robot.name);
    for (std::size_t i = 0; i < robot_.tree_size(); ++i) {
      taken.insert(robot_.links[i].name);
    }
    const auto check = [&](const char* kind, const auto& all) {
      for (const auto& one : all) {
        if (taken.insert(one.name).second) continue;
        problems_.add(0,
                      fmt::format("{} '{}' has the same name as another link, "
                                  "robot, projectile or obstacle; rename it",
                                  kind, one.name));
      }
    };
    check("projectile", scenario_.projectiles);
    check("obstacle", scenario_.obstacles);
  }

  const Link* find(const std::string& name) const {
    for (const Link& link : robot_.links) {
      if (link.name == name) return &link;
    }
    return nullptr;
  }

  void check_flexible(const std::string& who, const std::string& name) {
    const Link* link = find(name);
    if (link != nullptr && link->flexible) return;
    problems_.add(
        0, who + ": " + describe_unknown("flexible link", name, flexible_));
  }

  void check_place(const std::string& who, const Place& place) {
    const Link* link = find(place.link);
    if (link == nullptr) {
      problems_.add(0,
                    who + ": " + describe_unknown("link", place.link, names_));
      return;
    }
    if (link->flexible) {
      check_flexible_place(who, place);
      return;
    }
    if (place.nodes || !place.interface.empty()) {
      problems_.add(0, fmt::format("{}: link '{}' is rigid and has no nodes; "
                                   "give 'point' (its frame, m) or nothing",
                                   who, place.link));
    }
  }

  void check_flexible_place(const std::string& who, const Place& place) {
    if (!place.point && (place.nodes || !place.interface.empty())) return;
    problems_.add(
        0, fmt::format(
               "{}: link '{}' is flexible; select the location by 'interface', "
               "'group', 'node', 'nearest', 'box', 'plane' or 'cylinder'",
               who, place.link));
  }

  void check_probe(const std::string& who, const CouplerProbeSpec& probe) {
    try {
      check_coupler_probe(probe, find_coupler_traits(robot_));
    } catch (const InputError& error) {
      problems_.add(0, who + ": " + error.problems().front());
    }
  }

  void check_probe(const std::string& who, const ContactProbeSpec& probe) {
    if (!touching_) return;  // a problem of the contacts
    try {
      (void)check_contact_probe(probe, *touching_, robot_, scenario_);
    } catch (const InputError& error) {
      problems_.add(0, who + ": " + error.problems().front());
    }
  }

  void check_probe(const std::string& who, const ControllerProbeSpec& probe) {
    find_named(who, "[[controller]]", probe.controller, scenario_.controllers);
  }

  void check_controller(const ControllerSpec& controller) {
    const std::string who = "controller '" + controller.name + "'";
    for (const std::string& column : {controller.measures, controller.rate}) {
      if (column.empty()) continue;
      const std::size_t dot = column.rfind('.');
      if (dot != std::string::npos) {
        find_named(who, "probe", column.substr(0, dot), scenario_.probes);
        continue;
      }
      problems_.add(0, fmt::format("{}: '{}' is not a column of a probe; "
                                   "expected PROBE.COLUMN, such as 'tip.ux'",
                                   who, column));
    }
  }

  void check_probe(const std::string& who, const StressProbeSpec& probe) {
    const Place& where = probe.where;
    const Link* link = find(where.link);
    const bool is_everywhere =
        !where.nodes && !where.point && where.interface.empty();
    if (link == nullptr || !link->flexible) {
      check_flexible(who, where.link);
      return;
    }
    if (!is_everywhere) check_flexible_place(who, where);
  }

  void check_probe(const std::string& who, const PointProbeSpec& probe) {
    check_place(who, probe.where);
    const Link* link = find(probe.where.link);
    if (link == nullptr) return;
    if (!link->flexible && probe.quantity == Quantity::deformation) {
      problems_.add(
          0, who + ": link '" + link->name + "' is rigid; it does not deform");
    }
    const bool rotates = probe.quantity == Quantity::rotation ||
                         probe.quantity == Quantity::angular_velocity;
    if (rotates) require_rotation(who, probe.where);
    if (!probe.relative_to) return;
    const std::string base = who + ", 'relative_to'";
    check_place(base, *probe.relative_to);
    require_rotation(base, *probe.relative_to);
    if (probe.quantity == Quantity::deformation) {
      problems_.add(0, who +
                           ": 'deformation' is relative to the link's own mean "
                           "axes; use 'displacement' with 'relative_to'");
    }
  }

  void require_rotation(const std::string& who, const Place& where) {
    if (!where.nodes || !flexbody::is_single_node(*where.nodes)) return;
    problems_.add(0, who +
                         ": one node of a solid has no rotation; use "
                         "'interface', 'group', 'box', 'plane' or 'cylinder'");
  }

  /// Null and a problem if none of `all` has this name.
  template <typename Named>
  const Named* find_named(const std::string& who, const std::string& kind,
                          const std::string& name,
                          const std::vector<Named>& all) {
    std::vector<std::string> known;
    for (const Named& one : all) {
      if (one.name == name) return &one;
      known.push_back(one.name);
    }
    problems_.add(0, who + ": " + describe_unknown(kind, name, known));
    return nullptr;
  }

  void check_drive(const DriveSpec& drive) {
    const std::string who = "drive '" + drive.name + "'";
    if (!drive.tendon.empty()) {
      find_named(who, "tendon", drive.tendon, robot_.tendons);
      return;
    }
    struct Driven {
      std::string name;
      joints::JointKind kind;
    };
    std::vector<Driven> all;
    for (const Joint& joint : robot_.joints) {
      all.push_back({joint.name, joint.kind});
    }
    for (const Loop& loop : robot_.loops) all.push_back({loop.name, loop.kind});
    const Driven* driven = find_named(who, "joint", drive.joint, all);
    if (driven == nullptr) return;
    const auto count = static_cast<int>(count_coordinates(driven->kind));
    if (drive.coordinate >= 1 && drive.coordinate <= count) return;
    problems_.add(
        0, count == 0
               ? fmt::format("{}: joint '{}' is {}: it has no coordinate to "
                             "drive",
                             who, drive.joint, joints::to_string(driven->kind))
               : fmt::format("{}: coordinate {}: joint '{}' has {}", who,
                             drive.coordinate, drive.joint, count));
  }

  const Scenario& scenario_;
  const Robot& robot_;
  Problems problems_;
  std::vector<std::string> names_;
  std::vector<std::string> flexible_;
  std::optional<std::vector<TouchingPair>> touching_;
};

}  // namespace

void check_scenario(const Scenario& scenario, const Robot& robot) {
  Checker(scenario, robot).run();
}

}  // namespace limber::scene
