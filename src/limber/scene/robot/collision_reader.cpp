// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/collision_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/scene/robot/package_paths.hpp"

namespace limber::scene {
namespace {

constexpr const char* kCollision = "collision";

OtherGeometry make_useless(const XmlElement& element, const std::string& why) {
  const std::string tag = element.tag();
  return {tag, element.problems().locate(element.line(),
                                         fmt::format("<{}> {}", tag, why))};
}

/// The shape; one with a size of 0, which vendors write for none, has no use.
template <typename Shape>
Geometry keep_sized(const XmlElement& element, const Shape& shape,
                    double least_size) {
  if (least_size > 0.0) return shape;
  return make_useless(element, "has a size of 0");
}

Geometry read_sphere_shape(XmlElement& element) {
  const SphereGeometry sphere{element.required_number("radius", kNonNegative)};
  return keep_sized(element, sphere, sphere.radius);
}

Geometry read_box_shape(XmlElement& element) {
  if (!element.has("size")) element.fail("needs 'size'");
  const BoxGeometry box{
      element.vector("size", kNonNegative).value_or(Vector3::Ones())};
  return keep_sized(element, box, box.size.minCoeff());
}

Geometry read_ellipsoid_shape(XmlElement& element) {
  if (!element.has("radii")) element.fail("needs 'radii'");
  const EllipsoidGeometry ellipsoid{
      element.vector("radii", kNonNegative).value_or(Vector3::Ones())};
  return keep_sized(element, ellipsoid, ellipsoid.radii.minCoeff());
}

template <typename Shape>
Geometry read_round_shape(XmlElement& element) {
  const Shape shape{element.required_number("radius", kNonNegative),
                    element.required_number("length", kNonNegative)};
  return keep_sized(element, shape, std::min(shape.radius, shape.length));
}

using GeometryReader = Geometry (*)(XmlElement&);

const std::map<std::string, GeometryReader>& geometry_readers() {
  static const std::map<std::string, GeometryReader> readers = {
      {"sphere", &read_sphere_shape},
      {"box", &read_box_shape},
      {"cylinder", &read_round_shape<CylinderGeometry>},
      {"capsule", &read_round_shape<CapsuleGeometry>},
      {"cone", &read_round_shape<ConeGeometry>},
      {"ellipsoid", &read_ellipsoid_shape}};
  return readers;
}

/// Where the shapes of a robot's file are from.
struct ShapeSource {
  std::filesystem::path folder;
  const RobotOptions& options;
};

/// A path from the robot's folder, absolute, file://PATH or
/// package://NAME/PATH; none, and why.
std::filesystem::path find_mesh(const std::string& name,
                                const ShapeSource& source, std::string& why) {
  constexpr std::string_view kFile = "file://";
  constexpr std::string_view kPackage = "package://";
  if (name.rfind(kFile, 0) == 0) return name.substr(kFile.size());
  if (name.rfind(kPackage, 0) == 0) {
    const std::string in_package = name.substr(kPackage.size());
    why = fmt::format(
        "filename=\"{}\": there is no {} in this file's folder or one above "
        "it, "
        "nor in those of LIMBER_PACKAGE_PATH and ROS_PACKAGE_PATH; name the "
        "package's folder by --package {}=FOLDER",
        name, in_package, in_package.substr(0, in_package.find('/')));
    return find_in_package(in_package, source.folder, source.options);
  }
  if (name.find("://") == std::string::npos) return name;
  why = fmt::format(
      "filename=\"{}\": expected a path from this file's folder, "
      "such as meshes/part.stl, file:// or package://",
      name);
  return {};
}

Geometry read_mesh(XmlElement& element, const ShapeSource& source) {
  MeshGeometry mesh;
  const std::string name = element.required_text("filename");
  mesh.scale = element.vector("scale").value_or(mesh.scale);
  if ((mesh.scale.array() == 0.0).any()) {
    element.fail("scale: a factor is 0; expected three others");
  }
  std::string why;
  const std::filesystem::path file = find_mesh(name, source, why);
  if (file.empty() && !name.empty()) return make_useless(element, why);
  mesh.file = (source.folder / file).lexically_normal();
  return mesh;
}

// urdf_names checks which names there are.
Geometry read_shape(const TiXmlElement& element, const ShapeSource& source,
                    Problems& problems) {
  XmlElement shape(element, problems);
  if (element.ValueStr() == "mesh") return read_mesh(shape, source);
  const auto found = geometry_readers().find(element.ValueStr());
  if (found == geometry_readers().end()) {
    return OtherGeometry{element.ValueStr()};
  }
  return found->second(shape);
}

/// The shapes of a <geometry> that are known, else all that is in it.
std::vector<const TiXmlElement*> find_shapes(const TiXmlElement& geometry) {
  std::vector<const TiXmlElement*> known;
  std::vector<const TiXmlElement*> all;
  for (const TiXmlElement* at = geometry.FirstChildElement(); at != nullptr;
       at = at->NextSiblingElement()) {
    all.push_back(at);
    if (at->ValueStr() == "mesh" ||
        geometry_readers().contains(at->ValueStr())) {
      known.push_back(at);
    }
  }
  return known.empty() ? all : known;
}

std::optional<Geometry> read_geometry(const TiXmlElement& collision,
                                      const ShapeSource& source,
                                      Problems& problems) {
  const TiXmlElement* geometry = collision.FirstChildElement("geometry");
  if (geometry == nullptr || geometry->FirstChildElement() == nullptr) {
    problems.add(collision.Row(),
                 fmt::format("<{}> needs a <geometry> with a shape: <sphere>, "
                             "<box>, <cylinder>, <capsule>, <cone>, "
                             "<ellipsoid> or <mesh>",
                             collision.ValueStr()));
    return std::nullopt;
  }
  const auto shapes = find_shapes(*geometry);
  if (shapes.size() > 1) {
    problems.add(geometry->Row(),
                 fmt::format("<geometry> has several shapes; give each a <{}>",
                             collision.ValueStr()));
  }
  return read_shape(*shapes.front(), source, problems);
}

Pose read_origin(const TiXmlElement& element, Problems& problems) {
  const TiXmlElement* origin = element.FirstChildElement("origin");
  return origin == nullptr ? Pose{} : XmlElement(*origin, problems).pose();
}

std::vector<Collision> read_all(const TiXmlElement& link,
                                const ShapeSource& source, Problems& problems) {
  std::vector<Collision> all;
  for (const TiXmlElement* at = link.FirstChildElement(kCollision);
       at != nullptr; at = at->NextSiblingElement(kCollision)) {
    const Pose X_LS = read_origin(*at, problems);
    if (const auto geometry = read_geometry(*at, source, problems)) {
      all.push_back({X_LS, *geometry});
    }
  }
  return all;
}

/// A <visual>; whatever is wrong with it makes it useless, no more.
Collision read_visual(const TiXmlElement& visual, const ShapeSource& source,
                      const std::string& file) {
  Problems problems(file);
  const Pose X_LS = read_origin(visual, problems);
  const auto geometry = read_geometry(visual, source, problems);
  if (!problems.empty()) {
    return {X_LS, OtherGeometry{"visual", problems.texts().front()}};
  }
  const auto* other = std::get_if<OtherGeometry>(&*geometry);
  if (other == nullptr || !other->reason.empty()) return {X_LS, *geometry};
  const std::string why =
      fmt::format("<{}> is not a known shape", echo(other->tag));
  return {X_LS, OtherGeometry{other->tag, problems.locate(visual.Row(), why)}};
}

/// One text for all useless shapes, or none.
void warn_of_useless(const Robot& robot, std::vector<Collision> Link::*shapes,
                     const char* what, std::vector<std::string>& warnings) {
  int count = 0;
  std::string first;
  for (const Link& link : robot.links) {
    for (const Collision& shape : link.*shapes) {
      const auto* other = std::get_if<OtherGeometry>(&shape.geometry);
      if (other == nullptr || other->reason.empty()) continue;
      if (count++ == 0) first = other->reason;
    }
  }
  if (count == 0) return;
  warnings.push_back(fmt::format("{} {}: {}{}", count, what,
                                 count > 1 ? "the first is " : "", first));
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

}  // namespace

void read_collisions(const TiXmlElement& root, const RobotOptions& options,
                     Robot& robot, Problems& problems) {
  const ShapeSource source{robot.file.parent_path(), options};
  for_each_link(root, robot, [&](Link& link, const TiXmlElement& element) {
    link.collisions = read_all(element, source, problems);
  });
  warn_of_useless(robot, &Link::collisions,
                  "<collision> left out, so no contact may need its link",
                  robot.warnings);
}

void read_visuals(const TiXmlElement& root, const RobotOptions& options,
                  Robot& robot) {
  const ShapeSource source{robot.file.parent_path(), options};
  for_each_link(root, robot, [&](Link& link, const TiXmlElement& element) {
    if (link.flexible) return;
    for (const TiXmlElement* at = element.FirstChildElement("visual");
         at != nullptr; at = at->NextSiblingElement("visual")) {
      link.visuals.push_back(read_visual(*at, source, robot.file.string()));
    }
  });
  warn_of_useless(robot, &Link::visuals, "<visual> left out of pictures",
                  robot.warnings);
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
