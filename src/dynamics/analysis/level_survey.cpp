// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_survey.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

constexpr std::size_t kMostPoints = 4096;  // of a track

std::vector<double> find_jumps(const SystemModel& model) {
  std::vector<double> times;
  for (const Load& load : model.loads) {
    const std::vector<double> own = break_times(load.function);
    times.insert(times.end(), own.begin(), own.end());
  }
  for (const BodyLoad& load : model.body_loads) {
    const std::vector<double>& own = load.history.times;
    times.insert(times.end(), own.begin(), own.end());
  }
  std::sort(times.begin(), times.end());
  return times;
}

bool is_held(const SystemModel& model, BodyIndex body) {
  return std::any_of(
      model.couplers.begin(), model.couplers.end(), [&](const Coupler& c) {
        return model.attachments[index(c.frame_F)].body == body ||
               model.attachments[index(c.frame_M)].body == body;
      });
}

/// Whether contacts have the same memory: those of unreduced bodies touch by
/// other laws than those of reduced ones.
bool has_same_memory(const SystemModel& a, const SystemModel& b) {
  return std::equal(a.pairs.begin(), a.pairs.end(), b.pairs.begin(),
                    b.pairs.end(), [](const Pair& one, const Pair& other) {
                      return one.law->memory_size() == other.law->memory_size();
                    });
}

void include_largest(Peak& largest, double value, double t) {
  if (value > largest.value) largest = {value, t};
}
void include_largest(VectorX& largest, const VectorX& values) {
  largest = largest.cwiseMax(values);
}

}  // namespace

LevelSurvey::Watch::Watch(const SystemModel& model, BodyIndex index_of_body,
                          const std::vector<double>& reaches)
    : body(index_of_body),
      J0_inverse(model.bodies[index(body)].J0.inverse()),
      flexibility(
          require_eigenvalues(model.bodies[index(body)], "advice on levels")
              .cwiseInverse()),
      omega(flexbody::rest_stiffness(model.bodies[index(body)].elasticity)
                .cwiseSqrt()),
      own(std::make_shared<DisplacementMeasure>(model.bodies[index(body)])),
      anywhere(std::make_shared<DisplacementMeasure>(model, body, reaches)),
      force_bound(model.bodies[index(body)].reduced->levers),
      inertial(*anywhere),
      loads(*anywhere),
      total(*anywhere),
      deformation(*own),
      axial(model, index_of_body) {
  const BodyModel& b = model.bodies[index(body)];
  LIMBER_EXPECT(b.fidelity == Fidelity::uncoupled ||
                b.fidelity == Fidelity::nonlinear);
  peaks.body = body;
  peaks.modes = VectorX::Zero(b.modes);
  peaks.oscillation = VectorX::Zero(b.modes);
  last_eta = eta = eta_inertial = eta_loads = swings = VectorX::Zero(b.modes);
  peaks.mode_sizes = anywhere->mode_sizes();
  half_size = 0.5 * b.reduced->size;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    if (model.attachments[i].body == body) reach = std::max(reach, reaches[i]);
  }
  // A body held by couplers does not rotate alone about its slenderest axis.
  compliance = J0_inverse;
  if (is_held(model, body)) {
    compliance = Matrix3::Identity() / dense::find_eigenvalues(b.J0).maxCoeff();
  }
}

LevelSurvey::LevelSurvey(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      state_(make_state(model)),
      jumps_(find_jumps(model)),
      no_memory_(model.pair_memory_size) {
  const std::vector<double> reaches = find_reaches(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].reduced) continue;
    watches_.emplace_back(model, static_cast<BodyIndex>(b), reaches);
  }
}

void LevelSurvey::include(const SystemModel& source, const SystemState& state) {
  LIMBER_EXPECT(source.bodies.size() == model_.bodies.size());
  LIMBER_EXPECT(state.bodies.size() == model_.bodies.size());
  LIMBER_EXPECT(state.memory.size() == state_.memory.size());
  state_.t = state.t;
  state_.bodies = state.bodies;
  copy_step_constants(state, state_);
  if (!shares_memory_) shares_memory_ = has_same_memory(source, model_);
  if (!*shares_memory_) state_.pair_memory = no_memory_;  // no friction then
  for (Watch& watch : watches_) {
    const BodyModel& from = source.bodies[index(watch.body)];
    const BodyModel& to = model_.bodies[index(watch.body)];
    LIMBER_EXPECT(from.modes == to.modes || from.modes == 0);
    watch.is_observed = from.modes > 0;
    watch.is_unreduced = from.full >= 0;
    watch.misses_inertial = from.fidelity == Fidelity::uncoupled;
    if (!watch.is_observed) continue;
    state_.eta.segment(to.offset, to.modes) =
        state.eta.segment(from.offset, from.modes);
    state_.etadot.segment(to.offset, to.modes) =
        state.etadot.segment(from.offset, from.modes);
  }
  // Nothing acts before the start of the scene.
  if (count_ > 0 && std::binary_search(jumps_.begin(), jumps_.end(), state.t)) {
    include(state_, Side::left);
  }
  include(state_, Side::right);
}

void LevelSurvey::include(const SystemState& state, Side side) {
  calc_terms(model_, state, side, terms_);
  for (Watch& watch : watches_) {
    const BodyTerms& terms = terms_.bodies[index(watch.body)];
    if (!model_.bodies[index(watch.body)].clamped) {
      include_rotation(state, terms, watch);
    }
    if (model_.bodies[index(watch.body)].modes > 0) {
      include_axial_load(state, side, watch);
      include_deformation(state, terms, watch);
    }
    watch.last_time = state.t;
    watch.has_begun = true;
  }
  ++count_;
  thin_tracks();
}

// Removes every second point when there are too many.
void LevelSurvey::thin_tracks() {
  bool is_full = false;
  for (const Watch& watch : watches_) {
    is_full |= watch.track.size() >= 2 * kMostPoints;
  }
  if (!is_full) return;
  for (Watch& watch : watches_) {
    std::vector<RotationPoint> kept;
    for (std::size_t i = 0; i < watch.track.size(); i += 2) {
      kept.push_back(watch.track[i]);
    }
    watch.track = std::move(kept);
  }
  stride_ *= 2;
}

void LevelSurvey::include_rotation(const SystemState& state,
                                   const BodyTerms& terms, Watch& watch) {
  const Vector3& w = state.bodies[index(watch.body)].w_WB_B;
  const double Omega = w.norm();
  const double alpha =
      (watch.J0_inverse * (terms.moment_B - terms.bias_r)).norm();
  BodyPeaks& peaks = watch.peaks;
  watch.alpha.include(alpha, state.t);
  watch.Omega.include(Omega, state.t);
  watch.report.include(alpha + Omega * Omega, state.t);
  watch.force.include(watch.force_bound.calc_force(alpha, Omega), state.t);
  peaks.Omega_B = peaks.Omega_B.cwiseMax(w.cwiseAbs());
  if (watch.has_begun) {
    peaks.angle +=
        0.5 * (Omega + watch.last_Omega) * (state.t - watch.last_time);
  }
  watch.last_Omega = Omega;
  if (count_ % stride_ == 0) watch.track.push_back({alpha, Omega});
}

void LevelSurvey::include_axial_load(const SystemState& state, Side side,
                                     Watch& watch) const {
  if (watch.is_unreduced) return;
  // Bending follows the mean over its own period, not a single step.
  const auto [now, mean_strain] = watch.axial.calc_state(state, side, terms_);
  const double strain = std::abs(mean_strain);
  const double time = state.t - watch.last_time;
  const double share = watch.has_begun
                           ? now + (watch.last_share - now) *
                                       std::exp(-time * watch.axial.frequency())
                           : now;
  BodyPeaks& peaks = watch.peaks;
  include_largest(peaks.tension, share, state.t);
  include_largest(peaks.compression, -share, state.t);
  if (watch.has_begun) {
    peaks.axial_time +=
        0.5 * (std::abs(share) + std::abs(watch.last_share)) * time;
    peaks.strain_time += 0.5 * (strain + watch.last_strain) * time;
  }
  include_largest(peaks.strain, strain, state.t);
  watch.last_share = share;
  watch.last_strain = strain;
}

// Oscillation after a change of the static response: the whole change if
// sudden, its rate over the frequency if a ramp.
void LevelSurvey::add_oscillation(const Watch& watch, const VectorX& eta,
                                  double t, VectorX& swings) {
  const double time = watch.has_begun ? t - watch.last_time : 0.0;
  swings += (eta - watch.last_eta)
                .cwiseAbs()
                .cwiseQuotient((time * watch.omega).cwiseMax(1.0));
}

void LevelSurvey::include_deformation(const SystemState& state,
                                      const BodyTerms& terms, Watch& watch) {
  const BodyModel& body = model_.bodies[index(watch.body)];
  VectorX& inertial = watch.eta_inertial;  // remains zero for a clamped body
  VectorX& eta = watch.eta;
  if (!body.clamped) {
    inertial.noalias() = body.inertia->J1.transpose() *
                         half_square(state.bodies[index(watch.body)].w_WB_B);
    inertial.array() *= watch.flexibility.array();
    watch.inertial.include(inertial, state.t);
  }
  if (watch.is_observed) {
    eta = state.eta.segment(body.offset, body.modes);
    watch.swings = state.etadot.segment(body.offset, body.modes)
                       .cwiseAbs()
                       .cwiseQuotient(watch.omega);
    if (watch.misses_inertial) {
      eta += inertial;
      add_oscillation(watch, inertial, state.t, watch.swings);
      watch.last_eta = inertial;
    }
  } else {
    watch.eta_loads = watch.flexibility.cwiseProduct(terms.modal_force);
    watch.loads.include(watch.eta_loads, state.t);
    eta = watch.eta_loads + inertial;
    watch.swings.setZero();
    add_oscillation(watch, eta, state.t, watch.swings);
    watch.last_eta = eta;
  }
  include_largest(watch.peaks.oscillation, watch.swings);
  watch.total.include(eta, state.t);
  watch.deformation.include(eta, state.t);
  const InterfaceTurn turn = find_turn(model_, watch.body, eta);
  include_largest(watch.peaks.turn, turn.own, state.t);
  include_largest(watch.peaks.relative_turn, turn.relative, state.t);
  watch.peaks.modes = watch.peaks.modes.cwiseMax(eta.cwiseAbs());
  if (!body.clamped) include_slip(body, eta, state, watch);
}

// A body of inertia J0 + dJ conserves J0 w0 = (J0 + dJ) w: it rotates more
// slowly by J0^-1 dJ w.
void LevelSurvey::include_slip(const BodyModel& body, const VectorX& eta,
                               const SystemState& state, Watch& watch) {
  const Vector3 slip = watch.compliance *
                       unpack_symmetric(body.inertia->J1 * eta) *
                       state.bodies[index(watch.body)].w_WB_B;
  if (watch.has_begun) {
    watch.slipped +=
        0.5 * (slip + watch.last_slip) * (state.t - watch.last_time);
  }
  watch.last_slip = slip;
  const Vector3 angle = watch.slipped.cwiseAbs();
  const Vector3& l = watch.half_size;
  const Vector3 corner(angle[1] * l[2] + angle[2] * l[1],
                       angle[2] * l[0] + angle[0] * l[2],
                       angle[0] * l[1] + angle[1] * l[0]);
  watch.peaks.turned_aside = std::max(
      {watch.peaks.turned_aside, corner.norm(), angle.norm() * watch.reach});
}

std::vector<BodyPeaks> LevelSurvey::find_peaks() const {
  std::vector<BodyPeaks> all;
  for (const Watch& watch : watches_) {
    BodyPeaks peaks = watch.peaks;
    const double factor = watch.is_observed ? 1.0 : kSudden;
    peaks.alpha = watch.alpha.peak();
    peaks.Omega = watch.Omega.peak();
    peaks.report = watch.report.peak();
    peaks.force = watch.force.peak();
    peaks.inertial = watch.inertial.peak();
    peaks.loads = watch.loads.peak();
    peaks.total = watch.total.peak();
    peaks.total.value *= factor;
    peaks.deformation = watch.deformation.peak();
    peaks.deformation.value *= factor;
    peaks.modes *= factor;
    peaks.turn.value *= factor;
    peaks.relative_turn.value *= factor;
    peaks.is_held = watch.axial.is_held();
    peaks.frequency = watch.axial.frequency();
    peaks.stretch = peaks.oscillation.cwiseProduct(watch.axial.stretch());
    peaks.oscillation *= factor;
    if (watch.is_observed && watch.misses_inertial) {
      // The static response is included; oscillation may add as much again.
      const double again = (kSudden - 1.0) * peaks.inertial.value;
      peaks.total.value += again;
      peaks.deformation.value += again;
    }
    all.push_back(std::move(peaks));
  }
  return all;
}

void LevelSurvey::exchange_memory(Archive& archive, Watch& watch) {
  for (RefinedPeak* peak :
       {&watch.alpha, &watch.Omega, &watch.report, &watch.force}) {
    peak->exchange_memory(archive);
  }
  for (PeakDisplacement* peak :
       {&watch.inertial, &watch.loads, &watch.total, &watch.deformation}) {
    peak->exchange_memory(archive);
  }
  archive(watch.is_observed, watch.misses_inertial, watch.has_begun,
          watch.last_time, watch.last_Omega, watch.last_eta, watch.last_slip,
          watch.slipped);
  BodyPeaks& peaks = watch.peaks;
  archive(peaks.angle, peaks.Omega_B, peaks.turned_aside, peaks.oscillation,
          peaks.modes, peaks.axial_time, peaks.strain_time, watch.last_share,
          watch.last_strain);
  for (Peak* peak : {&peaks.tension, &peaks.compression, &peaks.strain,
                     &peaks.turn, &peaks.relative_turn}) {
    archive(peak->value, peak->time);
  }
  std::size_t points = watch.track.size();
  archive.pass_size(points);
  watch.track.resize(points);
  for (RotationPoint& point : watch.track) archive(point.alpha, point.Omega);
}

void LevelSurvey::exchange_memory(Archive& archive) {
  archive(count_, stride_);
  for (Watch& watch : watches_) exchange_memory(archive, watch);
}

std::vector<std::vector<RotationPoint>> LevelSurvey::tracks() const {
  std::vector<std::vector<RotationPoint>> all;
  for (const Watch& watch : watches_) all.push_back(watch.track);
  return all;
}

}  // namespace limber::dynamics
