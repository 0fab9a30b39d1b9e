// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "support/spring_network.hpp"

/// One lattice of springs at level `full`, and states that stir it.
namespace limber::testing {

/// Random numbers in [-scale, scale].
VectorX make_field(Eigen::Index size, double scale, unsigned seed);

/// A lattice as body 0 of a system that can be added to.
struct Lattice {
  explicit Lattice(const LatticeOptions& options = {},
                   const dynamics::ModalDamping& damping = {}, int modes = 12);
  SpringNetwork network;
  std::shared_ptr<const flexbody::FullBody> full;
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  dynamics::SystemBuilder builder;
};

/// Deformed by 2 cm of 10, turned and moving in every way.
dynamics::SystemState stir(const dynamics::SystemModel& model);

}  // namespace limber::testing
