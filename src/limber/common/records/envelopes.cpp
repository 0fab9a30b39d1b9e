// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/envelopes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace limber {
namespace {

// About one for each pixel of a plot.
constexpr std::size_t kMostIntervals = 1000;

void include_in(Envelopes& envelopes, Eigen::Index interval, std::size_t scalar,
                double value) {
  const auto column = static_cast<Eigen::Index>(scalar);
  double& least = envelopes.least(interval, column);
  double& most = envelopes.most(interval, column);
  if (!(least <= value)) least = value;
  if (!(most >= value)) most = value;
}

// The interval that contains `t`.
Eigen::Index find_interval(const Envelopes& envelopes, double t) {
  const auto& edges = envelopes.edges;
  const auto after = std::upper_bound(edges.begin(), edges.end(), t);
  return std::clamp<Eigen::Index>(after - edges.begin() - 1, 0,
                                  envelopes.least.rows() - 1);
}

// That, or the one before if it ends at `t`.
Eigen::Index find_first_interval(const Envelopes& envelopes, double t) {
  const Eigen::Index last = find_interval(envelopes, t);
  const bool begins = t == envelopes.edges[static_cast<std::size_t>(last)];
  return begins && last > 0 ? last - 1 : last;
}

// An interval in a log.
struct Interval {
  double from = 0.0;  // [s]
  double to = 0.0;    // [s]
  VectorX least;
  VectorX most;
};

constexpr auto fields_of(const Interval*) {
  return list_fields("interval", "from [s]", "to [s]", "least", "most");
}

Interval get_interval(const Envelopes& envelopes, Eigen::Index i) {
  const auto edge = envelopes.edges.begin() + i;
  return {*edge, *(edge + 1), envelopes.least.row(i), envelopes.most.row(i)};
}

void put_interval(const Interval& interval, Envelopes& envelopes) {
  if (envelopes.is_empty()) return;
  const Eigen::Index i = find_interval(envelopes, interval.from);
  const auto edge = envelopes.edges.begin() + i;
  if (*edge != interval.from || *(edge + 1) != interval.to ||
      interval.least.size() != envelopes.least.cols() ||
      interval.most.size() != envelopes.most.cols()) {
    return;
  }
  envelopes.least.row(i) = interval.least;
  envelopes.most.row(i) = interval.most;
}

}  // namespace

std::vector<double> choose_envelope_edges(double start,
                                          const std::vector<double>& outputs,
                                          double end) {
  std::vector<double> edges = {start};
  const auto first = std::upper_bound(outputs.begin(), outputs.end(), start);
  const auto last = std::lower_bound(first, outputs.end(), end);
  const auto count = static_cast<std::size_t>(last - first) + 1;
  const std::size_t stride = (count + kMostIntervals - 1) / kMostIntervals;
  for (std::size_t i = stride; i < count; i += stride) {
    edges.push_back(first[static_cast<std::ptrdiff_t>(i) - 1]);
  }
  if (end > edges.back()) edges.push_back(end);
  if (edges.size() < 2) edges.clear();
  return edges;
}

Envelopes make_envelopes(std::vector<double> edges, std::size_t scalars) {
  Envelopes envelopes;
  const Eigen::Index intervals =
      edges.empty() ? Eigen::Index{0} : std::ssize(edges) - 1;
  const auto columns = static_cast<Eigen::Index>(scalars);
  envelopes.edges = std::move(edges);
  envelopes.least.setConstant(intervals, columns,
                              std::numeric_limits<double>::quiet_NaN());
  envelopes.most = envelopes.least;
  return envelopes;
}

void include(Envelopes& envelopes, std::size_t scalar, double value, double t) {
  if (envelopes.is_empty() || std::isnan(value)) return;
  const Eigen::Index last = find_interval(envelopes, t);
  for (Eigen::Index i = find_first_interval(envelopes, t); i <= last; ++i) {
    include_in(envelopes, i, scalar, value);
  }
}

void write_intervals(const Envelopes& envelopes, double from, double to,
                     Archive& log) {
  if (envelopes.is_empty()) return;
  const Eigen::Index last = find_interval(envelopes, to);
  for (Eigen::Index i = find_first_interval(envelopes, from); i <= last; ++i) {
    Interval interval = get_interval(envelopes, i);
    log(interval);
  }
}

void read_intervals(Archive& log, Envelopes& envelopes) {
  while (log.has_more()) {
    Interval interval;
    log(interval);
    put_interval(interval, envelopes);
  }
}

}  // namespace limber
