// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/probes/stress_probe.hpp"

/// Where in the sections of beams and shells a probe's stress is taken.
namespace limber::scene {

/// Points at the nodes of these rows, or of nodes whose faces they are, in the
/// layer, with the strengths, that the probe requests.
/// @throws InputError naming what is there, if it is another
[[nodiscard]] std::vector<Eigen::Index> select_section_points(
    const flexbody::ReducedBody& body, const std::set<std::size_t>& rows,
    StressQuantity quantity, const SectionSelection& section);

/// Points of the whole body. @throws InputError if some have no stress
[[nodiscard]] std::set<std::size_t> find_section_rows(
    const flexbody::ReducedBody& body, StressQuantity quantity);

/// "top", "ply 2 bottom" (name_section_place).
[[nodiscard]] std::string name_section_point(
    const flexbody::SectionModes& sections, std::size_t point);

/// A probe of the section forces at the ends of beams.
/// @param X_BL link frame in the body's
/// @throws InputError if there is none
[[nodiscard]] StressProbe make_section_force_probe(
    const flexbody::ReducedBody& body, const std::set<std::size_t>& rows,
    const SectionSelection& section, const Pose& X_BL);

/// @throws InputError for what beams and shells alone have, of solids
void refuse_sections(StressQuantity quantity, const SectionSelection& section);

}  // namespace limber::scene
