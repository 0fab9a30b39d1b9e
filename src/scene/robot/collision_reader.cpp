// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/collision_reader.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace limber::scene {
namespace {

constexpr const char* kCollision = "collision";

Geometry read_box(XmlElement& element) {
  if (!element.has("size")) element.fail("needs 'size'");
  return BoxGeometry{
      element.vector("size", kPositive).value_or(Vector3::Ones())};
}

using GeometryReader = Geometry (*)(XmlElement&);

const std::map<std::string, GeometryReader>& geometry_readers() {
  static const std::map<std::string, GeometryReader> readers = {
      {"sphere",
       [](XmlElement& e) -> Geometry {
         return SphereGeometry{e.required_number("radius", kPositive)};
       }},
      {"box", &read_box},
      {"cylinder",
       [](XmlElement& e) -> Geometry {
         return CylinderGeometry{e.required_number("radius", kPositive),
                                 e.required_number("length", kPositive)};
       }},
      {"capsule", [](XmlElement& e) -> Geometry {
         return CapsuleGeometry{e.required_number("radius", kPositive),
                                e.required_number("length", kPositive)};
       }}};
  return readers;
}

// @param folder of the robot's file
Geometry read_mesh(XmlElement& element, const std::filesystem::path& folder) {
  MeshGeometry mesh;
  const std::string name = element.required_text("filename");
  constexpr std::string_view kFile = "file://";
  const bool is_place = name.rfind(kFile, 0) == 0;
  if (!is_place && name.find("://") != std::string::npos) {
    element.fail(fmt::format(
        "filename=\"{}\" names a package; expected a path from this file's "
        "folder, such as meshes/part.stl",
        name));
  }
  mesh.file = (folder / (is_place ? name.substr(kFile.size()) : name))
                  .lexically_normal();
  mesh.scale = element.vector("scale").value_or(mesh.scale);
  if ((mesh.scale.array() == 0.0).any()) {
    element.fail("scale: a factor is 0; expected three others");
  }
  return mesh;
}

// urdf_names checks which names there are. Meshes for pictures are not drawn.
Geometry read_shape(const TiXmlElement& element,
                    const std::filesystem::path& folder, bool is_collision,
                    Problems& problems) {
  if (is_collision && element.ValueStr() == "mesh") {
    XmlElement mesh(element, problems);
    return read_mesh(mesh, folder);
  }
  const auto found = geometry_readers().find(element.ValueStr());
  if (found == geometry_readers().end()) {
    return OtherGeometry{element.ValueStr()};
  }
  XmlElement shape(element, problems);
  return found->second(shape);
}

std::optional<Geometry> read_geometry(const TiXmlElement& collision,
                                      const std::filesystem::path& folder,
                                      Problems& problems) {
  const TiXmlElement* geometry = collision.FirstChildElement("geometry");
  const TiXmlElement* shape =
      geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) {
    problems.add(collision.Row(),
                 "<collision> needs a <geometry> with a shape: <sphere>, "
                 "<box>, <cylinder>, <capsule> or <mesh>");
    return std::nullopt;
  }
  if (shape->NextSiblingElement() != nullptr) {
    problems.add(geometry->Row(),
                 "<geometry> has several shapes; give each a <collision>");
  }
  return read_shape(*shape, folder, collision.ValueStr() == kCollision,
                    problems);
}

std::vector<Collision> read_link(const TiXmlElement& element, const char* tag,
                                 const std::filesystem::path& folder,
                                 Problems& problems) {
  std::vector<Collision> all;
  for (const TiXmlElement* at = element.FirstChildElement(tag); at != nullptr;
       at = at->NextSiblingElement(tag)) {
    Collision collision;
    if (const TiXmlElement* origin = at->FirstChildElement("origin")) {
      collision.X_LS = XmlElement(*origin, problems).pose();
    }
    if (const auto geometry = read_geometry(*at, folder, problems)) {
      collision.geometry = *geometry;
      all.push_back(collision);
    }
  }
  return all;
}

/// Calls `work(link, its element)` for every link.
template <typename Work>
void for_each_link(const TiXmlElement& root, Robot& robot, const Work& work) {
  std::map<std::string, Link*> by_name;
  for (Link& link : robot.links) by_name[link.name] = &link;
  for (const TiXmlElement* link = root.FirstChildElement("link");
       link != nullptr; link = link->NextSiblingElement("link")) {
    work(*by_name.at(link->Attribute("name")), *link);
  }
}

/// Whether there was one.
bool remove_from(TiXmlElement& link) {
  bool was_any = false;
  while (TiXmlElement* collision = link.FirstChildElement(kCollision)) {
    link.RemoveChild(collision);
    was_any = true;
  }
  return was_any;
}

}  // namespace

std::string remove_collisions(const TiXmlDocument& robot,
                              const std::string& xml) {
  TiXmlDocument rest(robot);
  bool was_any = false;
  for (TiXmlElement* link = rest.RootElement()->FirstChildElement("link");
       link != nullptr; link = link->NextSiblingElement("link")) {
    was_any = remove_from(*link) || was_any;
  }
  if (!was_any) return xml;
  TiXmlPrinter printer;
  rest.Accept(&printer);
  return printer.Str();
}

void read_collisions(const TiXmlElement& root, Robot& robot,
                     Problems& problems) {
  for_each_link(root, robot, [&](Link& link, const TiXmlElement& element) {
    link.collisions =
        read_link(element, kCollision, robot.file.parent_path(), problems);
  });
}

void read_visuals(const TiXmlElement& root, Robot& robot) {
  for_each_link(root, robot, [&](Link& link, const TiXmlElement& element) {
    Problems problems(robot.file.string());
    std::vector<Collision> visuals =
        read_link(element, "visual", robot.file.parent_path(), problems);
    try {
      problems.raise();
      link.visuals = std::move(visuals);
    } catch (const InputError& error) {
      robot.warnings.push_back(fmt::format(
          "<visual> of link '{}' is not drawn: {}", link.name, error.what()));
    }
  });
}

LinkContact read_link_contact(XmlElement& element) {
  LinkContact contact;
  const auto modulus = element.number("youngs_modulus", kPositive);
  const auto ratio = element.number("poisson_ratio", {-1.0, 0.5, true, false});
  if (element.has("youngs_modulus") != element.has("poisson_ratio")) {
    element.fail("needs both 'youngs_modulus' and 'poisson_ratio', or neither");
  }
  if (modulus && ratio) {
    contact.material = contact::SurfaceMaterial{*modulus, *ratio};
  }
  std::istringstream groups(element.text("surface").value_or(""));
  contact.surfaces.assign(std::istream_iterator<std::string>(groups), {});
  if (element.has("surface") && contact.surfaces.empty()) {
    element.fail("surface=\"\": expected names of groups of faces");
  }
  return contact;
}

}  // namespace limber::scene
