// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/peak_observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/system/interpolation.hpp"

namespace limber::dynamics {
namespace {

constexpr int kMostSearches = 6;
// Relative to the time of three samples: convergence of a search.
constexpr double kClose = 1e-3;
// A parabola may be low by this fraction of its addition.
constexpr double kParabolaError = 0.5;
// Relative to the range of three values: limit of the addition to the largest.
constexpr double kMostAdded = 0.5;

// Relative to the largest value: smaller changes are ignored.
constexpr double kSameValue = 1e-6;

bool has_switched(const SystemState& a, const SystemState& b) {
  for (std::size_t i = 0; i < a.memory.size(); ++i) {
    if (a.memory[i].switches != b.memory[i].switches ||
        a.memory[i].latch != b.memory[i].latch) {
      return true;
    }
  }
  return false;
}

// y = y_b + slope (t - t_b) + bend (t - t_b)^2 through three points a, b, c.
struct Parabola {
  double slope = 0.0;
  double bend = 0.0;
};

Parabola fit(const PeakPoints& points) {
  const auto [a, b, c] = points;
  const double left = b.t - a.t;
  const double right = c.t - b.t;
  const double rise = (b.y - a.y) / left;
  const double fall = (c.y - b.y) / right;
  return {(rise * right + fall * left) / (left + right),
          (fall - rise) / (left + right)};
}

PeakPoint find_vertex(const PeakPoints& points, const Parabola& parabola) {
  const double move = -0.5 * parabola.slope / parabola.bend;
  return {points[1].t + move, points[1].y + 0.5 * parabola.slope * move,
          points[1].place};
}

// The three of four points about the one with the largest sign * y.
PeakPoints replace(const PeakPoints& points, const PeakPoint& next,
                   double sign) {
  std::array<PeakPoint, 4> all{points[0], points[1], points[2], next};
  std::sort(all.begin(), all.end(),
            [](const PeakPoint& p, const PeakPoint& q) { return p.t < q.t; });
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (sign * all[i].y > sign * all[best].y) best = i;
  }
  const std::size_t first = best < 2 ? 0 : 1;
  return {all[first], all[first + 1], all[first + 2]};
}

}  // namespace

void exchange(Archive& archive, PeakObserver::Sample& sample) {
  archive(sample.state, sample.values, sample.places);
}

PeakObserver::PeakObserver(const SystemModel& model, Followed followed,
                           std::vector<double> edges)
    : model_(model), followed_(std::move(followed)), edges_(std::move(edges)) {}

void PeakObserver::start(const SystemState& state) {
  if (is_idle()) return;
  for (Sample& s : samples_) s.state = state;
  begin_ = between_ = within_ = state;
  peaks_.assign(followed_.courses.size(), {0.0, state.t});
  places_.assign(peaks_.size(), -1);
  envelopes_ = make_envelopes(edges_, peaks_.size());
  logged_until_ = state.t;
  if (followed_.motion_observer) followed_.motion_observer->begin();
  show(state);
  begin_anew(state);
}

void PeakObserver::show(const SystemState& state) const {
  if (followed_.motion_observer) followed_.motion_observer->include(state);
}

// Loads are evaluated before a jump at this time.
void PeakObserver::add(const SystemState& state, double t) {
  newest_ = (newest_ + 1) % 3;
  count_ = std::min(count_ + 1, 4);
  Sample& s = sample(0);
  s.state = state;
  s.state.t = t;
  if (!peaks_.empty()) followed_.evaluate(s.state, s.values);
  s.state.t = state.t;
  s.places.resize(peaks_.size());
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    s.places[i] = find_place(i);
    include(i, {s.state.t, s.values[i], s.places[i]});
  }
  if (count_ >= 3) look({count_ == 3, false});
}

void PeakObserver::begin_anew(const SystemState& state) {
  finish();
  count_ = 0;
  add(state, state.t);
}

void PeakObserver::cross_jump(const SystemState& state) {
  if (peaks_.empty()) return;
  followed_.evaluate(state, values_);
  bool jumps = false;
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    const double jump = std::abs(values_[i] - sample(0).values[i]);
    jumps |= jump > kSameValue * std::abs(peaks_[i].value);
  }
  if (jumps) begin_anew(state);
}

void PeakObserver::include(const SystemState& state) {
  if (is_idle()) return;
  const SystemState& begin = sample(0).state;
  const bool switches = has_switched(begin, state);
  const double h = state.t - begin.t;
  if (h > followed_.longest)
    add_within(state, std::ceil(h / followed_.longest));
  if (h > 0.0) {
    const SystemState* end = &state;
    if (switches) {
      between_ = state;
      between_.memory = begin.memory;
      between_.pair_memory = begin.pair_memory;
      between_.far_pairs = begin.far_pairs;
      end = &between_;
    }
    show(*end);
    add(*end, std::nextafter(state.t, -std::numeric_limits<double>::max()));
  }
  if (!switches) return;
  show(state);
  begin_anew(state);
}

// Samples at equal parts of the step to `end`.
void PeakObserver::add_within(const SystemState& end, double parts) {
  begin_ = sample(0).state;
  for (double part = 1.0; part < parts; ++part) {
    interpolate(model_, begin_, end, part / parts, between_);
    show(between_);
    add(between_, between_.t);
  }
}

const std::vector<Extreme>& PeakObserver::finish() {
  if (count_ >= 3) look({false, true});
  return peaks_;
}

void PeakObserver::look(Edges edges) {
  const Sample& a = sample(2);
  const Sample& b = sample(1);
  const Sample& c = sample(0);
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    look(i,
         {{{a.state.t, a.values[i], a.places[i]},
           {b.state.t, b.values[i], b.places[i]},
           {c.state.t, c.values[i], c.places[i]}}},
         edges);
  }
}

// Comparisons with NaN are false.
void PeakObserver::look(std::size_t scalar, const PeakPoints& points,
                        Edges edges) {
  const Parabola parabola = fit(points);
  if (!(parabola.bend != 0.0)) return;
  const double sign = parabola.bend < 0.0 ? 1.0 : -1.0;
  const auto [a, b, c] = points;
  const PeakPoint top = find_vertex(points, parabola);
  const bool is_middle = sign * b.y >= sign * a.y && sign * b.y >= sign * c.y;
  const bool is_first = edges.first && top.t > a.t && top.t < b.t;
  const bool is_last = edges.last && top.t > b.t && top.t < c.t;
  if (!is_middle && !is_first && !is_last) return;
  if (edges.last && !is_last) return;  // already searched
  const double largest = std::max({sign * a.y, sign * b.y, sign * c.y});
  const double added = sign * top.y - largest;
  const double record = std::abs(peaks_[scalar].value);
  if (!(sign * top.y + kParabolaError * added > record)) return;
  const double most =
      kMostAdded * (largest - std::min({sign * a.y, sign * b.y, sign * c.y}));
  PeakPoint found = top;
  if (followed_.courses[scalar] == Course::motion) {
    found = search(scalar, points, sign, top.t);
    if (!(sign * found.y <= largest + most)) found = top;
  }
  found.y = sign * std::min(sign * found.y, largest + most);
  include(scalar, found);
}

PeakPoint PeakObserver::evaluate_at(std::size_t scalar, double t) {
  const bool is_early = t < sample(1).state.t;
  const SystemState& begin = sample(is_early ? 2 : 1).state;
  const SystemState& end = sample(is_early ? 1 : 0).state;
  interpolate(model_, begin, end, (t - begin.t) / (end.t - begin.t), within_);
  followed_.evaluate(within_, values_);
  return {t, values_[scalar], find_place(scalar)};
}

// The largest of sign * y near t, by parabolas through the three best points.
PeakPoint PeakObserver::search(std::size_t scalar, PeakPoints points,
                               double sign, double t) {
  const double close = kClose * (points[2].t - points[0].t);
  for (int i = 0; i < kMostSearches; ++i) {
    const PeakPoint next = evaluate_at(scalar, t);
    points = replace(points, next, sign);
    const PeakPoint top = find_vertex(points, fit(points));
    if (!(top.t > points[0].t && top.t < points[2].t)) break;
    const bool is_there = std::any_of(
        points.begin(), points.end(),
        [&](const PeakPoint& p) { return std::abs(top.t - p.t) < close; });
    if (is_there) break;
    t = top.t;
  }
  return *std::max_element(points.begin(), points.end(),
                           [&](const PeakPoint& p, const PeakPoint& q) {
                             return sign * p.y < sign * q.y;
                           });
}

void PeakObserver::exchange_memory(Archive& archive) {
  archive(samples_, newest_, count_, peaks_, places_);
  if (!is_idle() && peaks_.size() != followed_.courses.size()) {
    throw InputError("the record belongs to a run that observed other scalars");
  }
  if (followed_.motion_observer)
    followed_.motion_observer->exchange_memory(archive);
  if (!archive.reads()) return;
  begin_ = between_ = within_ = samples_[0].state;
  envelopes_ = make_envelopes(edges_, peaks_.size());
  logged_until_ = sample(2).state.t;
}

// Later values lie after the oldest sample.
std::vector<double> PeakObserver::take_log() {
  Archive log;
  write_intervals(envelopes_, logged_until_, sample(0).state.t, log);
  logged_until_ = sample(2).state.t;
  return log.take_numbers();
}

void PeakObserver::restore_log(const std::vector<double>& numbers) {
  Archive log(numbers);
  read_intervals(log, envelopes_);
}

}  // namespace limber::dynamics
