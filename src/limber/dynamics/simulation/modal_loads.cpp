// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/modal_loads.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "limber/common/overloaded.hpp"

namespace limber::dynamics {
namespace {

using flexbody::ModalLoads;
using flexbody::SinusoidalLoad;
using flexbody::StepLoad;

const BodyModel& get_body(const SystemModel& model, BodyIndex body) {
  return model.bodies[static_cast<std::size_t>(body)];
}

const Attachment& get_attachment(const SystemModel& model, AttachmentIndex i) {
  return model.attachments[static_cast<std::size_t>(i)];
}

bool has_closed_form(const TimeFunction& function) {
  if (std::holds_alternative<Table>(function) ||
      std::holds_alternative<InputFunction>(function)) {
    return false;
  }
  const auto* pulse = std::get_if<Pulse>(&function);
  return pulse == nullptr || pulse->shape != PulseShape::triangular;
}

// factors[i] times one load vector from times[i] on.
struct Steps {
  std::vector<double> times;
  std::vector<double> factors;
};

class Collector {
 public:
  explicit Collector(Eigen::Index modes) : modes_(modes) {}

  void add(StepLoad load) { parts_.push_back(std::move(load)); }

  void add(const TimeFunction& function, const VectorX& load) {
    std::visit(
        Overloaded{
            [&](const Constant& c) { add_window(c.from, c.until, load); },
            [&](const StepSequence& s) {
              add_steps({s.times, s.values}, load);
            },
            [&](const Pulse& p) { add_pulse(p, load); },
            [&](const Sinusoid& s) {
              sinusoids_.push_back(
                  {.omega = 2.0 * std::numbers::pi * s.frequency,
                   .cosine = std::sin(s.phase) * load,
                   .sine = std::cos(s.phase) * load,
                   .from = s.from,
                   .until = s.until});
            },
            [&](const HarmonicSum& s) {
              add_window(s.from, s.until, s.mean * load);
              for (const Harmonic& h : s.terms) {
                sinusoids_.push_back({.omega = h.omega,
                                      .cosine = h.cosine * load,
                                      .sine = h.sine * load,
                                      .from = s.from,
                                      .until = s.until});
              }
            },
            [](const Table&) {},
            [](const InputFunction&) {},
        },
        function);
  }

  [[nodiscard]] ModalLoads join() const { return {join_steps(), sinusoids_}; }

 private:
  void add_steps(const Steps& steps, const VectorX& load) {
    StepLoad part{steps.times, MatrixX(modes_, std::ssize(steps.times))};
    for (Eigen::Index j = 0; j < part.values.cols(); ++j) {
      part.values.col(j) = steps.factors[static_cast<std::size_t>(j)] * load;
    }
    parts_.push_back(std::move(part));
  }

  void add_window(double from, double until, const VectorX& load) {
    if (until == kNever) {
      add_steps({{from}, {1.0}}, load);
    } else {
      add_steps({{from, until}, {1.0, 0.0}}, load);
    }
  }

  void add_pulse(const Pulse& pulse, const VectorX& load) {
    const double end = pulse.start + pulse.duration;
    if (pulse.shape == PulseShape::rectangular) {
      add_window(pulse.start, end, load);
      return;
    }
    sinusoids_.push_back({.omega = std::numbers::pi / pulse.duration,
                          .cosine = VectorX::Zero(modes_),
                          .sine = load,
                          .from = pulse.start,
                          .until = end});
  }

  // The sum of all parts, at the union of their times.
  [[nodiscard]] StepLoad join_steps() const {
    StepLoad sum;
    for (const StepLoad& part : parts_) {
      sum.times.insert(sum.times.end(), part.times.begin(), part.times.end());
    }
    std::sort(sum.times.begin(), sum.times.end());
    sum.times.erase(std::unique(sum.times.begin(), sum.times.end()),
                    sum.times.end());
    sum.values = MatrixX::Zero(modes_, std::ssize(sum.times));
    for (const StepLoad& part : parts_) {
      Eigen::Index next = 0;
      for (Eigen::Index j = 0; j < std::ssize(sum.times); ++j) {
        const double t = sum.times[static_cast<std::size_t>(j)];
        while (next < std::ssize(part.times) &&
               part.times[static_cast<std::size_t>(next)] <= t) {
          ++next;
        }
        if (next > 0) sum.values.col(j) += part.values.col(next - 1);
      }
    }
    return sum;
  }

  Eigen::Index modes_;
  std::vector<StepLoad> parts_;
  std::vector<SinusoidalLoad> sinusoids_;
};

}  // namespace

bool has_closed_modal_loads(const SystemModel& model, BodyIndex index) {
  const BodyModel& body = get_body(model, index);
  if (body.modes == 0 || body.fidelity >= Fidelity::one_way) return false;
  if (!flexbody::is_diagonal(body.elasticity)) return false;
  if (body.maxwell.size() > 0) return false;
  const auto is_here = [&](AttachmentIndex i) {
    return get_attachment(model, i).body == index;
  };
  const bool is_coupled =
      std::any_of(model.couplers.begin(), model.couplers.end(),
                  [&](const Coupler& c) {
                    return is_here(c.frame_F) || is_here(c.frame_M);
                  }) ||
      std::any_of(
          model.transmissions.begin(), model.transmissions.end(),
          [&](const Transmission& t) {
            const auto* path = std::get_if<PathCoordinate>(&t.coordinate);
            return path != nullptr && std::any_of(path->points.begin(),
                                                  path->points.end(), is_here);
          });
  const bool is_paired = std::any_of(
      model.pairs.begin(), model.pairs.end(), [&](const Pair& pair) {
        return pair.body_A == index || pair.body_B == index;
      });
  // Loads fixed in the world vary in the axes of a rotating body.
  return !is_coupled && !is_paired &&
         std::all_of(model.loads.begin(), model.loads.end(),
                     [&](const Load& load) {
                       return !is_here(load.where) ||
                              (has_closed_form(load.function) &&
                               (!body.has_rigid_motion() || !load.in_world));
                     });
}

ModalLoads find_modal_loads(const SystemModel& model, BodyIndex index,
                            const SystemState& start) {
  const BodyModel& body = get_body(model, index);
  const Matrix3 R_BW = start.bodies[static_cast<std::size_t>(index)]
                           .quat_WB.toRotationMatrix()
                           .transpose();
  Collector collector(body.modes);
  if (body.P.cols() > 0) {
    collector.add({{start.t}, body.P.transpose() * (R_BW * model.gravity_W)});
  }
  for (const Load& load : model.loads) {
    const Attachment& attachment = get_attachment(model, load.where);
    if (attachment.body != index) continue;
    const Matrix3 R = load.in_world ? R_BW : Matrix3(Matrix3::Identity());
    collector.add(load.function,
                  attachment.Phi_B.transpose() * (R * load.force) +
                      attachment.Psi_B.transpose() * (R * load.moment));
  }
  for (const BodyLoad& load : model.body_loads) {
    if (load.body != index) continue;
    collector.add({load.history.times, load.history.modal});
  }
  return collector.join();
}

}  // namespace limber::dynamics
