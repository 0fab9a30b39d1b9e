// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Beams of the report, end to end on stiff hinges.
namespace limber::bench {

/// The report's beam, ten modes: four eigenmodes and its root's six
/// static-deformation modes.
/// @param mesh file in tests/data/beam
[[nodiscard]] flexbody::ReducedBody reduce_beam(const std::string& mesh);

struct BeamChain {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

/// `count` beams, `coupled`, along z on hinges about x with bushings of 1e12
/// N/m and N m/rad, spinning about z at 1 rad/s.
/// @param swing amplitude of a force along y on the first beam's root, at
/// 20 rad/s; 0: none [N]
[[nodiscard]] BeamChain make_beam_chain(
    const std::shared_ptr<const flexbody::ReducedBody>& body, int count,
    double swing);

}  // namespace limber::bench
