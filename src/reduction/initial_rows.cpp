// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/initial_rows.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"

namespace limber::flexbody {

void check_initial_fields(const MeshedBody& body, const Recipe& recipe) {
  const Eigen::Index rows = body.support.matrices.dof_count();
  std::vector<std::string> problems;
  for (const auto* field :
       {&recipe.initial_displacement, &recipe.initial_velocity}) {
    if (field->values.size() == 0) continue;
    if (field->values.size() != rows)
      problems.push_back(fmt::format(
          "{}: {} rows; expected {}, three for each of the {} nodes that are "
          "not clamped",
          field->name, field->values.size(), rows, rows / 3));
    if (!field->values.allFinite())
      problems.push_back(fmt::format(
          "{}: it contains values that are not finite", field->name));
  }
  if (!problems.empty()) throw InputError(problems);
}

InitialDeformation project_initial_fields(const MeshedBody& body,
                                          const Recipe& recipe,
                                          const ReducedBasis& basis) {
  const auto project =
      [&](const NodalField& field) -> std::optional<ProjectedField> {
    if (field.values.size() == 0) return std::nullopt;
    return project_field(field.values, basis.Phi, body.support.matrices.M_s,
                         body.support.R);
  };
  return {project(recipe.initial_displacement),
          project(recipe.initial_velocity)};
}

}  // namespace limber::flexbody
