// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/oscillation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limber::dynamics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

class OscillationList {
 public:
  void add_load(const Load& load) {
    const std::string name = fmt::format("load '{}'", load.name);
    if (const auto* sine = std::get_if<Sinusoid>(&load.function)) {
      add(name, sine->frequency, sine->from, sine->until);
    }
    if (const auto* sum = std::get_if<HarmonicSum>(&load.function)) {
      double omega = 0.0;
      for (const Harmonic& h : sum->terms) {
        if (h.cosine != 0.0 || h.sine != 0.0) omega = std::max(omega, h.omega);
      }
      add(name, omega / kTurn, sum->from, sum->until);
    }
  }

  void add_law(const std::string& where, const joints::ScalarLaw& law) {
    const auto* drive = std::get_if<joints::Drive>(&law);
    if (drive == nullptr) return;
    const joints::Signal& signal = drive->parameters().signal;
    const auto* sine = std::get_if<joints::SineSignal>(&signal.base);
    if (sine == nullptr || sine->amplitude == 0.0) return;
    double first = kNever;
    for (const joints::Impulse& impulse : signal.shaper) {
      first = std::min(first, impulse.delay);
    }
    add(fmt::format("the drive of '{}'", where), sine->frequency,
        sine->start + first, kNever);
  }

  [[nodiscard]] std::vector<Oscillation> take() { return std::move(list_); }

 private:
  void add(const std::string& name, double frequency, double from,
           double until) {
    if (frequency > 0.0) list_.push_back({name, 1.0 / frequency, from, until});
  }

  std::vector<Oscillation> list_;
};

}  // namespace

std::vector<Oscillation> find_oscillations(const SystemModel& model) {
  OscillationList list;
  for (const Load& load : model.loads) list.add_load(load);
  for (const Coupler& coupler : model.couplers) {
    for (const joints::JointElement& element :
         joints::elements_of(coupler.law)) {
      list.add_law(coupler.name, element.law);
    }
  }
  for (const Transmission& transmission : model.transmissions) {
    for (const joints::ScalarLaw& law : transmission.laws) {
      list.add_law(transmission.name, law);
    }
  }
  return list.take();
}

const Oscillation* find_fastest(const std::vector<Oscillation>& oscillations,
                                double t) {
  const Oscillation* fastest = nullptr;
  for (const Oscillation& oscillation : oscillations) {
    if (t < oscillation.from || t >= oscillation.until) continue;
    if (!fastest || oscillation.period < fastest->period) {
      fastest = &oscillation;
    }
  }
  return fastest;
}

}  // namespace limber::dynamics
