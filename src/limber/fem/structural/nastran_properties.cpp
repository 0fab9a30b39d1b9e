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

/// Stiffness against [gamma_13, gamma_23]. @param is_stated by the first two
/// rows of a MAT2, which MID3 names
Matrix2 make_shear(const PlyMaterial& m, bool is_stated) {
  if (is_stated && !m.plane_stress.isZero(0.0))
    return m.plane_stress.topLeftCorner<2, 2>();
  return Eigen::Vector2d(m.G_13, m.G_23).asDiagonal();
}

}  // namespace

bool NastranProperties::require(bool fine, const BulkCard& card,
                                const std::string& what) {
  return card.require(fine, what, *problems_);
}

double NastranProperties::real(const BulkCard& card, std::size_t field) {
  return card.real(field, *problems_).value_or(0.0);
}

bool NastranProperties::add(const BulkCard& card) {
  if (materials_.add(card)) return true;
  if (card.name == "BAROR" || card.name == "BEAMOR") {
    if (!defaults_.emplace(card.name == "BAROR" ? "CBAR" : "CBEAM", card)
             .second)
      problems_->add(
          *card.line,
          fmt::format("a second {}. Expected one at most.", card.name));
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

BulkCard NastranProperties::fill_bar(BulkCard card) const {
  const auto found = defaults_.find(card.name);
  if (found == defaults_.end()) return card;
  const auto take = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i)
      if (!card.field(i).empty()) return;
    card.fields.resize(std::max(card.fields.size(), last + 1));
    for (std::size_t i = first; i <= last; ++i)
      card.fields[i] = found->second.field(i);
  };
  take(1, 1);  // PID
  take(4, 6);  // X1 or G0, X2, X3
  take(7, 7);  // OFFT
  return card;
}

std::vector<std::string> NastranProperties::notices() const {
  std::vector<std::string> all = materials_.notices();
  all.insert(all.end(), notices_.begin(), notices_.end());
  return all;
}

// ---- beams
std::optional<BeamProperty> NastranProperties::find_beam(int id,
                                                         const DeckLine& user) {
  const auto card = cards_.find(id);
  if (card == cards_.end() || is_shell(card->second.name)) {
    if (missing_.insert(id).second)
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
  const auto m = materials_.find_isotropic(card, 1);
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
  const auto m = materials_.find_isotropic(card, 1);
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
  const auto m = materials_.find_isotropic(card, 1);
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
    if (missing_.insert(id).second)
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
  const auto membrane = materials_.find_plate(card, 1, true);
  const auto bending = materials_.find_plate(card, 3, false);
  const auto shear =
      materials_.find_plate(card, card.field(5).empty() ? 3 : 5, false);
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
  if (card.field(5).empty()) {
    laminate.S = kRigidShear * factor * t * make_shear(*shear, false);
  } else {
    laminate.S = factor * t * make_shear(*shear, true);
  }
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
    const auto found = materials_.find_ply(card, *material);
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
