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
#include <system_error>
#include <utility>
#include <vector>

namespace limber::scene {
namespace {

constexpr const char* kCollision = "collision";

Geometry read_box_shape(XmlElement& element) {
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
      {"box", &read_box_shape},
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

/// A package of robot software is a folder with its name: where the robot's
/// file is, or above. Nothing if there is no such file.
std::filesystem::path find_in_package(const std::filesystem::path& folder,
                                      const std::filesystem::path& name) {
  std::filesystem::path above =
      std::filesystem::absolute(folder.empty() ? "." : folder);
  for (;;) {
    std::error_code unknown;
    if (std::filesystem::exists(above / name, unknown)) return above / name;
    if (!above.has_relative_path()) return {};
    above = above.parent_path();
  }
}

/// A path from `folder`, absolute, file://PATH or package://NAME/PATH.
std::filesystem::path find_mesh(XmlElement& element, const std::string& name,
                                const std::filesystem::path& folder) {
  constexpr std::string_view kFile = "file://";
  constexpr std::string_view kPackage = "package://";
  if (name.rfind(kFile, 0) == 0) return name.substr(kFile.size());
  if (name.rfind(kPackage, 0) == 0) {
    const std::string in_package = name.substr(kPackage.size());
    std::filesystem::path file = find_in_package(folder, in_package);
    if (file.empty()) {
      element.fail(fmt::format(
          "filename=\"{}\": there is no {} in this file's folder or one above "
          "it; expected a path from here, such as meshes/part.stl",
          name, in_package));
    }
    return file;
  }
  if (name.find("://") != std::string::npos) {
    element.fail(
        fmt::format("filename=\"{}\": expected a path from this file's folder, "
                    "such as meshes/part.stl, file:// or package://",
                    name));
  }
  return name;
}

// @param folder of the robot's file
Geometry read_mesh(XmlElement& element, const std::filesystem::path& folder) {
  MeshGeometry mesh;
  const std::string name = element.required_text("filename");
  mesh.file = (folder / find_mesh(element, name, folder)).lexically_normal();
  mesh.scale = element.vector("scale").value_or(mesh.scale);
  if ((mesh.scale.array() == 0.0).any()) {
    element.fail("scale: a factor is 0; expected three others");
  }
  return mesh;
}

// urdf_names checks which names there are.
Geometry read_shape(const TiXmlElement& element,
                    const std::filesystem::path& folder, Problems& problems) {
  if (element.ValueStr() == "mesh") {
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
                 fmt::format("<{}> needs a <geometry> with a shape: <sphere>, "
                             "<box>, <cylinder>, <capsule> or <mesh>",
                             collision.ValueStr()));
    return std::nullopt;
  }
  if (shape->NextSiblingElement() != nullptr) {
    problems.add(geometry->Row(),
                 fmt::format("<geometry> has several shapes; give each a <{}>",
                             collision.ValueStr()));
  }
  return read_shape(*shape, folder, problems);
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

void read_visuals(const TiXmlElement& root, Robot& robot, Problems& problems) {
  for_each_link(root, robot, [&](Link& link, const TiXmlElement& element) {
    if (link.flexible) return;
    link.visuals =
        read_link(element, "visual", robot.file.parent_path(), problems);
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
