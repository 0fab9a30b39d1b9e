// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/solid_materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

using Fields = std::vector<std::optional<double>>;

double value_of(const Fields& fields, std::size_t i) {
  return fields[i].value_or(0.0);
}

Vector3 three_of(const Fields& fields, std::size_t i) {
  return {value_of(fields, i), value_of(fields, i + 1),
          value_of(fields, i + 2)};
}

/// E, G, NU, RHO: two of the first three.
SolidMaterial convert_mat1(const Fields& fields) {
  const std::optional<double>& E = fields[0];
  const std::optional<double>& G = fields[1];
  const std::optional<double>& nu = fields[2];
  const double density = value_of(fields, 3);
  if (E && nu) return {*E, *nu, density};
  if (G && nu) return {2.0 * *G * (1.0 + *nu), *nu, density};
  if (E && G) return {*E, *E / (2.0 * *G) - 1.0, density};
  throw InputError("expected two of E, G and NU");
}

}  // namespace

bool SolidMaterials::add(const BulkCard& card) {
  constexpr std::size_t kMat1 = 4;    // E, G, NU, RHO
  constexpr std::size_t kMat9 = 22;   // G11 to G66, RHO
  constexpr std::size_t kMat11 = 10;  // E, NU, G, RHO
  if (card.name == "PSOLID") {
    add_property(card);
  } else if (card.name == "MAT1") {
    add_material(card, kMat1);
  } else if (card.name == "MAT9") {
    add_material(card, kMat9);
  } else if (card.name == "MAT11") {
    add_material(card, kMat11);
  } else if (card.name.starts_with("MATT")) {
    heated_.insert(card.integer(0, 0, *problems_).value_or(0));
  } else if (card.name == "PARAM" &&
             to_upper(std::string(card.field(0))) == "WTMASS") {
    mass_factor_ = card.real(1, *problems_).value_or(1.0);
    if (!(mass_factor_ > 0.0))
      problems_->add(*card.line, "WTMASS is not > 0. Expected a factor.");
  } else {
    return false;
  }
  return true;
}

void SolidMaterials::add_property(const BulkCard& card) {
  constexpr std::size_t kFunction = 6;
  if (card.field(kFunction) == "PFLUID")
    problems_->add(*card.line,
                   "PSOLID with PFLUID is a fluid. Expected solids.");
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  if (!id) return;
  Property property{card.line, std::nullopt, 0};
  if (!card.field(1).empty())
    property.material = card.integer(1, std::nullopt, *problems_);
  property.system = card.integer(2, 0, *problems_).value_or(0);
  if (!properties_.emplace(*id, property).second)
    problems_->add(*card.line,
                   fmt::format("PSOLID {} is there twice. Expected a number of "
                               "its own.",
                               *id));
}

void SolidMaterials::add_material(const BulkCard& card, std::size_t count) {
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  if (!id) return;
  Material material{fmt::format("{} {}", card.name, *id), card.line, {}};
  for (std::size_t i = 1; i <= count; ++i)
    material.fields.push_back(card.field(i).empty() ? std::nullopt
                                                    : card.real(i, *problems_));
  if (!materials_.emplace(*id, std::move(material)).second)
    problems_->add(*card.line,
                   fmt::format("material {} is there twice. Expected a number "
                               "of its own.",
                               *id));
}

std::string SolidMaterials::place_of(const DeckLine& line) const {
  return fmt::format("{}:{}", deck_->files[line.file].string(), line.number);
}

SolidMaterial SolidMaterials::convert(const Material& material,
                                      const Property& property,
                                      GridTable& grids) const {
  constexpr std::size_t kConstants = 21;
  const Fields& fields = material.fields;
  if (material.name.starts_with("MAT1 ")) {
    SolidMaterial isotropic = convert_mat1(fields);
    isotropic.density *= mass_factor_;
    return isotropic;
  }
  Matrix6 C;
  if (material.name.starts_with("MAT9")) {
    Constants21 upper{};
    for (std::size_t i = 0; i < kConstants; ++i) upper[i] = value_of(fields, i);
    C = make_anisotropic(upper);
  } else {
    C = make_orthotropic(
        {three_of(fields, 0), three_of(fields, 3), three_of(fields, 6)});
  }
  const std::optional<MaterialAxes> axes =
      grids.find_material_axes(property.system, *property.line);
  if (!axes)
    throw InputError(
        fmt::format("its axes are those of the coordinate system {} of PSOLID "
                    "({}). Expected a rectangular or cylindrical one",
                    property.system, place_of(*property.line)));
  return make_material(C, *axes, mass_factor_ * fields.back().value_or(0.0));
}

RegionMaterial SolidMaterials::find(int property, GridTable& grids) const {
  const auto own = properties_.find(property);
  if (own == properties_.end() || !own->second.material) return {};
  const int number = *own->second.material;
  RegionMaterial region;
  region.name = fmt::format("material {}", number);
  const auto found = materials_.find(number);
  if (found == materials_.end()) {
    region.problem = fmt::format(
        "PSOLID {} ({}) has the material {}, which is no MAT1, MAT9 or MAT11 "
        "of the deck. Expected it, or one in its place.",
        property, place_of(*own->second.line), number);
    return region;
  }
  region.name = found->second.name;
  try {
    if (heated_.contains(number))
      throw InputError("it depends on temperature (MATT), which is not read");
    region.material = convert(found->second, own->second, grids);
    if (!(region.material.density > 0.0))
      throw InputError("it has no density RHO");
  } catch (const InputError& error) {
    region.problem = fmt::format(
        "{} ({}) cannot be used: {}. Correct it, or give one in "
        "its place.",
        region.name, place_of(*found->second.line), error.what());
  }
  return region;
}

}  // namespace limber::fem
