// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/common/types.hpp"

namespace limber {

/// Smallest and largest values of scalars in each of n intervals of time.
struct Envelopes {
  std::vector<double> edges;  ///< n + 1, increasing [s]; empty: no interval
  MatrixX least;              ///< n x scalars; NaN: no value in the interval
  MatrixX most;               ///< n x scalars

  [[nodiscard]] bool is_empty() const { return least.size() == 0; }
};

/// Ends of intervals: the start, and the output times after it, or every k-th
/// of them so that there are at most 1000 intervals, and the end.
/// @param outputs increasing [s]
[[nodiscard]] std::vector<double> choose_envelope_edges(
    double start, const std::vector<double>& outputs, double end);

/// Without values. @param edges at least two, or none
[[nodiscard]] Envelopes make_envelopes(std::vector<double> edges,
                                       std::size_t scalars);

/// Adds a value to the intervals that contain `t`, two where one ends and the
/// next begins. Later times belong to the last one. NaN is ignored.
void include(Envelopes& envelopes, std::size_t scalar, double value, double t);

/// Appends the intervals that contain times from `from` to `to` to a log of
/// checkpoints.
void write_intervals(const Envelopes& envelopes, double from, double to,
                     Archive& log);

/// Restores the intervals of a log, of which the last entry holds; those that
/// are not in `envelopes`, of a run with other outputs, are left out.
/// @throws InputError if the log is damaged.
void read_intervals(Archive& log, Envelopes& envelopes);

}  // namespace limber
