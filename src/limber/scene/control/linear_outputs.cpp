// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/linear_outputs.hpp"

#include <algorithm>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"
#include "limber/scene/control/coupler_rows.hpp"
#include "limber/scene/control/vector_rows.hpp"

namespace limber::scene {
namespace {

using Index = Eigen::Index;
using dynamics::AttachmentIndex;

const char* const kNotSmooth =
    "contact forces begin and end, and have no derivative";

dynamics::Attachment attach(const PointProbe& point,
                            const dynamics::SystemModel& model,
                            const Matrix3& R_BF) {
  dynamics::Attachment frame;
  frame.body = point.body;
  frame.p_BF = point.p_B;
  frame.R_BF = R_BF;
  const int modes = point.body == dynamics::kWorld
                        ? 0
                        : model.bodies[index(point.body)].modes;
  const bool follows = point.Phi_B.cols() == modes;
  frame.Phi_B = follows ? point.Phi_B : Matrix3X::Zero(3, modes);
  frame.Psi_B = follows ? point.Psi_B : Matrix3X::Zero(3, modes);
  frame.second = point.second;
  return frame;
}

class Outputs {
 public:
  Outputs(const ObservedModel& observed, const dynamics::SystemState& state,
          const dynamics::LinearSystem& system)
      : observed_(observed), state_(state), system_(system) {}

  std::vector<LinearOutput> find(const Probe& probe, int first_frame) {
    rows_ = {};
    why_none_.clear();
    std::visit(Overloaded{[&](const PointProbe& of) { add(of, first_frame); },
                          [&](const CouplerProbe& of) { add(of, first_frame); },
                          [&](const auto& of) { add(of); }},
               probe.of);
    return finish(probe);
  }

 private:
  [[nodiscard]] Index states() const { return system_.A.rows(); }

  void take(MatrixX by_state) {
    rows_.by_input = MatrixX::Zero(by_state.rows(), system_.B.cols());
    rows_.by_state = std::move(by_state);
  }

  [[nodiscard]] MotionRows find_frame(int frame) const {
    const Index row = 6 * Index{frame};
    return {system_.frames.middleRows<3>(row),
            system_.frames.middleRows<3>(row + 3),
            system_.frame_velocities.middleRows<3>(row),
            system_.frame_velocities.middleRows<3>(row + 3)};
  }

  [[nodiscard]] dynamics::FrameMotion find_motion(int frame) const {
    return dynamics::find_frame_motion(observed_.model, state_,
                                       observed_.frames[index(frame)]);
  }

  void add(const PointProbe& probe, int frame) {
    if (probe.quantity == Quantity::deformation) {
      take(find_deformation(probe));
      return;
    }
    const MotionRows rows = relate(find_frame(frame), find_frame(frame + 1),
                                   find_motion(frame), find_motion(frame + 1));
    switch (probe.quantity) {
      case Quantity::displacement:
      case Quantity::position:
        take(rows.p);
        break;
      case Quantity::velocity:
        take(rows.v);
        break;
      case Quantity::angular_velocity:
        take(rows.w);
        break;
      case Quantity::rotation: {
        const Matrix3 R = find_motion(frame).X_WF.R.transpose() *
                          find_motion(frame + 1).X_WF.R;
        take(log_rows(R * probe.R_start.transpose(), rows.phi));
        break;
      }
      case Quantity::deformation:
        break;
    }
  }

  [[nodiscard]] MatrixX find_deformation(const PointProbe& probe) const {
    MatrixX rows = MatrixX::Zero(3, states());
    if (probe.body == dynamics::kWorld) return rows;
    const dynamics::BodyModel& body = observed_.model.bodies[index(probe.body)];
    if (body.modes == 0 || probe.Phi_B.cols() != body.modes) return rows;
    Matrix3X Phi = probe.Phi_B;
    Matrix3X Psi = probe.Psi_B;
    if (probe.second) {
      flexbody::add_slopes(*probe.second, state_.eta.data() + body.offset, Phi,
                           Psi);
    }
    rows = probe.R_BL.transpose() * Phi *
           system_.modes.middleRows(body.offset, body.modes);
    return rows;
  }

  void add(const CouplerProbe& probe, int frame) {
    if (probe.spec.quantity >= CouplerQuantity::energy) {
      why_none_ =
          "energies and powers are quadratic in small motion, not linear";
      return;
    }
    const CouplerRows found = find_coupler_rows(
        probe, observed_.model, state_, system_,
        frame < 0 ? Matrix3X::Zero(3, states()) : find_frame(frame).phi);
    rows_ = {found.by_state, found.by_input};
    why_none_ = found.why_none;
  }

  void add(const StressProbe& probe) {
    const bool is_linear = probe.quantity == StressQuantity::stress ||
                           probe.quantity == StressQuantity::section_force;
    if (!is_linear || probe.tags.size() != 1) {
      why_none_ =
          "of stress only the six components at one node are linear: quantity "
          "'stress' of a probe at a node, of shells with a 'layer', or "
          "'section_force' of one 'element'";
      return;
    }
    const dynamics::BodyModel& body = observed_.model.bodies[index(probe.body)];
    const auto stressed =
        system_.stressed_modes.middleRows(body.offset, body.modes);
    const auto modes = system_.modes.middleRows(body.offset, body.modes);
    const MatrixX Sigma_L = probe.Sigma_L.leftCols(body.modes);
    take(body.maxwell.scale *
         (Sigma_L * stressed + (find_slopes(probe, body) - Sigma_L) * modes));
  }

  // Derivative of the stress by the modes, at this state, without internal
  // damping.
  [[nodiscard]] MatrixX find_slopes(const StressProbe& probe,
                                    const dynamics::BodyModel& body) const {
    MatrixX slopes = probe.Sigma_L.leftCols(body.modes);
    const double* eta = state_.eta.data() + body.offset;
    const auto add_product = [&](Index pair, int i, int j, bool is_square) {
      const auto column = probe.Sigma_L.col(body.modes + pair);
      slopes.col(i) += eta[j] * column;
      if (!is_square) slopes.col(j) += eta[i] * column;
    };
    flexbody::for_each_product(dynamics::paired_of(body), add_product);
    return slopes;
  }

  void add(const ControllerProbe& probe) {
    take(MatrixX::Zero(1, states()));
    for (std::size_t i = 0; i < system_.inputs.size(); ++i) {
      if (system_.inputs[i].written != probe.input) continue;
      rows_.by_input(0, static_cast<Index>(i)) = 1.0;
    }
  }

  void add(const ContactProbe& /*probe*/) { why_none_ = kNotSmooth; }

  [[nodiscard]] std::vector<LinearOutput> finish(const Probe& probe) const {
    std::vector<LinearOutput> outputs;
    std::vector<double> values;
    if (why_none_.empty()) {
      values = evaluate_all({probe}, observed_.model, state_);
    }
    for (const ProbeColumnName& column : column_names(probe)) {
      LinearOutput output;
      output.signal = {column.name, column.unit, 0.0};
      output.why_none = why_none_;
      if (why_none_.empty()) {
        const auto row = std::ssize(outputs);
        output.signal.value = values[outputs.size()];
        output.by_state = rows_.by_state.row(row);
        output.by_input = rows_.by_input.row(row);
      }
      outputs.push_back(std::move(output));
    }
    return outputs;
  }

  struct Rows {
    MatrixX by_state;
    MatrixX by_input;
  };

  const ObservedModel& observed_;
  const dynamics::SystemState& state_;
  const dynamics::LinearSystem& system_;
  Rows rows_;
  std::string why_none_;
};

bool is_requested(const Probe& probe) {
  const auto* stress = std::get_if<StressProbe>(&probe.of);
  return stress == nullptr || !stress->is_of_link;
}

}  // namespace

ObservedModel observe(const dynamics::SystemModel& model,
                      const std::vector<Probe>& probes) {
  ObservedModel observed{model, {}, {}};
  const auto add = [&](dynamics::Attachment frame) {
    observed.frames.emplace_back(
        static_cast<int>(observed.model.attachments.size()));
    observed.model.attachments.push_back(std::move(frame));
  };
  for (const Probe& probe : probes) {
    observed.first_frame.push_back(-1);
    const auto first = static_cast<int>(observed.frames.size());
    if (const auto* point = std::get_if<PointProbe>(&probe.of)) {
      if (point->quantity == Quantity::deformation) continue;
      add(point->base ? attach(*point->base, model, point->base->R_BL)
                      : dynamics::Attachment{});
      add(attach(*point, model, Matrix3::Identity()));
      observed.first_frame.back() = first;
    } else if (const auto* of = std::get_if<CouplerProbe>(&probe.of);
               of != nullptr && of->coupler >= 0) {
      observed.frames.push_back(model.couplers[index(of->coupler)].frame_F);
      observed.first_frame.back() = first;
    }
  }
  return observed;
}

std::vector<LinearOutput> find_linear_outputs(
    const std::vector<Probe>& probes, const ObservedModel& observed,
    const dynamics::SystemState& state, const dynamics::LinearSystem& system) {
  std::vector<LinearOutput> outputs;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!is_requested(probes[i])) continue;
    Outputs of(observed, state, system);
    for (LinearOutput& output : of.find(probes[i], observed.first_frame[i])) {
      outputs.push_back(std::move(output));
    }
  }
  return outputs;
}

}  // namespace limber::scene
