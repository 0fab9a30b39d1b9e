// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/nastran_materials.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::fem {

bool NastranMaterials::require(bool fine, const BulkCard& card,
                               const std::string& what) {
  return card.require(fine, what, *problems_);
}

std::optional<std::vector<double>> NastranMaterials::read_reals(
    const BulkCard& card, std::size_t first, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = first; i < first + count; ++i) {
    const std::optional<double> value = card.real(i, *problems_);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

bool NastranMaterials::add(const BulkCard& card) {
  if (card.name != "MAT1" && card.name != "MAT2" && card.name != "MAT8")
    return false;
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  if (!id ||
      !require(numbers_.insert(*id).second, card,
               "is there twice. Expected a number of its own among materials."))
    return true;
  if (card.name == "MAT1") {
    add_isotropic(card, *id);
  } else if (card.name == "MAT2") {
    add_plate(card, *id);
  } else {
    add_ply(card, *id);
  }
  if (!isotropic_.contains(*id) && !plates_.contains(*id) &&
      !plies_.contains(*id))
    wrong_.insert(*id);
  return true;
}

void NastranMaterials::add_isotropic(const BulkCard& card, int id) {
  const auto read = read_reals(card, 1, 4);
  if (!read) return;
  Isotropic m{(*read)[0], (*read)[1], (*read)[2], (*read)[3]};
  const bool has_E = !card.field(1).empty();
  const bool has_G = !card.field(2).empty();
  const bool has_nu = !card.field(3).empty();
  if (!has_E && has_G && has_nu) m.E = 2.0 * (1.0 + m.nu) * m.G;
  if (has_E && !has_G) m.G = 0.5 * m.E / (1.0 + m.nu);
  if (has_E && has_G && !has_nu) m.nu = 0.5 * m.E / m.G - 1.0;
  if (require(m.E > 0.0 && m.G > 0.0 && m.nu > -1.0 && m.nu <= 0.5 &&
                  m.density >= 0.0,
              card,
              "E, G, NU or RHO is out of range. Expected E and G > 0, NU in "
              "(-1, 0.5], RHO >= 0."))
    isotropic_.emplace(id, m);
}

/// G11, G12, G13, G22, G23, G33 and RHO.
void NastranMaterials::add_plate(const BulkCard& card, int id) {
  const auto read = read_reals(card, 1, 7);
  if (!read) return;
  const std::vector<double>& G = *read;
  PlyMaterial m;
  m.plane_stress << G[0], G[1], G[2], G[1], G[3], G[4], G[2], G[4], G[5];
  m.density = G[6];
  if (!require(dense::find_eigenpairs(m.plane_stress).values.minCoeff() > 0.0 &&
                   m.density >= 0.0,
               card,
               "G11, ..., G33 are not positive definite, or RHO is below 0. "
               "Expected the stiffness of a plate in plane stress, also where "
               "only transverse shear (MID3) is meant."))
    return;
  const Matrix3 flexibility = m.plane_stress.inverse();
  m.E_1 = 1.0 / flexibility(0, 0);
  m.E_2 = 1.0 / flexibility(1, 1);
  m.nu_12 = -flexibility(0, 1) / flexibility(0, 0);
  m.G_12 = 1.0 / flexibility(2, 2);
  m.G_13 = m.G_12;
  m.G_23 = m.G_12;
  plates_.emplace(id, m);
}

/// Xt, Xc, Yt, Yc, S, with Xc = Xt and Yc = Yt if blank, and F12.
std::optional<Vector6> NastranMaterials::find_strengths(const BulkCard& card) {
  const auto read = read_reals(card, 11, 8);
  if (!read) return std::nullopt;
  Vector6 strengths = Vector6::Zero();
  for (std::size_t i = 0; i < 5; ++i)
    strengths[static_cast<Eigen::Index>(i)] = (*read)[i];
  if (card.field(12).empty()) strengths[1] = strengths[0];
  if (card.field(14).empty()) strengths[3] = strengths[2];
  if (strengths.isZero(0.0)) return strengths;
  strengths[5] = (*read)[6];
  const double product = strengths.head<4>().prod();
  if (!require((*read)[7] == 0.0, card,
               "its strengths are strains (STRN). Expected stresses.") ||
      !require(strengths.head<5>().minCoeff() > 0.0, card,
               "some of Xt, Xc, Yt, Yc, S are missing or not > 0. Expected "
               "all of them, or none.") ||
      !require(strengths[5] * strengths[5] * product < 1.0, card,
               "F12 is out of range. Expected F12^2 < 1 / (Xt Xc Yt Yc)."))
    return std::nullopt;
  return strengths;
}

void NastranMaterials::add_ply(const BulkCard& card, int id) {
  const auto read = read_reals(card, 1, 7);
  const std::optional<Vector6> strengths = find_strengths(card);
  if (!read || !strengths) return;
  PlyMaterial m{(*read)[0], (*read)[1], (*read)[2], (*read)[3],
                (*read)[4], (*read)[5], (*read)[6], *strengths};
  if (m.G_13 == 0.0 || m.G_23 == 0.0)
    notices_.push_back(
        fmt::format("MAT8 {}: G1,Z or G2,Z is blank, which is no transverse "
                    "shear in Nastran; here it is G12",
                    id));
  if (m.G_13 == 0.0) m.G_13 = m.G_12;
  if (m.G_23 == 0.0) m.G_23 = m.G_12;
  if (require(m.E_1 > 0.0 && m.E_2 > 0.0 && m.G_12 > 0.0 && m.G_13 > 0.0 &&
                  m.G_23 > 0.0 && m.density >= 0.0 &&
                  m.nu_12 * m.nu_12 < m.E_1 / m.E_2,
              card,
              "E1, E2, NU12, G12, G1,Z, G2,Z or RHO is out of range. Expected "
              "moduli > 0, NU12^2 < E1 / E2, RHO >= 0."))
    plies_.emplace(id, m);
}

std::nullopt_t NastranMaterials::refuse_missing(const BulkCard& card, int id,
                                                const char* expected) {
  if (!wrong_.contains(id))
    require(false, card,
            fmt::format("its material {} is no {} of the deck. Expected one.",
                        id, expected));
  return std::nullopt;
}

void NastranMaterials::note_density(int id, double density) {
  if (density == 0.0 && weightless_.insert(id).second)
    notices_.push_back(fmt::format(
        "material {} has no density (RHO): its elements have no mass", id));
}

std::optional<NastranMaterials::Isotropic> NastranMaterials::find_isotropic(
    const BulkCard& card, std::size_t field) {
  const std::optional<int> id = card.integer(field, std::nullopt, *problems_);
  if (!id) return std::nullopt;
  const auto found = isotropic_.find(*id);
  if (found == isotropic_.end()) return refuse_missing(card, *id, "MAT1");
  note_density(*id, found->second.density);
  return found->second;
}

std::optional<PlyMaterial> NastranMaterials::find_ply(const BulkCard& card,
                                                      int id, bool has_mass) {
  const auto ply = plies_.find(id);
  const auto found = isotropic_.find(id);
  PlyMaterial material;
  if (ply != plies_.end()) {
    material = ply->second;
  } else if (found != isotropic_.end()) {
    const Isotropic& m = found->second;
    material = {m.E, m.E, m.nu, m.G, m.G, m.G, m.density, Vector6::Zero()};
  } else {
    return refuse_missing(card, id, "MAT1 or MAT8");
  }
  if (has_mass) note_density(id, material.density);
  return material;
}

std::optional<PlyMaterial> NastranMaterials::find_plate(const BulkCard& card,
                                                        std::size_t field,
                                                        bool has_mass) {
  const std::optional<int> id = card.integer(field, std::nullopt, *problems_);
  if (!id) return std::nullopt;
  const auto plate = plates_.find(*id);
  if (plate == plates_.end()) return find_ply(card, *id, has_mass);
  if (has_mass) note_density(*id, plate->second.density);
  return plate->second;
}

}  // namespace limber::fem
