// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/section_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/material/section_place.hpp"

namespace limber::scene {
namespace {

using flexbody::ReducedBody;
using flexbody::SectionModes;

/// Of the shell, or of the ply that is selected.
bool fits_layer(const SectionModes& sections, std::size_t point,
                const SectionSelection& section) {
  const auto face = static_cast<SectionFace>(sections.faces[point]);
  const bool has_ply = section.ply > 0;
  if (has_ply && (face == SectionFace::outline || face == SectionFace::inner ||
                  face == SectionFace::solid ||
                  std::max(sections.plies[point], 1) != section.ply)) {
    return false;
  }
  switch (section.layer) {
    case SectionLayer::all:
      return true;
    case SectionLayer::bottom:
      return face == SectionFace::bottom ||
             (has_ply && face == SectionFace::ply_bottom);
    case SectionLayer::middle:
      return face == SectionFace::middle;
    case SectionLayer::top:
      return face == SectionFace::top ||
             (has_ply && face == SectionFace::ply_top);
  }
  return false;
}

/// Rows of the nodes whose rows, or whose faces' rows, are given.
std::set<std::size_t> find_nodes(const flexbody::StressModes& modes,
                                 const std::set<std::size_t>& rows) {
  std::set<std::size_t> nodes = rows;
  for (std::size_t i = 0; i < modes.rows.size(); ++i) {
    if (rows.contains(modes.rows[i])) nodes.insert(modes.sections.nodes[i]);
  }
  return nodes;
}

[[noreturn]] void fail_selection(const SectionModes& sections,
                                 const std::vector<std::size_t>& there) {
  if (there.empty()) {
    throw InputError(
        "no solid, no shell, and no beam whose section is given by dimensions, "
        "is at this place; expected a node of one");
  }
  std::set<std::string> names;
  for (const std::size_t point : there) {
    names.insert(name_section_point(sections, point));
  }
  throw InputError(
      fmt::format("it has no such layer; expected one of those there: {}",
                  fmt::join(names, ", ")));
}

}  // namespace

std::string name_section_point(const SectionModes& sections,
                               std::size_t point) {
  return name_section_place(static_cast<SectionFace>(sections.faces[point]),
                            sections.plies[point]);
}

std::vector<Eigen::Index> select_section_points(
    const ReducedBody& body, const std::set<std::size_t>& rows,
    StressQuantity quantity, const SectionSelection& section) {
  if (section.element > 0) {
    throw InputError("'element' is for quantity 'section_force'; leave it out");
  }
  const SectionModes& sections = body.stress->sections;
  const std::set<std::size_t> nodes = find_nodes(*body.stress, rows);
  std::vector<std::size_t> there;
  std::vector<Eigen::Index> points;
  std::size_t without = 0;
  for (std::size_t i = 0; i < sections.nodes.size(); ++i) {
    if (!nodes.contains(sections.nodes[i])) continue;
    there.push_back(i);
    if (!fits_layer(sections, i, section)) continue;
    const auto point = static_cast<Eigen::Index>(i);
    points.push_back(point);
    if (sections.strengths.col(point).isZero(0.0)) ++without;
  }
  if (points.empty()) fail_selection(sections, there);
  if (is_index(quantity) && without > 0) {
    throw InputError(fmt::format(
        "the material of {} of {} points there has no strengths; expected Xt, "
        "Xc, Yt, Yc and S in the deck (MAT8, or *FAIL STRESS)",
        without, points.size()));
  }
  return points;
}

std::set<std::size_t> find_section_rows(const ReducedBody& body,
                                        StressQuantity quantity) {
  const SectionModes& sections = body.stress->sections;
  if (sections.left_out > 0) {
    throw InputError(fmt::format(
        "its body lacks {} of {} places with stress, and the largest may be "
        "there; keep all rows (rows=\"boundary\", or 'limber reduce --rows "
        "boundary'), or select the location by 'group', 'node', 'nearest', ...",
        sections.left_out, sections.left_out + sections.nodes.size()));
  }
  if (quantity != StressQuantity::section_force && sections.bare_beams > 0) {
    throw InputError(fmt::format(
        "{} of its beams have a section without dimensions and so no stress, "
        "and the largest may be there; give their dimensions (PBARL, PBEAML), "
        "or select the location by 'group', 'node', 'nearest', ...",
        sections.bare_beams));
  }
  std::set<std::size_t> rows;
  for (std::size_t i = 0; i < sections.nodes.size(); ++i) {
    if (body.stress->on_surface[i] != 0) rows.insert(sections.nodes[i]);
  }
  rows.insert(sections.ends.begin(), sections.ends.end());
  return rows;
}

StressProbe make_section_force_probe(const ReducedBody& body,
                                     const std::set<std::size_t>& rows,
                                     const SectionSelection& section,
                                     const Pose& X_BL) {
  if (section.layer != SectionLayer::all || section.ply > 0 ||
      section.axes != StressAxes::link) {
    throw InputError(
        "'layer', 'ply' and 'axes' are not for section forces, which are in "
        "the axes of the beam's section; leave them out");
  }
  const SectionModes& sections = body.stress->sections;
  const std::set<std::size_t> nodes = find_nodes(*body.stress, rows);
  std::vector<std::size_t> ends;
  std::set<std::size_t> there;  // numbers of beams
  for (std::size_t i = 0; i < sections.ends.size(); ++i) {
    if (!nodes.contains(sections.ends[i])) continue;
    there.insert(sections.elements[i]);
    const bool is_meant =
        section.element == 0 ||
        sections.elements[i] == static_cast<std::size_t>(section.element);
    if (is_meant) ends.push_back(i);
  }
  if (ends.empty()) {
    throw InputError(
        there.empty()
            ? std::string("no beam ends at this place; expected a node of one")
            : fmt::format("beam {} does not end there; expected one of {}",
                          section.element, fmt::join(there, ", ")));
  }
  StressProbe probe;
  probe.quantity = StressQuantity::section_force;
  const auto count = std::ssize(ends);
  probe.p_L.resize(3, count);
  probe.Sigma_L.resize(6 * count, sections.Force.cols());
  const Pose X_LB = X_BL.inverse();
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t end = ends[static_cast<std::size_t>(i)];
    const std::size_t row = sections.ends[end];
    probe.tags.push_back(body.rows.tags[row]);
    probe.layers.push_back(fmt::format("beam {}", sections.elements[end]));
    probe.p_L.col(i) =
        X_LB * Vector3(body.rows.x_B.col(static_cast<Eigen::Index>(row)));
    probe.Sigma_L.middleRows<6>(6 * i) =
        sections.Force.middleRows<6>(6 * static_cast<Eigen::Index>(end));
  }
  return probe;
}

void refuse_sections(StressQuantity quantity, const SectionSelection& section) {
  const char* what = nullptr;
  if (section.layer != SectionLayer::all) what = "'layer'";
  if (section.ply > 0) what = "'ply'";
  if (section.axes == StressAxes::layer) what = "axes = 'layer'";
  if (section.element > 0) what = "'element'";
  if (quantity == StressQuantity::section_force) what = "'section_force'";
  if (is_index(quantity)) what = "a failure index";
  if (what == nullptr) return;
  throw InputError(
      fmt::format("{} is for beams and shells, and its body consists of "
                  "solids; leave it out",
                  what));
}

}  // namespace limber::scene
