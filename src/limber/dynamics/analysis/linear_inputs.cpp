// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/linear_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/joints/scalar/drive_gain.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
using Kind = joints::AxisCoordinate::Kind;

/// Prefix for the names of one kind of source where names are equal.
struct Named {
  std::string kind;
  LinearInput input;
};

/// A model without loads except the one to be added.
SystemModel without_loads(const SystemModel& model) {
  SystemModel alone = model;
  alone.loads.clear();
  alone.body_loads.clear();
  alone.pairs.clear();
  alone.gravity_W.setZero();
  return alone;
}

std::string unit_of(joints::DriveMode mode, Kind kind) {
  const bool is_angle = kind == Kind::angle;
  switch (mode) {
    case joints::DriveMode::position:
      return is_angle ? "rad" : "m";
    case joints::DriveMode::velocity:
      return is_angle ? "rad/s" : "m/s";
    case joints::DriveMode::effort:
      break;
  }
  return is_angle ? "N m" : "N";
}

class Inputs {
 public:
  Inputs(const SystemModel& model, const SystemState& state,
         const SmallMotion& motion, const DriveNames& names)
      : model_(model),
        state_(state),
        motion_(motion),
        names_(names),
        alone_(without_loads(model)),
        terms_(make_terms(alone_)) {
    for (const Input& input : model.inputs) {
      written_.push_back(make(input.name, "1"));
      rates_.push_back(make(input.name + ".rate", "1/s"));
    }
    calc_terms(alone_, state_, Side::right, terms_);
    coupler_motions_ = terms_.couplers;
    transmission_motions_ = terms_.transmissions;
  }

  std::vector<LinearInput> find() {
    for (const Load& load : model_.loads) add_load(load);
    for (std::size_t c = 0; c < model_.couplers.size(); ++c) add_coupler(c);
    for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
      add_transmission(i);
    }
    for (std::size_t i = 0; i < written_.size(); ++i) {
      const InputValue value = find_input(now_of(state_), static_cast<int>(i));
      written_[i].value = value.value;
      written_[i].written = static_cast<int>(i);
      rates_[i].value = value.rate;
      found_.push_back({"controller", written_[i]});
      if (acts(rates_[i])) found_.push_back({"controller", rates_[i]});
    }
    return name_all();
  }

 private:
  [[nodiscard]] LinearInput make(const std::string& name,
                                 const std::string& unit) const {
    return {name,
            unit,
            0.0,
            VectorX::Zero(motion_.size()),
            VectorX::Zero(motion_.G.rows()),
            -1};
  }

  static bool acts(const LinearInput& input) {
    return !input.force.isZero(0.0);
  }

  // The generalised force of a load at factor 1.
  VectorX find_force(const Load& load) {
    constexpr double kEver = std::numeric_limits<double>::infinity();
    alone_.loads = {load};
    alone_.loads[0].function = Constant{-kEver, kEver};
    for (CouplerTerms& c : terms_.couplers) c.applied.setZero();
    for (TransmissionTerms& t : terms_.transmissions) t.applied = 0.0;
    calc_forces(alone_, state_, Side::right, terms_, WrenchSource::iterate);
    VectorX force = VectorX::Zero(motion_.size());
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const BodyTerms& t = terms_.bodies[b];
      const Index p = motion_.places[b];
      if (p >= 0) {
        force.segment<3>(p) = t.force_W;
        force.segment<3>(p + 3) = t.R_WB * t.moment_B;
      }
      force.segment(motion_.modes[b], model_.bodies[b].modes) = t.modal_force;
    }
    return force;
  }

  void add_load(const Load& load) {
    const VectorX force = find_force(load);
    if (const auto* follows = std::get_if<InputFunction>(&load.function)) {
      written_[index(follows->input)].force += follows->factor * force;
      return;
    }
    LinearInput input = make(load.name, "1");
    input.value = evaluate(load.function, now_of(state_));
    input.force = force;
    found_.push_back({"load", std::move(input)});
  }

  // @param along change of wrenches by a unit force of the drive, from `row`
  void add_drive(const joints::Drive& drive, const joints::ScalarMotion& at,
                 const DriveSource& source, Kind kind, Index row,
                 const Vector6& along) {
    const joints::DriveGain gain = find_gain(drive, at, now_of(state_));
    const auto add = [&](LinearInput& input, double by) {
      VectorX wrenches = VectorX::Zero(motion_.G.rows());
      wrenches.segment<6>(row) = by * along;
      input.wrenches += wrenches;
      input.force += motion_.G.transpose() * wrenches;
    };
    const joints::Signal& signal = drive.parameters().signal;
    if (const auto* follows = std::get_if<joints::InputSignal>(&signal.base)) {
      add(written_[index(follows->input)], follows->factor * gain.by_value);
      add(rates_[index(follows->input)], follows->factor * gain.by_rate);
      return;
    }
    const joints::SignalValue command = evaluate(signal, now_of(state_));
    const std::string name = name_drive(source);
    const std::string unit = unit_of(drive.parameters().mode, kind);
    LinearInput input = make(name, unit);
    input.value = command.value;
    add(input, gain.by_value);
    found_.push_back({"drive", std::move(input)});
    if (gain.by_rate == 0.0) return;
    LinearInput rate = make(name + ".rate", unit + "/s");
    rate.value = command.rate;
    add(rate, gain.by_rate);
    found_.push_back({"drive", std::move(rate)});
  }

  void add_coupler(std::size_t c) {
    const Coupler& coupler = model_.couplers[c];
    DriveSource source{.coupler = static_cast<int>(c)};
    for (const auto& element : joints::elements_of(coupler.law)) {
      const auto* drive = std::get_if<joints::Drive>(&element.law);
      if (drive == nullptr) continue;
      const auto i = index(element.coordinate);
      const auto& coordinate = joints::coordinates_of(coupler.law)[i];
      const joints::CoordinateValue value = joints::evaluate(
          coordinate, coupler_motions_[c].motion, state_.memory[c].near[i]);
      add_drive(*drive, {value.z, value.rate}, source, coordinate.kind,
                6 * static_cast<Index>(c), value.gradient);
      ++source.number;
    }
  }

  void add_transmission(std::size_t i) {
    const Transmission& transmission = model_.transmissions[i];
    const Index row = 6 * static_cast<Index>(model_.couplers.size() + i);
    DriveSource source{.transmission = static_cast<int>(i)};
    for (const joints::ScalarLaw& law : transmission.laws) {
      const auto* drive = std::get_if<joints::Drive>(&law);
      if (drive == nullptr) continue;
      add_drive(*drive, transmission_motions_[i].motion, source, Kind::distance,
                row, Vector6::Unit(0));
      ++source.number;
    }
  }

  [[nodiscard]] std::string name_drive(const DriveSource& source) const {
    if (names_) return names_(source);
    const std::string& of =
        source.coupler >= 0
            ? model_.couplers[index(source.coupler)].name
            : model_.transmissions[index(source.transmission)].name;
    return source.number == 0 ? of
                              : fmt::format("{}.{}", of, source.number + 1);
  }

  std::vector<LinearInput> name_all() {
    std::vector<LinearInput> inputs;
    for (const Named& one : found_) {
      const auto same =
          std::count_if(found_.begin(), found_.end(), [&](const Named& other) {
            return other.input.name == one.input.name;
          });
      inputs.push_back(one.input);
      if (same > 1) inputs.back().name = one.kind + "." + one.input.name;
    }
    return inputs;
  }

  const SystemModel& model_;
  const SystemState& state_;
  const SmallMotion& motion_;
  const DriveNames& names_;
  SystemModel alone_;
  SystemTerms terms_;
  std::vector<CouplerTerms> coupler_motions_;
  std::vector<TransmissionTerms> transmission_motions_;
  std::vector<LinearInput> written_;  // one per input of the model
  std::vector<LinearInput> rates_;
  std::vector<Named> found_;
};

}  // namespace

std::vector<LinearInput> find_linear_inputs(const SystemModel& model,
                                            const SystemState& state,
                                            const SmallMotion& motion,
                                            const DriveNames& names) {
  return Inputs(model, state, motion, names).find();
}

}  // namespace limber::dynamics
