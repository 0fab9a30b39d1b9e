// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_materials.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"

namespace limber::fem {
namespace {

/// Without blanks at the end; blank ones in between are 0.
std::vector<double> read_numbers(const DeckPlace& at, std::string_view line) {
  std::vector<std::string_view> fields = split_commas(line);
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    double value = 0.0;
    if (!field.empty() && !parse_real(field, value))
      at.fail(
          fmt::format("'{}' is no finite number. Expected one.", echo(field)));
    numbers.push_back(value);
  }
  return numbers;
}

Vector3 take_three(const std::vector<double>& numbers, std::size_t first) {
  Vector3 v = Vector3::Zero();
  for (std::size_t i = 0; i < 3 && first + i < numbers.size(); ++i)
    v[static_cast<Eigen::Index>(i)] = numbers[first + i];
  return v;
}

/// From columns of the upper triangle in the order 11, 22, 33, 12, 13, 23.
Matrix6 take_triangle(const std::vector<double>& upper) {
  constexpr std::array<int, 6> kPlaces = {0, 1, 2, 3, 5, 4};
  Matrix6 C;
  std::size_t k = 0;
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t i = 0; i <= j; ++i, ++k) {
      C(kPlaces[i], kPlaces[j]) = upper[k];
      C(kPlaces[j], kPlaces[i]) = upper[k];
    }
  }
  return C;
}

/// D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323.
Matrix6 take_orthotropic(const std::vector<double>& D) {
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>() << D[0], D[1], D[3], D[1], D[2], D[4], D[3], D[4],
      D[5];
  C(3, 3) = D[6];
  C(5, 5) = D[7];
  C(4, 4) = D[8];
  return C;
}

/// The number of constants of a *ELASTIC.
std::size_t count_constants(const std::string& type) {
  if (type.starts_with("ISO") || type.empty()) return 2;
  if (type.starts_with("ORTHO") || type.starts_with("ENGINEERING")) return 9;
  if (type.starts_with("ANISO")) return 21;
  throw InputError(fmt::format(
      "*ELASTIC, TYPE={} is not read. Expected ISOTROPIC, ORTHOTROPIC, "
      "ENGINEERING CONSTANTS or ANISOTROPIC",
      echo(type)));
}

/// *MATERIAL's keywords that are the law in place of *ELASTIC.
bool is_other_law(std::string_view name) {
  return name.starts_with("HYPER") || name == "USER MATERIAL" ||
         name == "HYPOELASTIC" || name == "POROUS ELASTIC";
}

MaterialAxes move_axes(MaterialAxes axes, const Pose& pose) {
  axes.directions = pose.R * axes.directions;
  axes.point = pose * axes.point;
  return axes;
}

}  // namespace

void DeckMaterials::begin(const DeckPlace& at, const Keyword& keyword,
                          const Pose& pose) {
  const std::string& name = keyword.name;
  if (name == "MATERIAL") {
    material_ = keyword.get("NAME");
    const auto [entry, is_new] = materials_.try_emplace(material_);
    entry->second.place = at.text();
    if (!is_new)
      at.fail(fmt::format("material {} is there twice. Expected each once.",
                          echo(material_)));
  } else if (name == "ELASTIC") {
    if (materials_[material_].elastic)
      at.fail("a second *ELASTIC of one material. Expected one.");
    materials_[material_].elastic.emplace();
    materials_[material_].type = keyword.get("TYPE");
  } else if (is_other_law(name)) {
    materials_[material_].other = name;
  } else if (name == "ORIENTATION") {
    Orientation& orientation = orientations_[keyword.get("NAME")];
    const std::string system = keyword.get("SYSTEM");
    orientation.place = at.text();
    orientation.is_cylindrical = system.starts_with("CYL");
    const bool is_known = system.empty() || system.starts_with("RECT") ||
                          orientation.is_cylindrical;
    if (!is_known) orientation.problem = fmt::format("SYSTEM={}", echo(system));
    if (keyword.has("DEFINITION") &&
        !keyword.get("DEFINITION").starts_with("COORD"))
      orientation.problem =
          fmt::format("DEFINITION={}", echo(keyword.get("DEFINITION")));
  } else if (name.ends_with("SECTION") && keyword.has("ELSET")) {
    sections_.push_back({keyword.get("ELSET"), keyword.get("MATERIAL"),
                         keyword.get("ORIENTATION"), at.text(), pose});
  }
}

bool DeckMaterials::add_data(const DeckPlace& at, const Keyword& keyword,
                             std::string_view line) {
  if (keyword.name == "ELASTIC") {
    auto& elastic = *materials_[material_].elastic;
    const std::vector<double> numbers = read_numbers(at, line);
    elastic.insert(elastic.end(), numbers.begin(), numbers.end());
  } else if (keyword.name == "DENSITY") {
    auto& density = materials_[material_].density;
    const std::vector<double> numbers = read_numbers(at, line);
    density.insert(density.end(), numbers.begin(), numbers.end());
  } else if (keyword.name == "ORIENTATION") {
    Orientation& orientation = orientations_[keyword.get("NAME")];
    if (orientation.problem.empty())
      orientation.lines.push_back(read_numbers(at, line));
  } else {
    return false;
  }
  return true;
}

Matrix6 DeckMaterials::find_constants(const Material& material) {
  const std::vector<double>& k = *material.elastic;
  if (material.type.starts_with("ORTHO")) return take_orthotropic(k);
  if (material.type.starts_with("ANISO")) return take_triangle(k);
  return make_orthotropic(
      {take_three(k, 0), take_three(k, 3), take_three(k, 6)});
}

SolidMaterial DeckMaterials::convert(const Material& material,
                                     const Section& section) const {
  const std::size_t wanted = count_constants(material.type);
  const std::size_t given = material.elastic->size();
  if (given != wanted && given != wanted + 1)  // with a temperature
    throw InputError(fmt::format(
        "*ELASTIC has {} numbers. Expected {} and perhaps one temperature: "
        "elasticity that depends on temperature is not read",
        given, wanted));
  if (material.density.empty() || material.density.size() > 2)
    throw InputError("expected one *DENSITY");
  const double density = material.density[0];
  if (wanted == 2)
    return {(*material.elastic)[0], (*material.elastic)[1], density};
  Matrix6 C = find_constants(material);
  if (section.orientation.empty())
    return make_material(C, move_axes({}, section.pose), density);
  const auto found = orientations_.find(section.orientation);
  if (found == orientations_.end())
    throw InputError(
        fmt::format("*ORIENTATION {} is missing", echo(section.orientation)));
  const Orientation& axes = found->second;
  if (!axes.problem.empty() || axes.lines.empty() || axes.lines[0].size() < 6)
    throw InputError(fmt::format(
        "{}: *ORIENTATION with {} is not read. Expected SYSTEM=RECTANGULAR or "
        "CYLINDRICAL by coordinates of two points",
        axes.place,
        axes.problem.empty() ? "fewer than six coordinates" : axes.problem));
  if (axes.lines.size() > 1 && axes.lines[1].size() > 1) {
    const auto axis = std::lround(axes.lines[1][0]);
    const double angle = axes.lines[1][1] * std::numbers::pi / 180.0;
    if (axis < 1 || axis > 3)
      throw InputError(fmt::format(
          "{}: *ORIENTATION turns about axis {}. Expected 1, 2 or 3",
          axes.place, axis));
    C = turn_stiffness(
        C, Eigen::AngleAxisd(angle, Vector3::Unit(axis - 1)).matrix());
  }
  const Vector3 a = take_three(axes.lines[0], 0);
  const Vector3 b = take_three(axes.lines[0], 3);
  const Vector3 origin = take_three(axes.lines[0], 6);
  const MaterialAxes own = axes.is_cylindrical
                               ? make_cylindrical_axes(b - a, a)
                               : make_axes(a - origin, b - origin);
  return make_material(C, move_axes(own, section.pose), density);
}

RegionMaterial DeckMaterials::find(
    const Section& section,
    const std::map<std::string, std::string>& spelling) const {
  const auto spelled = spelling.find(section.material);
  RegionMaterial region;
  region.name =
      fmt::format("material {}", spelled == spelling.end() ? section.material
                                                           : spelled->second);
  const auto found = materials_.find(section.material);
  if (found == materials_.end()) {
    region.problem = fmt::format(
        "{} of {} is missing. Expected it, or one in "
        "its place",
        region.name, section.place);
    return region;
  }
  const Material& material = found->second;
  try {
    if (!material.other.empty() || !material.elastic)
      throw InputError(fmt::format("{} is not read. Expected *ELASTIC",
                                   material.other.empty()
                                       ? "a material without *ELASTIC"
                                       : "*" + material.other));
    region.material = convert(material, section);
  } catch (const InputError& error) {
    region.problem = fmt::format(
        "{} ({}) cannot be used: {}. Correct it, or give one in "
        "its place.",
        region.name, material.place, error.what());
  }
  return region;
}

}  // namespace limber::fem
