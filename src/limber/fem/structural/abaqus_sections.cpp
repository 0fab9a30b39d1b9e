// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/abaqus_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

[[noreturn]] void fail_section(const AbaqusSection& section,
                               const std::string& what) {
  throw InputError(fmt::format("{}: {}", section.place, what));
}

/// Number `i` of a section's data line; 0 where it is blank or absent.
double read_real(const AbaqusSection& section, std::size_t line,
                 std::size_t i) {
  double value = 0.0;
  if (line >= section.lines.size() || i >= section.lines[line].size() ||
      section.lines[line][i].empty())
    return value;
  if (!parse_real(section.lines[line][i], value))
    fail_section(section, fmt::format("'{}' is no finite number. Expected one.",
                                      echo(section.lines[line][i])));
  return value;
}

/// Numbers of *ELASTIC at one temperature, in lines of eight.
std::size_t count_elastic(const std::string& kind) {
  if (kind.starts_with("ANISO")) return 24;
  return kind.starts_with("ENG") || kind.starts_with("ORTHO") ? 16 : 8;
}

Vector3 take_vector(const AbaqusSection& section, std::size_t line) {
  return {read_real(section, line, 0), read_real(section, line, 1),
          read_real(section, line, 2)};
}

}  // namespace

bool AbaqusSections::begin(const DeckPlace& at, const Keyword& keyword,
                           const Pose& pose) {
  const std::string& name = keyword.name;
  reading_ = name;
  if (name == "MATERIAL") {
    name_ = keyword.get("NAME");
    if (!materials_.emplace(name_, Material{}).second)
      at.fail(
          fmt::format("material {} is there twice. Expected a name of its "
                      "own.",
                      echo(name_)));
    materials_[name_].place = at.text();
  } else if (name == "ELASTIC") {
    materials_[name_].kind = keyword.get("TYPE");
  } else if (name == "ORIENTATION") {
    name_ = keyword.get("NAME");
    const std::string system = keyword.get("SYSTEM");
    orientations_[name_] = {};
    if (!system.empty() && !system.starts_with('R'))
      orientations_[name_].problem = fmt::format(
          "{}: *ORIENTATION is curvilinear. Expected SYSTEM=RECTANGULAR.",
          at.text());
    const std::string definition = keyword.get("DEFINITION");
    if (!definition.empty() && !definition.starts_with("COORD"))
      orientations_[name_].problem = fmt::format(
          "{}: *ORIENTATION has DEFINITION={}. Expected COORDINATES.",
          at.text(), echo(definition));
  } else if (name == "BEAM SECTION" || name == "SHELL SECTION") {
    begin_section(at, keyword, pose);
  } else if (name == "FAIL STRESS" && !materials_.contains(name_)) {
    at.fail("*FAIL STRESS has no *MATERIAL before it. Expected one.");
  } else if (name != "DENSITY" && name != "FAIL STRESS") {
    reading_.clear();
  }
  return !reading_.empty();
}

void AbaqusSections::begin_section(const DeckPlace& at, const Keyword& keyword,
                                   const Pose& pose) {
  constexpr std::array<std::string_view, 12> kKnown = {"ELSET",
                                                       "MATERIAL",
                                                       "ORIENTATION",
                                                       "SECTION",
                                                       "COMPOSITE",
                                                       "CONTROLS",
                                                       "SECTION INTEGRATION",
                                                       "TEMPERATURE",
                                                       "POISSON",
                                                       "LUMPED",
                                                       "LAYUP",
                                                       "THICKNESS MODULUS"};
  for (const auto& [key, value] : keyword.parameters)
    if (!key.empty() && std::ranges::find(kKnown, key) == kKnown.end())
      at.fail(fmt::format("*{} has {}, which is not read. Expected none.",
                          echo(keyword.name), echo(key)));
  AbaqusSection section;
  section.place = at.text();
  section.pose = pose;
  section.elset = keyword.get("ELSET");
  section.is_beam = keyword.name.starts_with("BEAM");
  section.material = keyword.get("MATERIAL");
  section.orientation = keyword.get("ORIENTATION");
  section.shape = keyword.get("SECTION");
  section.is_composite = keyword.has("COMPOSITE");
  sections_.push_back(std::move(section));
}

void AbaqusSections::add_data(const DeckPlace& at, std::string_view line) {
  const std::vector<std::string_view> fields = split_commas(line);
  if (reading_ == "ELASTIC") {
    Material& material = materials_[name_];
    const std::size_t most = count_elastic(material.kind);
    if (material.elastic.size() >= most)
      at.fail("*ELASTIC depends on the temperature. Expected one line of it.");
    for (const std::string_view field : fields)
      material.elastic.push_back(read_deck_real(at, field));
    if (material.elastic.size() > most - 8) material.elastic.resize(most);
  } else if (reading_ == "FAIL STRESS") {
    add_strengths(at, fields);
  } else if (reading_ == "DENSITY") {
    if (!materials_[name_].density)
      materials_[name_].density = read_deck_real(at, fields[0]);
  } else if (reading_ == "ORIENTATION") {
    add_orientation(at, line);
  } else if (!sections_.empty()) {
    std::vector<std::string> texts;
    for (const std::string_view field : fields)
      texts.push_back(to_upper(std::string(field)));
    sections_.back().lines.push_back(std::move(texts));
  }
}

/// Xt, Xc, Yt, Yc, S, limits in compression of either sign; then f*, with F12 =
/// f* sqrt(F11 F22).
void AbaqusSections::add_strengths(
    const DeckPlace& at, const std::vector<std::string_view>& fields) {
  Vector6& s = materials_[name_].strengths;
  if (!s.isZero(0.0))
    at.fail(
        "*FAIL STRESS depends on the temperature, or is there twice. Expected "
        "one line of it.");
  for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 6); ++i)
    s[static_cast<Eigen::Index>(i)] = read_deck_real(at, fields[i]);
  s[1] = std::abs(s[1]);
  s[3] = std::abs(s[3]);
  if (!(s.head<5>().minCoeff() > 0.0) || std::abs(s[5]) > 1.0 ||
      (fields.size() > 6 && !fields[6].empty()))
    at.fail(
        "*FAIL STRESS: expected Xt, Xc, Yt, Yc and S other than 0, a factor "
        "from -1 to 1 or none, and no biaxial stress.");
  s[5] *= 1.0 / std::sqrt(s[0] * s[1] * s[2] * s[3]);
}

/// Points on axis 1 and in the plane 1 2, and the origin; then the axis of a
/// further rotation, and its angle.
void AbaqusSections::add_orientation(const DeckPlace& at,
                                     std::string_view line) {
  Orientation& orientation = orientations_[name_];
  if (!orientation.problem.empty()) return;
  std::vector<double> values;
  for (const std::string_view field : split_commas(line))
    values.push_back(read_deck_real(at, field));
  values.resize(9);
  if (orientation.axes) {
    if (values[0] != 3.0 && values[1] != 0.0)
      orientation.problem = fmt::format(
          "{}: *ORIENTATION rotates about another axis than 3. Expected 3, the "
          "normal of the shell.",
          at.text());
    const Matrix3& axes = *orientation.axes;
    orientation.axis =
        exp_rotation(kDegree * values[1] * axes.col(2)) * Vector3(axes.col(0));
    return;
  }
  const auto take = [&](std::size_t i) {
    return Vector3(values[i], values[i + 1], values[i + 2]);
  };
  const Vector3 a = take(0) - take(6);
  const Vector3 normal = a.cross(take(3) - take(6));
  if (!(normal.norm() > 0.0))
    at.fail(
        "*ORIENTATION has two points on one line with the origin. Expected "
        "one on axis 1 and one in the plane of axes 1 and 2.");
  Matrix3 axes;
  axes << a.normalized(), normal.cross(a).normalized(), normal.normalized();
  orientation.axes = axes;
  orientation.axis = a.normalized();
}

PlyMaterial AbaqusSections::find_material(const AbaqusSection& section,
                                          const std::string& name) const {
  const auto found = materials_.find(name);
  if (found == materials_.end())
    fail_section(section, fmt::format("its material {} is missing. Expected a "
                                      "*MATERIAL of this name.",
                                      echo(name)));
  const Material& m = found->second;
  const auto& e = m.elastic;
  PlyMaterial ply;
  if (e.empty()) {
    fail_section(section, fmt::format("its material {} has no *ELASTIC. "
                                      "Expected its constants.",
                                      echo(name)));
  } else if (m.kind.empty() || m.kind.starts_with("ISO")) {
    if (!(e[1] > -1.0 && e[1] <= 0.5))
      throw InputError(fmt::format(
          "{}: its Poisson's ratio is {}. Expected one in (-1, 0.5].", m.place,
          e[1]));
    ply = make_isotropic(e[0], e[1], 0.0);
  } else if (m.kind == "LAMINA") {
    ply = {e[0], e[1], e[2], e[3], e[4], e[5], 0.0, Vector6::Zero()};
  } else if (m.kind.starts_with("ENG") && e.size() == 16) {
    ply = {e[0], e[1], e[3], e[6], e[7], e[8], 0.0, Vector6::Zero()};
  } else {
    throw InputError(fmt::format(
        "{}: *ELASTIC of type {} is not read for beams and shells. Expected "
        "ISOTROPIC, LAMINA or ENGINEERING CONSTANTS, all of them.",
        m.place, echo(m.kind)));
  }
  if (!(ply.E_1 > 0.0 && ply.E_2 > 0.0 && ply.G_12 > 0.0 && ply.G_13 > 0.0 &&
        ply.G_23 > 0.0 && ply.nu_12 * ply.nu_12 < ply.E_1 / ply.E_2))
    throw InputError(fmt::format(
        "{}: its elastic constants are out of range. Expected moduli > 0 and "
        "nu12^2 < E1 / E2.",
        m.place));
  if (!m.density || !(*m.density > 0.0))
    throw InputError(
        fmt::format("{}: it has no *DENSITY > 0. Expected one.", m.place));
  ply.density = *m.density;
  ply.strengths = m.strengths;
  return ply;
}

BeamProperty AbaqusSections::make_beam(const AbaqusSection& section) const {
  const PlyMaterial m = find_material(section, section.material);
  const std::string& kind = materials_.at(section.material).kind;
  if (!kind.empty() && !kind.starts_with("ISO"))
    fail_section(section, "its material is not isotropic. Expected E and nu.");
  const double nu = m.nu_12;
  const auto d = [&](std::size_t i) { return read_real(section, 0, i - 1); };
  BeamProperty property{{}, {m.E_1, m.G_12, m.density}};
  bool is_fine = false;
  if (section.shape == "RECT") {  // along axes 1 and 2
    is_fine = d(1) > 0.0 && d(2) > 0.0;
    if (is_fine) property.section = make_rectangle(d(1), d(2), nu);
  } else if (section.shape == "CIRC") {
    // Abaqus has the radius, CalculiX the diameters along both axes.
    const bool is_by_diameters = d(2) != 0.0;
    is_fine = d(1) > 0.0 && (!is_by_diameters || d(2) == d(1));
    if (is_fine)
      property.section =
          make_tube(is_by_diameters ? 0.5 * d(1) : d(1), 0.0, nu);
  } else if (section.shape == "PIPE") {
    is_fine = d(1) > d(2) && d(2) > 0.0;
    if (is_fine) property.section = make_tube(d(1), d(1) - d(2), nu);
  } else if (section.shape == "BOX") {
    is_fine = d(3) > 0.0 && d(3) == d(5) && d(4) > 0.0 && d(4) == d(6) &&
              d(1) > 2.0 * d(3) && d(2) > 2.0 * d(4);
    if (is_fine)  // walls across axis 1 first
      property.section = make_box(d(1), d(2), d(3), d(4), nu);
  } else {
    fail_section(section,
                 fmt::format("the section {} is not read. Expected RECT, CIRC, "
                             "PIPE or BOX.",
                             echo(section.shape)));
  }
  if (!is_fine)
    fail_section(section,
                 fmt::format("its dimensions give no section {}. Expected them "
                             "> 0, walls thinner than the section, opposite "
                             "walls alike.",
                             section.shape));
  return property;
}

Vector3 AbaqusSections::find_beam_axis(const AbaqusSection& section) {
  const Vector3 axis = section.lines.size() < 2 ? Vector3(0.0, 0.0, -1.0)
                                                : take_vector(section, 1);
  return section.pose.R * axis;
}

Laminate AbaqusSections::make_shell(const AbaqusSection& section) const {
  std::vector<Ply> plies;
  if (!section.is_composite) {
    plies.push_back({find_material(section, section.material),
                     read_real(section, 0, 0), 0.0});
  } else {
    for (std::size_t i = 0; i < section.lines.size(); ++i) {
      const std::vector<std::string>& fields = section.lines[i];
      plies.push_back(
          {find_material(section,
                         fields.size() > 2 ? fields[2] : std::string()),
           read_real(section, i, 0), kDegree * read_real(section, i, 3)});
    }
  }
  double thickness = 0.0;
  for (const Ply& ply : plies) {
    if (!(ply.thickness > 0.0))
      fail_section(section, "a thickness is missing or not > 0. Expected one.");
    thickness += ply.thickness;
  }
  if (plies.empty())
    fail_section(section, "it has no layers. Expected one at least.");
  return make_laminate(plies, -0.5 * thickness);
}

std::optional<Vector3> AbaqusSections::find_shell_axis(
    const AbaqusSection& section) const {
  if (section.orientation.empty()) {
    if (!section.pose.R.isIdentity(1e-12) && has_directions(section))
      fail_section(section,
                   "its material has directions, in an instance that is "
                   "turned. Expected an ORIENTATION.");
    return std::nullopt;
  }
  const auto found = orientations_.find(section.orientation);
  if (found == orientations_.end() ||
      (!found->second.axes && found->second.problem.empty()))
    fail_section(section, fmt::format("its orientation {} is missing. Expected "
                                      "an *ORIENTATION of this name.",
                                      echo(section.orientation)));
  if (!found->second.problem.empty()) throw InputError(found->second.problem);
  return section.pose.R * found->second.axis;
}

bool AbaqusSections::has_directions(const AbaqusSection& section) const {
  std::vector<std::string> names = {section.material};
  if (section.is_composite) names.clear();
  for (const auto& fields : section.lines)
    if (section.is_composite && fields.size() > 2) names.push_back(fields[2]);
  return std::ranges::any_of(names, [&](const std::string& name) {
    const std::string kind = materials_.at(name).kind;
    return !kind.empty() && !kind.starts_with("ISO");
  });
}

}  // namespace limber::fem
