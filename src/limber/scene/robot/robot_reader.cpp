// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/robot_reader.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/utf8.hpp"
#include "limber/scene/robot/collision_reader.hpp"
#include "limber/scene/robot/extension_reader.hpp"
#include "limber/scene/robot/held_mimics.hpp"
#include "limber/scene/robot/link_inertias.hpp"
#include "limber/scene/robot/robot_settings.hpp"
#include "limber/scene/robot/urdf_angles.hpp"
#include "limber/scene/robot/urdf_joints.hpp"
#include "limber/scene/robot/urdf_names.hpp"
#include "limber/scene/robot/urdf_pruning.hpp"
#include "limber/scene/robot/urdf_tree.hpp"
#include "limber/scene/text/xml_depth.hpp"

namespace limber::scene {
namespace {

constexpr InputKind kRobot = {"robot file", std::uint64_t{1} << 28};

/// Captures urdfdom's output during its lifetime.
class LogCapture : public console_bridge::OutputHandler {
 public:
  LogCapture() { console_bridge::useOutputHandler(this); }
  ~LogCapture() override { console_bridge::restorePreviousOutputHandler(); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level,
           const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors.push_back(text);
    }
  }

  std::vector<std::string> errors;
};

Vector3 to_vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  const Quaternion quaternion(r.w, r.x, r.y, r.z);
  return {quaternion.normalized().toRotationMatrix(), to_vector(pose.position)};
}

LinkInertia to_inertia(const urdf::Inertial& inertial) {
  const Pose X_LI = to_pose(inertial.origin);
  Matrix3 inertia_I;
  inertia_I << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy,
      inertial.iyy, inertial.iyz, inertial.ixz, inertial.iyz, inertial.izz;
  return {inertial.mass, X_LI.p, X_LI.R * inertia_I * X_LI.R.transpose()};
}

joints::JointKind to_kind(int type) {
  switch (type) {
    case urdf::Joint::REVOLUTE:
      return joints::JointKind::revolute;
    case urdf::Joint::CONTINUOUS:
      return joints::JointKind::continuous;
    case urdf::Joint::PRISMATIC:
      return joints::JointKind::prismatic;
    case urdf::Joint::PLANAR:
      return joints::JointKind::planar;
    case urdf::Joint::FLOATING:
      return joints::JointKind::floating;
    default:
      return joints::JointKind::fixed;
  }
}

/// Joint actions from <limit> and <dynamics>.
void add_actions(const urdf::Joint& source, Joint& joint) {
  const bool has_range = joint.kind == joints::JointKind::revolute ||
                         joint.kind == joints::JointKind::prismatic;
  if (const auto& limit = source.limits) {
    if (has_range && (limit->lower != 0.0 || limit->upper != 0.0)) {
      StopOptions stop;
      stop.lower = limit->lower;
      stop.upper = limit->upper;
      joint.actions.push_back({0, stop});
    }
    if (limit->effort > 0.0) joint.max_effort = limit->effort;
    if (limit->velocity > 0.0) joint.max_speed = limit->velocity;
  }
  if (!source.dynamics) return;
  if (source.dynamics->damping != 0.0) {
    joint.coupler.free_damping = source.dynamics->damping;
  }
  if (source.dynamics->friction != 0.0) {
    joint.actions.push_back({0, joints::Friction::Parameters{
                                    .coulomb = source.dynamics->friction}});
  }
}

Joint to_joint(const urdf::Joint& source, int parent, int child) {
  Joint joint;
  joint.name = source.name;
  joint.kind = to_kind(source.type);
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ = to_pose(source.parent_to_joint_origin_transform);
  if (joints::needs_axis(joint.kind)) {
    joint.axis_J = to_vector(source.axis).stableNormalized();
  }
  add_actions(source, joint);
  return joint;
}

Gear to_gear(const urdf::Joint& source) {
  Gear gear;
  gear.name = source.name + ".mimic";
  gear.joint = source.name;
  gear.with = source.mimic->joint_name;
  gear.ratio = source.mimic->multiplier;
  gear.offset = source.mimic->offset;
  return gear;
}

Link to_link(const urdf::Link& source) {
  Link link;
  link.name = source.name;
  if (source.inertial) link.inertia = to_inertia(*source.inertial);
  return link;
}

bool has_text(const TiXmlElement& element, const char* name,
              const std::string& text) {
  const char* value = element.Attribute(name);
  return value != nullptr && value == text;
}

/// Adds all links, branch by branch, parents first. Not recursive: a long chain
/// could overflow the stack.
void add_links(const urdf::ModelInterface& model, Robot& robot) {
  struct Branch {
    const urdf::Joint* joint;
    int parent;
  };
  std::vector<Branch> left;
  const auto add_link = [&](const urdf::Link& source) {
    const auto& joints = source.child_joints;
    const int parent = static_cast<int>(robot.links.size());
    robot.links.push_back(to_link(source));
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
      left.push_back({joint->get(), parent});
    }
  };
  add_link(*model.getRoot());
  while (!left.empty()) {
    const auto [joint, parent] = left.back();
    left.pop_back();
    const int child = static_cast<int>(robot.links.size());
    robot.joints.push_back(to_joint(*joint, parent, child));
    if (joint->mimic) robot.gears.push_back(to_gear(*joint));
    add_link(*model.getLink(joint->child_link_name));
  }
}

void read_standard_part(const std::string& xml, Robot& robot,
                        Problems& problems) {
  LogCapture capture;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(xml);
  // The reason, and then the enclosing elements, outwards: one error.
  if (!capture.errors.empty()) {
    std::vector<std::string> texts;
    for (const std::string& text : capture.errors) texts.push_back(echo(text));
    std::reverse(texts.begin(), texts.end());
    problems.add(0, fmt::format("{}", fmt::join(texts, ": ")));
  }
  if (!model || !problems.empty()) {
    if (problems.empty()) problems.add(0, "not a URDF robot");
    return;
  }
  add_links(*model, robot);
  hold_mimics(robot);
}

std::string read_text(const std::filesystem::path& file) {
  std::string xml = read_input(file, kRobot);
  if (xml.find('\0') != std::string::npos) {
    throw InputError(fmt::format(
        "{}: holds a byte 0, so it is not the text of a robot; save it as "
        "UTF-8",
        file.string()));
  }
  return xml;
}

const TiXmlElement& parse_root(TiXmlDocument& document, const std::string& xml,
                               Problems& problems) {
  document.Parse(xml.c_str());
  if (document.Error()) {
    problems.add(document.ErrorRow(),
                 fmt::format("not well-formed XML: {}", document.ErrorDesc()));
    problems.raise();
  }
  TiXmlElement* root = document.RootElement();
  if (root == nullptr || root->ValueStr() != "robot") {
    problems.add(0, "expected a <robot> as the root element (URDF)");
    problems.raise();
  }
  return *root;
}

// A line break between two numbers is fine, one in a name is not.
std::string find_problem(std::string_view attribute, std::string value) {
  const bool is_name = attribute == "name" || attribute == "link" ||
                       attribute == "joint" || attribute == "group" ||
                       attribute == "interface";
  if (is_name && value.size() > kMostNameBytes) {
    return fmt::format("is too long; a name has {} bytes at most",
                       kMostNameBytes);
  }
  if (is_name && !is_utf8(value)) {
    return "is not UTF-8, which formats of results need; save the file as "
           "UTF-8";
  }
  if (!is_name) {
    std::erase_if(value,
                  [](char c) { return c == '\n' || c == '\r' || c == '\t'; });
  }
  return has_control(value) ? "has a control character, which is not allowed "
                              "in a name or number"
                            : "";
}

void check_text(const TiXmlElement& root, Problems& problems) {
  std::vector<const TiXmlElement*> left = {&root};
  while (!left.empty()) {
    const TiXmlElement* element = left.back();
    left.pop_back();
    for (const TiXmlAttribute* a = element->FirstAttribute(); a != nullptr;
         a = a->Next()) {
      const std::string problem = find_problem(a->NameTStr(), a->ValueStr());
      if (problem.empty()) continue;
      problems.add(
          element->Row(),
          fmt::format("<{}> {}=\"{}\" {}", echo(element->ValueStr()),
                      echo(a->NameTStr()), echo(a->ValueStr()), problem));
    }
    for (const TiXmlElement* child = element->FirstChildElement();
         child != nullptr; child = child->NextSiblingElement()) {
      left.push_back(child);
    }
  }
}

/// Adds the link "world" if joints have it as their parent without a <link>, as
/// robots of other programs do.
void add_world(TiXmlElement& root) {
  for (const TiXmlElement* link = root.FirstChildElement("link");
       link != nullptr; link = link->NextSiblingElement("link")) {
    if (has_text(*link, "name", "world")) return;
  }
  for (const TiXmlElement* joint = root.FirstChildElement("joint");
       joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    const TiXmlElement* parent = joint->FirstChildElement("parent");
    if (parent == nullptr || !has_text(*parent, "link", "world")) continue;
    TiXmlElement world("link");
    world.SetAttribute("name", "world");
    root.InsertEndChild(world);
    return;
  }
}

}  // namespace

Robot read_robot(const std::filesystem::path& file,
                 const std::vector<RobotSetting>& settings,
                 const RobotOptions& options) {
  const std::string xml = read_text(file);
  Problems problems(file.string());
  check_xml_depth(xml, problems);
  problems.raise();
  TiXmlDocument document;
  const TiXmlElement& root = parse_root(document, xml, problems);
  if (!settings.empty()) apply_settings(settings, *document.RootElement());
  check_text(root, problems);
  add_world(*document.RootElement());
  check_urdf_tree(root, problems);
  problems.raise();
  Robot robot;
  robot.file = file;
  check_urdf_joints(root, problems, robot.warnings);
  check_urdf_names(root, file.string(), problems, robot.warnings);
  if (auto question = question_rpy(root, problems)) {
    robot.warnings.push_back(std::move(*question));
  }
  robot.name = root.Attribute("name") != nullptr ? root.Attribute("name") : "";
  if (robot.name.empty()) problems.add(root.Row(), "<robot> needs a 'name'");
  problems.raise();
  read_standard_part(prune_urdf(document), robot, problems);
  problems.raise();
  read_collisions(root, options, robot, problems);
  read_extension(root, robot, problems);
  read_visuals(root, options, robot);
  locate_inertias(root, robot);
  if (options.repair_inertia) repair_inertias(robot);
  problems.raise();
  return robot;
}

}  // namespace limber::scene
