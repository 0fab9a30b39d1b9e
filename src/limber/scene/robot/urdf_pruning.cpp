// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/urdf_pruning.hpp"

#include <initializer_list>

namespace limber::scene {
namespace {

void remove_children(TiXmlElement& element,
                     std::initializer_list<const char*> tags) {
  for (const char* tag : tags) {
    while (TiXmlElement* child = element.FirstChildElement(tag)) {
      element.RemoveChild(child);
    }
  }
}

void prune_joint(TiXmlElement& joint) {
  remove_children(joint, {"safety_controller", "calibration"});
  const char* attribute = joint.Attribute("type");
  const std::string type = attribute == nullptr ? "" : attribute;
  if (type == "fixed") {
    remove_children(joint, {"axis", "limit", "dynamics", "mimic"});
  }
  TiXmlElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) {
    if (type != "revolute" && type != "prismatic") return;
    limit = joint.InsertEndChild(TiXmlElement("limit"))->ToElement();
  }
  for (const char* name : {"effort", "velocity"}) {
    if (limit->Attribute(name) == nullptr) limit->SetAttribute(name, "0");
  }
}

}  // namespace

std::string prune_urdf(const TiXmlDocument& robot) {
  TiXmlDocument rest(robot);
  TiXmlElement& root = *rest.RootElement();
  remove_children(root, {"material", "gazebo", "transmission"});
  for (TiXmlElement* link = root.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    remove_children(*link, {"visual", "collision"});
  }
  for (TiXmlElement* joint = root.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    prune_joint(*joint);
  }
  TiXmlPrinter printer;
  rest.Accept(&printer);
  return printer.Str();
}

}  // namespace limber::scene
