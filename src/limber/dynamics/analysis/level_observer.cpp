// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_observer.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

LevelObserver::Observed::Observed(
    const SystemModel& model, BodyIndex index_of_body,
    const std::shared_ptr<const MovedNodes>& nodes,
    const std::vector<double>& reaches)
    : body(index_of_body),
      J0_inverse(model.bodies[index(body)].J0.inverse()),
      flexibility(
          require_eigenvalues(model.bodies[index(body)], "advice on levels")
              .cwiseInverse()),
      omega(flexbody::rest_stiffness(model.bodies[index(body)].elasticity)
                .cwiseSqrt()),
      own(std::make_shared<DisplacementMeasure>(nodes)),
      anywhere(
          std::make_shared<DisplacementMeasure>(nodes, model, body, reaches)),
      force_bound(model.bodies[index(body)].reduced->levers),
      inertial(*anywhere),
      loads(*anywhere),
      total(*anywhere),
      deformation(*own),
      axial(model, index_of_body),
      interfaces(find_interfaces(model, index_of_body)) {
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

LevelObserver::LevelObserver(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      state_(make_state(model)),
      jumps_(find_jumps(model)),
      no_memory_(model.pair_memory_size) {
  const std::vector<double> reaches = find_reaches(model);
  // Links of one reduced body have the same nodes.
  std::map<const flexbody::ReducedBody*, std::shared_ptr<const MovedNodes>>
      nodes;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    // Without S1 and S2 nothing is known of what a level leaves out.
    const auto& reduced = model.bodies[b].reduced;
    if (!reduced || !reduced->inertia_record.gap.empty()) continue;
    auto& of_body = nodes[reduced.get()];
    if (!of_body) of_body = std::make_shared<MovedNodes>(reduced);
    observed_.emplace_back(model, static_cast<BodyIndex>(b), of_body, reaches);
  }
}

void LevelObserver::include(const SystemModel& source,
                            const SystemState& state) {
  LIMBER_EXPECT(source.bodies.size() == model_.bodies.size());
  LIMBER_EXPECT(state.bodies.size() == model_.bodies.size());
  LIMBER_EXPECT(state.memory.size() == state_.memory.size());
  state_.t = state.t;
  state_.bodies = state.bodies;
  copy_step_constants(state, state_);
  if (!shares_memory_) shares_memory_ = has_same_memory(source, model_);
  if (!*shares_memory_) state_.pair_memory = no_memory_;  // no friction then
  for (Observed& observed : observed_) {
    const BodyModel& from = source.bodies[index(observed.body)];
    const BodyModel& to = model_.bodies[index(observed.body)];
    LIMBER_EXPECT(from.modes == to.modes || from.modes == 0);
    observed.is_observed = from.modes > 0;
    observed.is_unreduced = from.full >= 0;
    observed.misses_inertial = from.fidelity == Fidelity::uncoupled;
    if (!observed.is_observed) continue;
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

void LevelObserver::include(const SystemState& state, Side side) {
  calc_terms(model_, state, side, terms_);
  for (Observed& observed : observed_) {
    const BodyTerms& terms = terms_.bodies[index(observed.body)];
    if (!model_.bodies[index(observed.body)].clamped) {
      include_rotation(state, terms, observed);
    }
    if (model_.bodies[index(observed.body)].modes > 0) {
      include_axial_load(state, side, observed);
      include_deformation(state, terms, observed);
    }
    observed.last_time = state.t;
    observed.has_begun = true;
  }
  ++count_;
  thin_tracks();
}

// Removes every second point when there are too many.
void LevelObserver::thin_tracks() {
  bool is_full = false;
  for (const Observed& observed : observed_) {
    is_full |= observed.track.size() >= 2 * kMostPoints;
  }
  if (!is_full) return;
  for (Observed& observed : observed_) {
    std::vector<RotationPoint> kept;
    for (std::size_t i = 0; i < observed.track.size(); i += 2) {
      kept.push_back(observed.track[i]);
    }
    observed.track = std::move(kept);
  }
  stride_ *= 2;
}

void LevelObserver::include_rotation(const SystemState& state,
                                     const BodyTerms& terms,
                                     Observed& observed) {
  const Vector3& w = state.bodies[index(observed.body)].w_WB_B;
  const double Omega = w.norm();
  const double alpha =
      (observed.J0_inverse * (terms.moment_B - terms.bias_r)).norm();
  BodyPeaks& peaks = observed.peaks;
  observed.alpha.include(alpha, state.t);
  observed.Omega.include(Omega, state.t);
  observed.report.include(alpha + Omega * Omega, state.t);
  observed.force.include(observed.force_bound.calc_force(alpha, Omega),
                         state.t);
  peaks.Omega_B = peaks.Omega_B.cwiseMax(w.cwiseAbs());
  if (observed.has_begun) {
    peaks.angle +=
        0.5 * (Omega + observed.last_Omega) * (state.t - observed.last_time);
  }
  observed.last_Omega = Omega;
  if (count_ % stride_ == 0) observed.track.push_back({alpha, Omega});
}

void LevelObserver::include_axial_load(const SystemState& state, Side side,
                                       Observed& observed) const {
  if (observed.is_unreduced) return;
  // Bending follows the mean over its own period, not a single step.
  const auto [now, mean_strain] =
      observed.axial.calc_state(state, side, terms_);
  const double strain = std::abs(mean_strain);
  const double time = state.t - observed.last_time;
  const double fraction =
      observed.has_begun
          ? now + (observed.last_fraction - now) *
                      std::exp(-time * observed.axial.frequency())
          : now;
  BodyPeaks& peaks = observed.peaks;
  include_largest(peaks.tension, fraction, state.t);
  include_largest(peaks.compression, -fraction, state.t);
  if (observed.has_begun) {
    peaks.axial_time +=
        0.5 * (std::abs(fraction) + std::abs(observed.last_fraction)) * time;
    peaks.strain_time += 0.5 * (strain + observed.last_strain) * time;
  }
  include_largest(peaks.strain, strain, state.t);
  observed.last_fraction = fraction;
  observed.last_strain = strain;
}

// Oscillation after a change of the static response: the whole change if
// sudden, its rate over the frequency if a ramp.
void LevelObserver::add_oscillation(const Observed& observed,
                                    const VectorX& eta, double t,
                                    VectorX& swings) {
  const double time = observed.has_begun ? t - observed.last_time : 0.0;
  swings += (eta - observed.last_eta)
                .cwiseAbs()
                .cwiseQuotient((time * observed.omega).cwiseMax(1.0));
}

void LevelObserver::include_deformation(const SystemState& state,
                                        const BodyTerms& terms,
                                        Observed& observed) {
  const BodyModel& body = model_.bodies[index(observed.body)];
  VectorX& inertial = observed.eta_inertial;  // remains zero for a clamped body
  VectorX& eta = observed.eta;
  if (!body.clamped) {
    inertial.noalias() = body.inertia->J1() *
                         half_square(state.bodies[index(observed.body)].w_WB_B);
    inertial.array() *= observed.flexibility.array();
    observed.inertial.include(inertial, state.t);
  }
  if (observed.is_observed) {
    eta = state.eta.segment(body.offset, body.modes);
    observed.swings = state.etadot.segment(body.offset, body.modes)
                          .cwiseAbs()
                          .cwiseQuotient(observed.omega);
    if (observed.misses_inertial) {
      eta += inertial;
      add_oscillation(observed, inertial, state.t, observed.swings);
      observed.last_eta = inertial;
    }
  } else {
    observed.eta_loads = observed.flexibility.cwiseProduct(terms.modal_force);
    observed.loads.include(observed.eta_loads, state.t);
    eta = observed.eta_loads + inertial;
    observed.swings.setZero();
    add_oscillation(observed, eta, state.t, observed.swings);
    observed.last_eta = eta;
  }
  include_largest(observed.peaks.oscillation, observed.swings);
  observed.total.include(eta, state.t);
  observed.deformation.include(eta, state.t);
  const InterfaceRotation rotation = find_rotation(observed.interfaces, eta);
  include_largest(observed.peaks.rotation, rotation.own, state.t);
  include_largest(observed.peaks.relative_rotation, rotation.relative, state.t);
  observed.peaks.modes = observed.peaks.modes.cwiseMax(eta.cwiseAbs());
  if (!body.clamped) include_slip(body, eta, state, observed);
}

// A body of inertia J0 + dJ conserves J0 w0 = (J0 + dJ) w: it rotates more
// slowly by J0^-1 dJ w.
void LevelObserver::include_slip(const BodyModel& body, const VectorX& eta,
                                 const SystemState& state, Observed& observed) {
  const Vector3 slip = observed.compliance *
                       unpack_symmetric(body.inertia->J1().transpose() * eta) *
                       state.bodies[index(observed.body)].w_WB_B;
  if (observed.has_begun) {
    observed.slipped +=
        0.5 * (slip + observed.last_slip) * (state.t - observed.last_time);
  }
  observed.last_slip = slip;
  const Vector3 angle = observed.slipped.cwiseAbs();
  const Vector3& l = observed.half_size;
  const Vector3 corner(angle[1] * l[2] + angle[2] * l[1],
                       angle[2] * l[0] + angle[0] * l[2],
                       angle[0] * l[1] + angle[1] * l[0]);
  observed.peaks.turned_aside =
      std::max({observed.peaks.turned_aside, corner.norm(),
                angle.norm() * observed.reach});
}

std::vector<BodyPeaks> LevelObserver::find_peaks() const {
  std::vector<BodyPeaks> all;
  for (const Observed& observed : observed_) {
    BodyPeaks peaks = observed.peaks;
    const double factor = observed.is_observed ? 1.0 : kSudden;
    peaks.alpha = observed.alpha.peak();
    peaks.Omega = observed.Omega.peak();
    peaks.report = observed.report.peak();
    peaks.force = observed.force.peak();
    peaks.inertial = observed.inertial.peak();
    peaks.loads = observed.loads.peak();
    peaks.total = observed.total.peak();
    peaks.total.value *= factor;
    peaks.deformation = observed.deformation.peak();
    peaks.deformation.value *= factor;
    peaks.modes *= factor;
    peaks.rotation.value *= factor;
    peaks.relative_rotation.value *= factor;
    peaks.is_held = observed.axial.is_held();
    peaks.frequency = observed.axial.frequency();
    peaks.stretch = peaks.oscillation.cwiseProduct(observed.axial.stretch());
    peaks.oscillation *= factor;
    if (observed.is_observed && observed.misses_inertial) {
      // The static response is included; oscillation may add as much again.
      const double again = (kSudden - 1.0) * peaks.inertial.value;
      peaks.total.value += again;
      peaks.deformation.value += again;
    }
    all.push_back(std::move(peaks));
  }
  return all;
}

void LevelObserver::exchange_memory(Archive& archive, Observed& observed) {
  for (RefinedPeak* peak :
       {&observed.alpha, &observed.Omega, &observed.report, &observed.force}) {
    peak->exchange_memory(archive);
  }
  for (PeakDisplacement* peak : {&observed.inertial, &observed.loads,
                                 &observed.total, &observed.deformation}) {
    peak->exchange_memory(archive);
  }
  archive(observed.is_observed, observed.misses_inertial, observed.has_begun,
          observed.last_time, observed.last_Omega, observed.last_eta,
          observed.last_slip, observed.slipped);
  BodyPeaks& peaks = observed.peaks;
  archive(peaks.angle, peaks.Omega_B, peaks.turned_aside, peaks.oscillation,
          peaks.modes, peaks.axial_time, peaks.strain_time,
          observed.last_fraction, observed.last_strain);
  for (Peak* peak : {&peaks.tension, &peaks.compression, &peaks.strain,
                     &peaks.rotation, &peaks.relative_rotation}) {
    archive(peak->value, peak->time);
  }
  std::size_t points = observed.track.size();
  archive.pass_size(points);
  observed.track.resize(points);
  for (RotationPoint& point : observed.track) archive(point.alpha, point.Omega);
}

void LevelObserver::exchange_memory(Archive& archive) {
  archive(count_, stride_);
  for (Observed& observed : observed_) exchange_memory(archive, observed);
}

std::vector<std::vector<RotationPoint>> LevelObserver::tracks() const {
  std::vector<std::vector<RotationPoint>> all;
  for (const Observed& observed : observed_) all.push_back(observed.track);
  return all;
}

}  // namespace limber::dynamics
