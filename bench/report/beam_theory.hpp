// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "beam.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/elastic_inverse.hpp"

/// Section 5.7.1: the clamped beam under 500 N at its tip, by beam theory and
/// by finite elements.
namespace limber::bench {

inline constexpr double kTipForce = 500.0;  // in all [N]

struct BeamAnswer {
  double deflection = 0.0;  // of the tip [m]
  double omega = 0.0;       // first natural frequency [rad/s]
};

/// Report, eqs. 38 and 39.
[[nodiscard]] BeamAnswer find_euler_bernoulli();
/// With shear and rotary inertia.
[[nodiscard]] BeamAnswer find_timoshenko();

/// A mesh clamped at z = 0 with its load.
struct ClampedBeam {
  std::size_t nodes = 0;
  Matrix3X x;  // of the free nodes [m]
  fem::StructuralMatrices matrices;
  VectorX face;  // 500 N along x, spread evenly over the tip [N]
};
[[nodiscard]] ClampedBeam make_clamped_beam(const std::filesystem::path& file,
                                            const fem::MeshOptions& options);
[[nodiscard]] fem::ElasticInverse invert(const ClampedBeam& beam);

/// Mean deflection of the tip face, and the first frequency.
[[nodiscard]] BeamAnswer find_answer(const ClampedBeam& beam);

}  // namespace limber::bench
