// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/stated_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"

namespace limber {
namespace {

using Problems = std::vector<std::string>;

void require_count(const std::vector<double>& values, std::size_t count,
                   const std::string& what, Problems& problems) {
  if (values.size() == count) return;
  problems.push_back(fmt::format("{}; given: {}", what, values.size()));
}

void check_counts(const StatedMaterial& stated, Problems& problems) {
  if (!stated.stiffness.empty()) {
    require_count(stated.stiffness, 21,
                  "the stiffness needs 21 constants C11, C12, .., C16, C22, ..",
                  problems);
    if (!stated.youngs_modulus.empty() || !stated.poisson_ratio.empty() ||
        !stated.shear_modulus.empty())
      problems.push_back(
          "the stiffness replaces Young's and shear moduli and Poisson's "
          "ratios; give only one of the two");
    return;
  }
  if (!stated.shear_modulus.empty()) {
    require_count(stated.youngs_modulus, 3,
                  "an orthotropic material needs Young's moduli E1, E2, E3",
                  problems);
    require_count(stated.poisson_ratio, 3,
                  "an orthotropic material needs Poisson's ratios nu12, nu13, "
                  "nu23",
                  problems);
    require_count(stated.shear_modulus, 3,
                  "an orthotropic material needs shear moduli G12, G13, G23",
                  problems);
    return;
  }
  const char* remedy =
      " (an orthotropic material has three, and three shear moduli)";
  require_count(stated.youngs_modulus, 1,
                std::string("needs one Young's modulus") + remedy, problems);
  require_count(stated.poisson_ratio, 1,
                std::string("needs one Poisson's ratio") + remedy, problems);
}

void check_axes(const StatedMaterial& stated, Problems& problems) {
  const bool is_constant = stated.axis_1 || stated.axis_2;
  const bool is_cylinder = stated.cylinder_axis || stated.cylinder_point;
  if (stated.axis_1.has_value() != stated.axis_2.has_value())
    problems.push_back("material axes need both axis 1 and axis 2");
  if (stated.cylinder_point && !stated.cylinder_axis)
    problems.push_back("a point on the cylinder's axis needs the axis");
  if (is_constant && is_cylinder)
    problems.push_back(
        "material axes are either constant or those of a cylinder; keep one");
  if ((is_constant || is_cylinder) && !stated.is_anisotropic())
    problems.push_back("an isotropic material has no axes");
}

MaterialAxes find_axes(const StatedMaterial& stated) {
  if (stated.cylinder_axis)
    return make_cylindrical_axes(
        *stated.cylinder_axis, stated.cylinder_point.value_or(Vector3::Zero()));
  if (stated.axis_1) return make_axes(*stated.axis_1, *stated.axis_2);
  return {};
}

Vector3 to_vector(const std::vector<double>& three) {
  return {three[0], three[1], three[2]};
}

Matrix6 find_constants(const StatedMaterial& stated) {
  if (stated.stiffness.empty())
    return make_orthotropic({to_vector(stated.youngs_modulus),
                             to_vector(stated.poisson_ratio),
                             to_vector(stated.shear_modulus)});
  Constants21 upper{};
  std::copy(stated.stiffness.begin(), stated.stiffness.end(), upper.begin());
  return make_anisotropic(upper);
}

}  // namespace

bool StatedMaterial::is_empty() const {
  return youngs_modulus.empty() && poisson_ratio.empty() &&
         shear_modulus.empty() && stiffness.empty() && density == 0.0 &&
         !axis_1 && !axis_2 && !cylinder_axis && !cylinder_point;
}

SolidMaterial make_material(const StatedMaterial& stated) {
  Problems problems;
  check_counts(stated, problems);
  check_axes(stated, problems);
  if (!problems.empty()) throw InputError(problems);
  if (!stated.is_anisotropic())
    return {stated.youngs_modulus[0], stated.poisson_ratio[0], stated.density};
  return make_material(find_constants(stated), find_axes(stated),
                       stated.density);
}

}  // namespace limber
