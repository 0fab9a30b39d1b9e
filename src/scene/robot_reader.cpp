// SPDX-License-Identifier: BSD-3-Clause
#include "scene/robot_reader.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "common/names.hpp"
#include "scene/flexible_reader.hpp"
#include "scene/urdf_tree.hpp"

namespace limber::scene {
namespace {

/// Keeps what urdfdom would print, for as long as it lives.
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

Joint to_joint(const urdf::Joint& source, int parent, int child,
               Problems& problems) {
  Joint joint;
  joint.name = source.name;
  joint.kind = to_kind(source.type);
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ = to_pose(source.parent_to_joint_origin_transform);
  if (joints::needs_axis(joint.kind)) {
    joint.axis_J = to_vector(source.axis);
    if (!(joint.axis_J.norm() > 0.0)) {
      problems.add(
          0, fmt::format("joint '{}': its axis has no direction", source.name));
    }
    joint.axis_J.normalize();
  }
  if (source.dynamics && source.dynamics->damping != 0.0) {
    joint.coupler.free_damping = source.dynamics->damping;
  }
  return joint;
}

/// Adds a link and all below it, parents first.
void add_branch(const urdf::Link& source, Robot& robot, Problems& problems) {
  const int parent = static_cast<int>(robot.links.size());
  Link link;
  link.name = source.name;
  if (source.inertial) link.inertia = to_inertia(*source.inertial);
  robot.links.push_back(link);
  for (const urdf::JointSharedPtr& joint : source.child_joints) {
    const int child = static_cast<int>(robot.links.size());
    robot.joints.push_back(to_joint(*joint, parent, child, problems));
    if (joint->limits && joint->type != urdf::Joint::CONTINUOUS &&
        (joint->limits->lower != 0.0 || joint->limits->upper != 0.0)) {
      robot.warnings.push_back(fmt::format(
          "joint '{}': end stops are not modelled; its limits are ignored",
          joint->name));
    }
    for (const urdf::LinkSharedPtr& next : source.child_links) {
      if (next->name == joint->child_link_name) {
        add_branch(*next, robot, problems);
      }
    }
  }
}

void read_standard_part(const std::string& xml, Robot& robot,
                        Problems& problems) {
  LogCapture capture;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(xml);
  for (const std::string& text : capture.errors) problems.add(0, text);
  if (!model || !problems.empty()) {
    if (problems.empty()) problems.add(0, "not a URDF robot");
    return;
  }
  add_branch(*model->getRoot(), robot, problems);
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

Link* named_link(Robot& robot, const std::string& name) {
  for (Link& link : robot.links) {
    if (link.name == name) return &link;
  }
  return nullptr;
}

std::vector<std::string> link_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Link& link : robot.links) names.push_back(link.name);
  return names;
}

/// Reads the elements that Limber adds, in one pass over the robot.
class ExtensionReader {
 public:
  ExtensionReader(Robot& robot, Problems& problems)
      : robot_(robot), problems_(problems) {}

  void read(const TiXmlElement& root) {
    for (const TiXmlElement* child = root.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      XmlElement element(*child, problems_);
      if (read_one(element)) element.finish_attributes();
    }
  }

 private:
  bool read_one(XmlElement& element) {
    const std::string tag = element.tag();
    if (tag == "flexible") {
      add_flexible(element);
    } else if (tag == "coupler") {
      add_coupler(element);
    } else if (tag == "spring") {
      add_connector(element, read_spring(element));
    } else if (tag == "bushing") {
      add_connector(element, read_bushing(element));
    } else {
      return false;
    }
    if (tag != "flexible") element.read_children({});
    return true;
  }

  void add_flexible(XmlElement& element) {
    const std::string name = element.required_text("link");
    FlexibleLink flexible = read_flexible(element, robot_.file.parent_path());
    Link* link = named_link(robot_, name);
    if (link == nullptr) {
      element.fail(describe_unknown("link", name, link_names(robot_)));
      return;
    }
    if (link->flexible) element.fail("for link '" + name + "' is given twice");
    for (const auto& [joint, interface] : flexible.interface_of_joint) {
      check_joint(element, joint);
    }
    link->flexible = std::move(flexible);
  }

  void check_joint(const XmlElement& element, const std::string& name) {
    const std::vector<std::string> names = joint_names(robot_);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      element.fail(describe_unknown("joint", name, names));
    }
  }

  void add_coupler(XmlElement& element) {
    const std::string name = element.required_text("joint");
    const CouplerOptions options = read_coupler(element);
    check_joint(element, name);
    for (Joint& joint : robot_.joints) {
      if (joint.name != name) continue;
      const std::optional<double> damping = joint.coupler.free_damping;
      joint.coupler = options;
      if (!options.free_damping) joint.coupler.free_damping = damping;
    }
  }

  void add_connector(XmlElement& element, const Connector& connector) {
    check_end(element, connector.from);
    check_end(element, connector.to);
    if (!connectors_.insert(connector.name).second) {
      element.fail(fmt::format("'{}' is given twice", connector.name));
    }
    robot_.connectors.push_back(connector);
  }

  void check_end(const XmlElement& element, const ConnectorEnd& end) {
    if (end.link == "world" || named_link(robot_, end.link) != nullptr) return;
    element.fail(describe_unknown("link", end.link, link_names(robot_)));
  }

  Robot& robot_;
  Problems& problems_;
  std::set<std::string> connectors_;
};

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw InputError(
        fmt::format("{}: cannot read this robot file", file.string()));
  }
  return text.str();
}

const TiXmlElement& parse_root(TiXmlDocument& document, const std::string& xml,
                               Problems& problems) {
  document.Parse(xml.c_str());
  if (document.Error()) {
    problems.add(document.ErrorRow(),
                 fmt::format("not well-formed XML: {}", document.ErrorDesc()));
    problems.raise();
  }
  const TiXmlElement* root = document.RootElement();
  if (root == nullptr || root->ValueStr() != "robot") {
    problems.add(0, "expected a <robot> as the root element (URDF)");
    problems.raise();
  }
  return *root;
}

}  // namespace

int find_link(const Robot& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (robot.links[i].name == name) return static_cast<int>(i);
  }
  throw InputError(describe_unknown("link", name, link_names(robot)));
}

Robot read_robot(const std::filesystem::path& file) {
  const std::string xml = read_text(file);
  Problems problems(file.string());
  TiXmlDocument document;
  const TiXmlElement& root = parse_root(document, xml, problems);
  check_urdf_tree(root, problems);
  problems.raise();
  Robot robot;
  robot.file = file;
  robot.name = root.Attribute("name") != nullptr ? root.Attribute("name") : "";
  if (robot.name.empty()) problems.add(root.Row(), "<robot> needs a 'name'");
  problems.raise();
  read_standard_part(xml, robot, problems);
  problems.raise();
  ExtensionReader(robot, problems).read(root);
  problems.raise();
  return robot;
}

}  // namespace limber::scene
