// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/nastran_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limber/common/echo.hpp"

namespace limber::fem {
namespace {

constexpr std::array<std::string_view, 6> kProperties = {
    "PBAR", "PBARL", "PBEAM", "PBEAML", "PSHELL", "PCOMP"};

bool is_shell(std::string_view name) {
  return name == "PSHELL" || name == "PCOMP";
}

/// Where the stations between the ends of a PBEAM's card end, and whether they
/// repeat end A.
struct Stations {
  std::size_t end = 16;
  bool are_equal = true;
};

}  // namespace

bool NastranProperties::require(bool fine, const BulkCard& card,
                                const std::string& what) {
  if (!fine)
    problems_->add(*card.line, fmt::format("{} {}: {}", card.name,
                                           echo(card.field(0)), what));
  return fine;
}

double NastranProperties::real(const BulkCard& card, std::size_t field) {
  return card.real(field, *problems_).value_or(0.0);
}

bool NastranProperties::add(const BulkCard& card) {
  if (card.name == "MAT1") {
    add_isotropic(card);
    return true;
  }
  if (card.name == "MAT8") {
    add_ply_material(card);
    return true;
  }
  if (std::ranges::find(kProperties, card.name) == kProperties.end())
    return false;
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  if (id && !cards_.emplace(*id, card).second)
    require(false, card,
            "is there twice. Expected a number of its own among properties.");
  return true;
}

void NastranProperties::add_isotropic(const BulkCard& card) {
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  Isotropic m{real(card, 1), real(card, 2), real(card, 3), real(card, 4)};
  if (!id) return;
  const bool has_E = !card.field(1).empty();
  const bool has_G = !card.field(2).empty();
  const bool has_nu = !card.field(3).empty();
  if (!has_E && has_G && has_nu) m.E = 2.0 * (1.0 + m.nu) * m.G;
  if (has_E && !has_G) m.G = 0.5 * m.E / (1.0 + m.nu);
  if (has_E && has_G && !has_nu) m.nu = 0.5 * m.E / m.G - 1.0;
  if (!require(m.E > 0.0 && m.G > 0.0 && m.nu > -1.0 && m.nu <= 0.5 &&
                   m.density >= 0.0,
               card,
               "E, G, NU or RHO is out of range. Expected E and G > 0, NU in "
               "(-1, 0.5], RHO >= 0."))
    return;
  require(isotropic_.emplace(*id, m).second && !plies_.contains(*id), card,
          "is there twice. Expected a number of its own among materials.");
}

/// Xt, Xc, Yt, Yc, S, with Xc = Xt and Yc = Yt if blank, and F12.
Vector6 NastranProperties::find_strengths(const BulkCard& card) {
  Vector6 strengths = Vector6::Zero();
  for (std::size_t i = 0; i < 5; ++i)
    strengths[static_cast<Eigen::Index>(i)] = real(card, 11 + i);
  if (card.field(12).empty()) strengths[1] = strengths[0];
  if (card.field(14).empty()) strengths[3] = strengths[2];
  if (strengths.isZero(0.0)) return strengths;
  if (!require(card.field(18).empty() || real(card, 18) == 0.0, card,
               "its strengths are strains (STRN). Expected stresses.") ||
      !require(strengths.head<5>().minCoeff() > 0.0, card,
               "some of Xt, Xc, Yt, Yc, S are missing or not > 0. Expected "
               "all of them, or none."))
    return Vector6::Zero();
  strengths[5] = real(card, 17);
  const double product = strengths.head<4>().prod();
  if (!require(strengths[5] * strengths[5] * product < 1.0, card,
               "F12 is out of range. Expected F12^2 < 1 / (Xt Xc Yt Yc)."))
    return Vector6::Zero();
  return strengths;
}

void NastranProperties::add_ply_material(const BulkCard& card) {
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  PlyMaterial m{real(card, 1), real(card, 2),       real(card, 3),
                real(card, 4), real(card, 5),       real(card, 6),
                real(card, 7), find_strengths(card)};
  if (!id) return;
  if (m.G_13 == 0.0 || m.G_23 == 0.0)
    notices_.push_back(
        fmt::format("MAT8 {}: G1,Z or G2,Z is blank, which is no transverse "
                    "shear in Nastran; here it is G12",
                    *id));
  if (m.G_13 == 0.0) m.G_13 = m.G_12;
  if (m.G_23 == 0.0) m.G_23 = m.G_12;
  if (!require(m.E_1 > 0.0 && m.E_2 > 0.0 && m.G_12 > 0.0 && m.G_13 > 0.0 &&
                   m.G_23 > 0.0 && m.density >= 0.0 &&
                   m.nu_12 * m.nu_12 < m.E_1 / m.E_2,
               card,
               "E1, E2, NU12, G12, G1,Z, G2,Z or RHO is out of range. Expected "
               "moduli > 0, NU12^2 < E1 / E2, RHO >= 0."))
    return;
  require(plies_.emplace(*id, m).second && !isotropic_.contains(*id), card,
          "is there twice. Expected a number of its own among materials.");
}

std::optional<NastranProperties::Isotropic> NastranProperties::find_isotropic(
    const BulkCard& card, std::size_t field) {
  const std::optional<int> id = card.integer(field, std::nullopt, *problems_);
  if (!id) return std::nullopt;
  const auto found = isotropic_.find(*id);
  if (!require(found != isotropic_.end(), card,
               fmt::format("its material {} is no MAT1 of the deck. Expected "
                           "one.",
                           *id)))
    return std::nullopt;
  return found->second;
}

std::optional<PlyMaterial> NastranProperties::find_ply_material(
    const BulkCard& card, int id) {
  const auto ply = plies_.find(id);
  if (ply != plies_.end()) return ply->second;
  const auto found = isotropic_.find(id);
  if (!require(found != isotropic_.end(), card,
               fmt::format("its material {} is no MAT1 or MAT8 of the deck. "
                           "Expected one.",
                           id)))
    return std::nullopt;
  const Isotropic& m = found->second;
  return PlyMaterial{m.E, m.E, m.nu, m.G, m.G, m.G, m.density, Vector6::Zero()};
}

// ---- beams
std::optional<BeamProperty> NastranProperties::find_beam(int id,
                                                         const DeckLine& user) {
  const auto card = cards_.find(id);
  if (card == cards_.end() || is_shell(card->second.name)) {
    problems_->add(user, fmt::format("its property {} is missing. Expected a "
                                     "PBAR, PBARL, PBEAM or PBEAML.",
                                     id));
    return std::nullopt;
  }
  const auto [entry, is_new] = beams_.try_emplace(id);
  if (!is_new) return entry->second;
  const BulkCard& p = card->second;
  entry->second = p.name == "PBAR"    ? make_bar(p)
                  : p.name == "PBEAM" ? make_tapered(p)
                                      : make_library(p);
  if (!entry->second) return std::nullopt;
  const BeamSection& s = entry->second->section;
  if (!require(s.area > 0.0 && s.I_y > 0.0 && s.I_z > 0.0 && s.torsion > 0.0 &&
                   s.I_yz * s.I_yz < s.I_y * s.I_z && s.shear_y >= 0.0 &&
                   s.shear_z >= 0.0 && s.extra_mass >= 0.0,
               p,
               "A, I1, I2, J, K1, K2 or NSM is out of range. Expected A, I1, "
               "I2, J > 0 (a beam that does not bend or twist is no part of a "
               "body that holds together), I12^2 < I1 I2, the others >= 0."))
    entry->second.reset();
  return entry->second;
}

std::optional<BeamProperty> NastranProperties::make_bar(const BulkCard& card) {
  const std::optional<Isotropic> m = find_isotropic(card, 1);
  if (!m) return std::nullopt;
  BeamSection s;
  s.area = real(card, 2);
  s.I_z = real(card, 3);
  s.I_y = real(card, 4);
  s.torsion = real(card, 5);
  s.extra_mass = real(card, 6);
  s.I_yz = real(card, 18);
  if (s.I_yz == 0.0) {  // else K1 and K2 are not used, as in Nastran
    s.shear_y = real(card, 16);
    s.shear_z = real(card, 17);
  }
  return BeamProperty{s, {m->E, m->G, m->density}};
}

std::optional<BeamProperty> NastranProperties::make_tapered(
    const BulkCard& card) {
  const std::optional<Isotropic> m = find_isotropic(card, 1);
  if (!m) return std::nullopt;
  Stations stations;
  const auto repeats = [&](std::size_t from) {
    for (std::size_t i = 2; i < 8; ++i)
      if (!card.field(from + i).empty() &&
          real(card, from + i) != real(card, i))
        return false;
    return true;
  };
  while (card.field(stations.end).starts_with("YES") ||
         card.field(stations.end) == "NO") {
    stations.are_equal &= repeats(stations.end);
    stations.end += card.field(stations.end) == "YES" ? 16 : 8;
  }
  if (!require(stations.are_equal, card,
               "its section changes along the beam. Expected the same at all "
               "stations; divide the beam."))
    return std::nullopt;
  const std::size_t k = stations.end;
  for (std::size_t i = k + 8; i < k + 16; ++i)
    if (!require(real(card, i) == 0.0, card,
                 "centre of mass or neutral axis is not at the shear centre "
                 "(M1, M2, N1, N2). Expected none of these; move the beam by "
                 "its offsets."))
      return std::nullopt;
  for (const std::size_t i : {k + 4, k + 5})
    if (!require(real(card, i) == 0.0, card,
                 "NSI is not read. Expected none; add a CONM2."))
      return std::nullopt;
  if (real(card, k + 6) != 0.0 || real(card, k + 7) != 0.0)
    notices_.push_back(
        fmt::format("PBEAM {}: warping (CW) is not modelled", card.field(0)));
  BeamSection s;
  s.area = real(card, 2);
  s.I_z = real(card, 3);
  s.I_y = real(card, 4);
  s.I_yz = real(card, 5);
  s.torsion = real(card, 6);
  s.extra_mass = real(card, 7);
  if (s.I_yz == 0.0) {
    s.shear_y = card.field(k).empty() ? 1.0 : real(card, k);
    s.shear_z = card.field(k + 1).empty() ? 1.0 : real(card, k + 1);
  }
  return BeamProperty{s, {m->E, m->G, m->density}};
}

/// Dimensions: MSC Nastran Quick Reference Guide, PBARL. y is up, z across.
std::optional<BeamProperty> NastranProperties::make_library(
    const BulkCard& card) {
  const std::optional<Isotropic> m = find_isotropic(card, 1);
  if (!m) return std::nullopt;
  const std::string_view type = card.field(3);
  const auto d = [&](std::size_t i) { return real(card, 7 + i); };
  BeamSection s;
  std::size_t count = 0;
  bool is_fine = false;
  if (type == "ROD") {
    count = 1;
    is_fine = d(1) > 0.0;
    if (is_fine) s = make_tube(d(1), 0.0, m->nu);
  } else if (type == "TUBE" || type == "TUBE2") {
    count = 2;
    const double inner = type == "TUBE" ? d(2) : d(1) - d(2);
    is_fine = d(1) > inner && inner >= 0.0;
    if (is_fine) s = make_tube(d(1), inner, m->nu);
  } else if (type == "BAR") {
    count = 2;
    is_fine = d(1) > 0.0 && d(2) > 0.0;
    if (is_fine) s = make_rectangle(d(2), d(1), m->nu);
  } else if (type == "BOX") {
    count = 4;
    is_fine =
        d(3) > 0.0 && d(4) > 0.0 && d(1) > 2.0 * d(4) && d(2) > 2.0 * d(3);
    if (is_fine) s = make_box(d(2), d(1), d(3), d(4), m->nu);
  } else if (type == "I") {
    count = 6;
    if (!require(d(2) == d(3) && d(5) == d(6), card,
                 "its flanges differ, so that its shear centre is not its "
                 "centroid. Expected two equal ones."))
      return std::nullopt;
    is_fine = d(4) > 0.0 && d(5) > 0.0 && d(2) >= d(4) && d(1) > 2.0 * d(5);
    if (is_fine) s = make_i_section(d(1), d(2), d(5), d(4), m->nu);
  } else {
    require(false, card,
            fmt::format("section '{}' is not known. Expected ROD, TUBE, TUBE2, "
                        "BAR, BOX or I; give others by A, I1, I2, J (PBAR).",
                        echo(type)));
    return std::nullopt;
  }
  if (!require(is_fine, card,
               fmt::format("its dimensions give no section {}. Expected {} of "
                           "them, > 0, walls thinner than the section.",
                           type, count)))
    return std::nullopt;
  for (std::size_t i = 8 + count + 1; i < card.fields.size(); ++i)
    if (!require(card.field(i).empty(), card,
                 "more than one station. Expected the same section along the "
                 "beam; divide it."))
      return std::nullopt;
  s.extra_mass = d(count + 1);
  return BeamProperty{s, {m->E, m->G, m->density}};
}

// ---- shells
std::optional<Laminate> NastranProperties::find_shell(int id,
                                                      const DeckLine& user) {
  const auto card = cards_.find(id);
  if (card == cards_.end() || !is_shell(card->second.name)) {
    problems_->add(user, fmt::format("its property {} is missing. Expected a "
                                     "PSHELL or PCOMP.",
                                     id));
    return std::nullopt;
  }
  const auto [entry, is_new] = shells_.try_emplace(id);
  if (is_new)
    entry->second = card->second.name == "PCOMP" ? make_stack(card->second)
                                                 : make_plate(card->second);
  return entry->second;
}

std::optional<Laminate> NastranProperties::make_plate(const BulkCard& card) {
  constexpr double kRigidShear = 1e3;  // of the membrane's, for a blank MID3
  const double t = real(card, 2);
  const bool has_bending = !card.field(3).empty();
  if (!require(t > 0.0, card, "T is blank or not > 0. Expected a thickness.") ||
      !require(has_bending && !card.field(1).empty(), card,
               "MID1 or MID2 is blank: a membrane or a plate alone does not "
               "hold together as a body. Expected both.") ||
      !require(card.field(10).empty(), card,
               "MID4 is not read. Expected none; use PCOMP."))
    return std::nullopt;
  const auto find = [&](std::size_t field) -> std::optional<PlyMaterial> {
    const std::optional<int> id = card.integer(field, std::nullopt, *problems_);
    return id ? find_ply_material(card, *id) : std::nullopt;
  };
  const std::optional<PlyMaterial> membrane = find(1);
  const std::optional<PlyMaterial> bending = find(3);
  const std::optional<PlyMaterial> shear = find(card.field(5).empty() ? 3 : 5);
  if (!membrane || !bending || !shear) return std::nullopt;
  const double ratio = card.field(4).empty() ? 1.0 : real(card, 4);
  const double factor = card.field(6).empty() ? 5.0 / 6.0 : real(card, 6);
  if (!require(ratio > 0.0 && factor > 0.0 && real(card, 7) >= 0.0, card,
               "12I/T^3, TS/T or NSM is out of range. Expected the first two > "
               "0."))
    return std::nullopt;
  Laminate laminate = make_laminate({{*membrane, t, 0.0}}, -0.5 * t);
  const Laminate plate = make_laminate({{*bending, t, 0.0}}, -0.5 * t);
  laminate.D = ratio * plate.D;
  for (std::size_t i = 0; i < plate.points.size(); ++i)
    laminate.points[i].bending = plate.points[i].bending;
  laminate.S = factor * 1.2 * make_laminate({{*shear, t, 0.0}}, -0.5 * t).S;
  if (card.field(5).empty()) laminate.S *= kRigidShear;
  laminate.mass += real(card, 7);
  return laminate;
}

std::optional<Laminate> NastranProperties::make_stack(const BulkCard& card) {
  constexpr std::size_t kFirst = 8;
  constexpr double kDegree = std::numbers::pi / 180.0;
  const std::string_view kind = card.field(7);
  if (!require(kind.empty() || kind == "SYM", card,
               fmt::format("LAM is {}. Expected blank or SYM.", echo(kind))))
    return std::nullopt;
  std::vector<Ply> plies;
  std::optional<int> material;
  double t = 0.0;
  for (std::size_t i = kFirst; i < card.fields.size(); i += 4) {
    const bool is_blank = card.field(i).empty() && card.field(i + 1).empty() &&
                          card.field(i + 2).empty();
    if (is_blank) continue;
    if (!card.field(i).empty())
      material = card.integer(i, std::nullopt, *problems_);
    if (!card.field(i + 1).empty()) t = real(card, i + 1);
    if (!material ||
        !require(t > 0.0, card,
                 "a ply has no thickness > 0. Expected MID, T and THETA."))
      return std::nullopt;
    const std::optional<PlyMaterial> found = find_ply_material(card, *material);
    if (!found) return std::nullopt;
    plies.push_back({*found, t, kDegree * real(card, i + 2)});
  }
  if (!require(!plies.empty(), card, "it has no plies. Expected one at least."))
    return std::nullopt;
  if (kind == "SYM") plies.insert(plies.end(), plies.rbegin(), plies.rend());
  double thickness = 0.0;
  for (const Ply& ply : plies) thickness += ply.thickness;
  const double bottom =
      card.field(1).empty() ? -0.5 * thickness : real(card, 1);
  Laminate laminate = make_laminate(plies, bottom);
  laminate.mass += real(card, 2);
  return laminate;
}

}  // namespace limber::fem
