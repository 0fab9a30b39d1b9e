// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/unused_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

#include "limber/common/parse_number.hpp"
#include "limber/scene/contacts/touching_pairs.hpp"

namespace limber::scene {
namespace {

using joints::JointKind;

/// The first law of a kind along a joint's only coordinate.
template <typename Law>
const Law* find_action(const Joint& joint) {
  for (const JointAction& action : joint.actions) {
    if (const Law* law = std::get_if<Law>(&action.law)) return law;
  }
  return nullptr;
}

bool has_range(const Joint& joint) {
  return joint.kind == JointKind::revolute ||
         joint.kind == JointKind::prismatic;
}

/// The number that a value of TOML is, or that a text holds.
std::optional<double> find_number(const Setting& setting) {
  const toml::table table = parse_value(*setting.value, "");
  const toml::node* node = table.get("value");
  const auto text = node->value<std::string>();
  return text ? parse_number(*text) : node->value<double>();
}

/// Why a value of a joint is without effect; empty: it is not.
class JointJudge {
 public:
  JointJudge(const Joint& joint, const std::vector<DriveSpec>& drives)
      : joint_(joint), drives_(drives) {}

  /// @param path below the joint, as "limit.lower" @param value that was set
  [[nodiscard]] std::string find_reason(std::string_view path,
                                        std::optional<double> value) const {
    if (path.starts_with("axis.")) return judge_axis();
    if (path == "limit.lower" || path == "limit.upper") {
      return judge_range(path == "limit.lower", value);
    }
    if (path == "limit.effort") {
      return judge_drives(&joints::Drive::Parameters::max_effort, "max_effort");
    }
    if (path == "limit.velocity") {
      return judge_drives(&joints::Drive::Parameters::max_speed, "max_speed");
    }
    if (path == "dynamics.friction") return judge_friction(value);
    if (path == "dynamics.damping") return judge_damping(value);
    return judge_hold(path);
  }

 private:
  [[nodiscard]] std::string name_type() const {
    return fmt::format("its type is {}", joints::to_string(joint_.kind));
  }

  [[nodiscard]] std::string judge_axis() const {
    return joints::needs_axis(joint_.kind)
               ? ""
               : name_type() + ", which has no axis";
  }

  [[nodiscard]] std::string judge_range(bool is_lower,
                                        std::optional<double> value) const {
    if (!has_range(joint_)) return name_type() + ", which has no range";
    const auto* stop = find_action<StopOptions>(joint_);
    if (stop == nullptr) return "";
    return (is_lower ? stop->lower : stop->upper) == value
               ? ""
               : "the <stop> of its <coupler> has its own";
  }

  [[nodiscard]] std::string judge_drives(double joints::Drive::Parameters::*own,
                                         const char* name) const {
    bool is_driven = false;
    for (const DriveSpec& drive : drives_) {
      if (drive.joint != joint_.name) continue;
      if (drive.drive.*own == joints::Drive::kUnlimited) return "";
      is_driven = true;
    }
    return is_driven ? fmt::format("each [[drive]] of it has its own {}", name)
                     : "it limits drives, and no [[drive]] acts on it";
  }

  [[nodiscard]] std::string judge_friction(std::optional<double> value) const {
    const auto* friction = find_action<joints::Friction::Parameters>(joint_);
    if (friction == nullptr || friction->coulomb == value) return "";
    return "the <friction> of its <coupler> replaces it";
  }

  [[nodiscard]] std::string judge_damping(std::optional<double> value) const {
    if (joint_.kind == JointKind::fixed) {
      return name_type() + ", which is free in no direction";
    }
    return joint_.coupler.free_damping.value_or(0.0) == value
               ? ""
               : "its <coupler> has its own free_damping";
  }

  /// Stiffness and damping of the directions that are held.
  [[nodiscard]] std::string judge_hold(std::string_view path) const {
    const bool is_rotation = path.starts_with("rotational_");
    if (!is_rotation && !path.starts_with("translational_")) return "";
    const bool is_free = joint_.kind == JointKind::floating ||
                         (joint_.kind == JointKind::ball && is_rotation);
    return is_free ? fmt::format("{}, which constrains no {}", name_type(),
                                 is_rotation ? "rotation" : "translation")
                   : "";
  }

  const Joint& joint_;
  const std::vector<DriveSpec>& drives_;
};

class Judge {
 public:
  explicit Judge(const Scene& scene)
      : scenario_(scene.scenario),
        robot_(scene.robot),
        touching_(scene.touching) {}

  [[nodiscard]] std::string find_reason(const RobotSetting& setting) const {
    const std::string& kind = setting.parts[1];
    const std::string name =
        (setting.robot.empty() ? "" : setting.robot + ".") + setting.parts[2];
    std::string path = setting.parts[3];
    for (std::size_t i = 4; i < setting.parts.size(); ++i) {
      path += "." + setting.parts[i];
    }
    if (kind == "joint" || kind == "coupler") {
      return judge_joint(name, path, setting);
    }
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
      if (robot_.links[i].name == name) return judge_link(i, kind, path);
    }
    return "";
  }

 private:
  [[nodiscard]] std::string judge_joint(const std::string& name,
                                        const std::string& path,
                                        const RobotSetting& setting) const {
    for (const Joint& joint : robot_.joints) {
      if (joint.name != name) continue;
      return JointJudge(joint, scenario_.drives)
          .find_reason(path, find_number(setting.setting));
    }
    return "";
  }

  [[nodiscard]] std::string judge_link(std::size_t i, const std::string& kind,
                                       const std::string& path) const {
    if (kind == "contact" ||
        (kind == "link" && path.starts_with("collision."))) {
      return touches(i) ? "" : "no [[contact]] names the link";
    }
    const std::string& name = robot_.links[i].name;
    const bool is_of_modes =
        path.starts_with("damping.") || path.starts_with("basis.");
    if (kind != "flexible" || !is_of_modes) return "";
    if (scenario_.level_of(name) == dynamics::Fidelity::rigid) {
      return "the link is at level rigid, which has no modes";
    }
    return has_own_basis(name, path) ? "the scenario's [basis] has its own"
                                     : "";
  }

  /// Whether the scenario overrides the part of a basis at the path.
  [[nodiscard]] bool has_own_basis(const std::string& link,
                                   const std::string& path) const {
    const auto own = scenario_.basis_of_link.find(link);
    const auto has = [&](auto BasisChoice::*value) {
      return (scenario_.basis.*value).has_value() ||
             (own != scenario_.basis_of_link.end() &&
              (own->second.*value).has_value());
    };
    if (path == "basis.eigenmodes") return has(&BasisChoice::eigenmodes);
    if (path == "basis.interface_modes") return has(&BasisChoice::interfaces);
    if (path == "basis.load_modes") return has(&BasisChoice::loads);
    return path == "basis.terms" && has(&BasisChoice::terms);
  }

  [[nodiscard]] bool touches(std::size_t link) const {
    const Toucher own = {false, link};
    return std::any_of(touching_.begin(), touching_.end(),
                       [&](const TouchingPair& pair) {
                         return pair.A == own || pair.B == own;
                       });
  }

  const Scenario& scenario_;
  const Robot& robot_;
  const std::vector<TouchingPair>& touching_;
};

}  // namespace

std::vector<std::string> find_unused_settings(
    const std::vector<RobotSetting>& settings, const Scene& scene) {
  const Judge judge(scene);
  std::vector<std::string> texts;
  for (const RobotSetting& setting : settings) {
    if (!setting.setting.value) continue;
    const std::string why = judge.find_reason(setting);
    if (why.empty()) continue;
    texts.push_back(
        fmt::format("{} changes nothing: {}", to_string(setting.setting), why));
  }
  return texts;
}

}  // namespace limber::scene
