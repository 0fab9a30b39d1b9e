// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/unlikely_values.hpp"

#include <fmt/format.h>

namespace limber::flexbody {

std::vector<std::string> question_material(const MaterialRegion& region) {
  constexpr double kSoftest = 1e6;           // [Pa]
  constexpr double kSoftestMetal = 2e8;      // [Pa]
  constexpr double kLightestMetal = 2500.0;  // [kg/m^3]
  constexpr double kLightest = 10.0;         // [kg/m^3]
  const Material& material = region.material;
  const std::string where =
      region.group.empty() ? "" : fmt::format(" of group '{}'", region.group);
  std::vector<std::string> questions;
  if (material.youngs_modulus < kSoftest) {
    questions.push_back(
        fmt::format("Young's modulus{} is {:g} Pa, less than that of rubber; "
                    "is it in Pa (steel: 2.1e11)?",
                    where, material.youngs_modulus));
  } else if (material.youngs_modulus < kSoftestMetal &&
             material.density > kLightestMetal) {
    questions.push_back(fmt::format(
        "Young's modulus{} is {:g} Pa, less than that of any metal, "
        "with a density of {:g} kg/m^3; is it in Pa (steel: "
        "2.1e11)?",
        where, material.youngs_modulus, material.density));
  }
  if (material.density < kLightest) {
    questions.push_back(
        fmt::format("the density{} is {:g} kg/m^3; is it in kg/m^3 (steel: "
                    "7850)?",
                    where, material.density));
  }
  return questions;
}

std::vector<std::string> question_size(const Vector3& size, double mass) {
  constexpr double kLongest = 100.0;  // [m]
  constexpr double kHeaviest = 1e6;   // [kg]
  constexpr double kShortest = 1e-3;  // [m]
  constexpr double kLightest = 1e-6;  // [kg]
  const double length = size.maxCoeff();
  if (length <= kLongest && mass <= kHeaviest && length >= kShortest &&
      mass >= kLightest) {
    return {};
  }
  return {
      fmt::format("the part is {:.3g} m long and has {:.3g} kg; is its length "
                  "unit right (unit = mm, for one)?",
                  length, mass)};
}

std::vector<std::string> question_body(const ReducedBody& body) {
  std::vector<std::string> questions = question_size(body.size, body.mass);
  const InertiaRecord& record = body.inertia_record;
  if (!record.gap.empty())
    questions.push_back("only levels rigid and uncoupled: " + record.gap);
  if (!record.notice.empty()) questions.push_back(record.notice);
  for (const InterfaceTable& table : body.interfaces) {
    if (2 * table.node_count <= body.mesh_boundary_nodes) continue;
    questions.push_back(fmt::format(
        "interface '{}' has {} nodes, of {} on the whole surface: is so much "
        "of it held as one piece?",
        table.name, table.node_count, body.mesh_boundary_nodes));
  }
  return questions;
}

}  // namespace limber::flexbody
