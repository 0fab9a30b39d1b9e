// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "beam.hpp"

/// Histories of the whole mesh in large rotation, by an explicit finite-element
/// program that shares no code with Limber (tests/data/beam/README.md): what
/// stands in for Akantu.
namespace limber::bench {

struct Reference {
  std::vector<double> times;  // [s]
  MatrixX u;  // 9 x T: displacements of A = (0,0,0), B = (0,0,5), C = (1,1,5)
              // [m]
};

/// @throws InputError if the file of tests/data/beam cannot be read.
[[nodiscard]] Reference read_reference(const std::string& name);

/// A, B, C of a run, 9 x T [m].
[[nodiscard]] MatrixX follow_corners(const dynamics::SystemModel& model,
                                     const Run& run);

/// Root mean square over A, B, C of the difference, in percent of that of the
/// reference: at each time, and over all times.
struct Difference {
  std::vector<double> percent;
  double overall = 0.0;
};
[[nodiscard]] Difference compare(const MatrixX& u, const Reference& reference);

}  // namespace limber::bench
