// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/section_rows.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "limber/reduction/modal/kept_rows.hpp"

namespace limber::flexbody {
namespace {

/// A point that is stored.
struct KeptPoint {
  std::size_t row = 0;   // of the place
  std::size_t node = 0;  // row of its node
  Eigen::Index point = 0;
};

std::vector<KeptPoint> list_points(const fem::SectionStress& stress,
                                   const std::vector<int>& kept) {
  std::vector<KeptPoint> points;
  for (std::size_t p = 0; p < stress.points.size(); ++p) {
    const auto node = find_kept_row(kept, stress.points[p].node);
    if (!node) continue;
    const auto drawn = find_kept_row(kept, stress.points[p].drawn);
    points.push_back(
        {drawn.value_or(*node), *node, static_cast<Eigen::Index>(p)});
  }
  std::stable_sort(
      points.begin(), points.end(),
      [](const KeptPoint& a, const KeptPoint& b) { return a.row < b.row; });
  return points;
}

void add_ends(const fem::SectionStress& stress, const std::vector<int>& kept,
              SectionModes& modes) {
  std::vector<Eigen::Index> rows;
  for (std::size_t e = 0; e < stress.ends.size(); ++e) {
    const auto node = find_kept_row(kept, stress.ends[e].node);
    if (!node) continue;
    modes.elements.push_back(stress.ends[e].element);
    modes.ends.push_back(*node);
    for (Eigen::Index i = 0; i < 6; ++i)
      rows.push_back(6 * static_cast<Eigen::Index>(e) + i);
  }
  modes.Force = stress.forces(rows, Eigen::all);
}

}  // namespace

StressModes make_section_stress(const MatrixBody& meshed,
                                const std::vector<int>& kept,
                                const MatrixX& Phi) {
  const fem::SectionStress stress = meshed.part->system.recover_sections(Phi);
  const std::vector<KeptPoint> points = list_points(stress, kept);
  const auto count = std::ssize(points);
  StressModes modes;
  SectionModes& sections = modes.sections;
  modes.Sigma_B.resize(6 * count, Phi.cols());
  modes.axes.resize(9, count);
  sections.strengths.resize(6, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const KeptPoint& kept_point = points[static_cast<std::size_t>(i)];
    const fem::StressPoint& point =
        stress.points[static_cast<std::size_t>(kept_point.point)];
    modes.rows.push_back(kept_point.row);
    modes.materials.push_back(point.property);
    modes.on_surface.push_back(point.on_surface ? 1 : 0);
    modes.Sigma_B.middleRows<6>(6 * i) =
        stress.stress.middleRows<6>(6 * kept_point.point);
    sections.nodes.push_back(kept_point.node);
    sections.faces.push_back(static_cast<int>(point.face));
    sections.plies.push_back(point.ply);
    modes.axes.col(i) = point.axes.reshaped();
    sections.strengths.col(i) = point.strengths;
  }
  sections.left_out = stress.points.size() - points.size();
  sections.bare_beams = stress.bare_beams;
  add_ends(stress, kept, sections);
  modes.constants = stress.constants;
  for (const Interface& interface : meshed.interfaces) {
    std::vector<std::size_t> rows;
    for (const int node : interface.selection.nodes)
      if (const auto row = find_kept_row(kept, node)) rows.push_back(*row);
    modes.interface_rows.push_back(std::move(rows));
  }
  return modes;
}

}  // namespace limber::flexbody
