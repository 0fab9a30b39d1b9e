// SPDX-License-Identifier: BSD-3-Clause
// Inputs and outputs of linear models against differences of what the system
// and its probes do.
#include "limber/scene/control/linear_outputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <tuple>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/steady_linearisation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "support/elastic_kinds.hpp"
#include "support/linked_bodies.hpp"

namespace limber::scene::linear_outputs_test {
namespace {

using dynamics::LinearSystem;
using dynamics::SystemModel;
using dynamics::SystemState;
using Index = Eigen::Index;

/// The state moved by a fraction h of x and x' of SmallMotion.
SystemState move(const SystemModel& model, const SystemState& state,
                 const dynamics::SteadyMotion& steady, const VectorX& x,
                 const VectorX& rate, double h) {
  SystemState moved = state;
  const Vector3& w = steady.axes.w_W;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const dynamics::BodyModel& body = model.bodies[b];
    const Index m = steady.motion.modes[b];
    moved.eta.segment(body.offset, body.modes) += h * x.segment(m, body.modes);
    moved.etadot.segment(body.offset, body.modes) +=
        h * rate.segment(m, body.modes);
    const Index p = steady.motion.places[b];
    if (p < 0) continue;
    dynamics::BodyState& at = moved.bodies[b];
    const Quaternion q_BW = at.quat_WB.conjugate();
    const Vector3 place = x.segment<3>(p);
    const Vector3 turn = x.segment<3>(p + 3);
    at.p_WB += h * place;
    at.v_WB_W += h * (rate.segment<3>(p) + w.cross(place));
    at.w_WB_B += h * (q_BW * (rate.segment<3>(p + 3) + w.cross(turn)));
    at.quat_WB = at.quat_WB * exp_quaternion(h * (q_BW * turn));
  }
  return moved;
}

Probe probe_point(Quantity quantity, const SystemModel& model, int body,
                  std::shared_ptr<const PointProbe> base) {
  PointProbe point;
  point.quantity = quantity;
  point.body = dynamics::BodyIndex(body);
  point.p_B = Vector3(0.3, -0.2, 0.5);
  const int modes = model.bodies[static_cast<std::size_t>(body)].modes;
  point.Phi_B = 0.3 * Matrix3X::NullaryExpr(3, modes, [](Index i, Index j) {
                  return std::sin(1.0 + 3.0 * double(i) + 7.0 * double(j));
                });
  point.Psi_B = 0.4 * Matrix3X::NullaryExpr(3, modes, [](Index i, Index j) {
                  return std::cos(2.0 + 5.0 * double(i) - 3.0 * double(j));
                });
  point.R_BL = exp_rotation(Vector3(0.2, 0.4, -0.3));
  point.base = std::move(base);
  return {"point", point};
}

std::vector<Probe> make_point_probes(const SystemModel& model,
                                     const SystemState& state) {
  const Probe base = probe_point(Quantity::position, model, 1, nullptr);
  std::vector<Probe> probes;
  for (const bool is_relative : {false, true}) {
    for (const Quantity quantity :
         {Quantity::displacement, Quantity::position, Quantity::velocity,
          Quantity::rotation, Quantity::angular_velocity,
          Quantity::deformation}) {
      for (const int body : {0, 2}) {
        probes.push_back(probe_point(
            quantity, model, body,
            is_relative && quantity != Quantity::deformation
                ? std::make_shared<PointProbe>(std::get<PointProbe>(base.of))
                : nullptr));
        set_start(probes.back(), model, state);
        // Turned since the start.
        std::get<PointProbe>(probes.back().of).R_start =
            exp_rotation(Vector3(0.5, -0.3, 0.4)) *
            std::get<PointProbe>(probes.back().of).R_start;
      }
    }
  }
  StressProbe stress;
  stress.quantity = StressQuantity::stress;
  stress.body = dynamics::BodyIndex(2);
  stress.tags = {1};
  stress.p_L = Matrix3X::Zero(3, 1);
  const int columns = count_coordinates(model.bodies[2]);
  stress.Sigma_L = MatrixX::NullaryExpr(6, columns, [](Index i, Index j) {
    return std::sin(4.0 + 2.0 * double(i) + 3.0 * double(j));
  });
  stress.clusters = StressClusters(stress.p_L, stress.Sigma_L);
  probes.push_back({"stress", stress});
  return probes;
}

/// Every quantity that a coupler has.
std::vector<Probe> make_coupler_probes(const SystemModel& model) {
  std::vector<std::string> names;
  for (const auto& c : model.couplers) names.push_back(c.name);
  for (const auto& t : model.transmissions) names.push_back(t.name);
  std::vector<Probe> probes;
  for (const std::string& name : names) {
    for (int q = 0; q <= static_cast<int>(CouplerQuantity::moment); ++q) {
      for (const ProbeSide side : {ProbeSide::F, ProbeSide::M}) {
        for (const ProbeAxes axes :
             {ProbeAxes::F, ProbeAxes::M, ProbeAxes::world}) {
          const auto quantity = static_cast<CouplerQuantity>(q);
          const bool is_plain = side == ProbeSide::M && axes == ProbeAxes::F;
          if (!is_plain && !is_vector(quantity)) continue;
          if (side == ProbeSide::F && !has_side(quantity)) continue;
          try {
            probes.push_back({name, make_coupler_probe(
                                        {name, quantity, side, axes}, model)});
          } catch (const InputError&) {
            // It does not have that.
          }
        }
      }
    }
  }
  return probes;
}

// By the kind of link and whether the bodies are at level nonlinear.
class OfLinkedBodies
    : public ::testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  OfLinkedBodies()
      : linked_(make_linked_bodies(
            testing::make_all_links(2.0)[std::get<0>(GetParam())],
            {true, false, true}, 5, 1.0)) {
    if (!std::get<1>(GetParam())) return;
    testing::bend(linked_.model, 0.2);
    // Products of modes, of which stress has a part.
    flexbody::ReducedBody reduced;
    reduced.manifold.emplace();
    reduced.manifold->paired = {0, 1};
    linked_.model.bodies[2].reduced =
        std::make_shared<const flexbody::ReducedBody>(reduced);
  }
  testing::LinkedBodies linked_;
};

TEST_P(OfLinkedBodies, OutputsAreDifferencesOfTheProbes) {
  constexpr double kStep = 1e-5;
  constexpr double kSame = 2e-8;  // a difference's own error
  const SystemModel& model = linked_.model;
  const SystemState& state = linked_.state;
  std::vector<Probe> probes = make_point_probes(model, state);
  for (Probe& probe : make_coupler_probes(model)) probes.push_back(probe);
  const ObservedModel observed = observe(model, probes);
  const LinearSystem system =
      dynamics::linearise(observed.model, state, observed.frames);
  const std::vector<LinearOutput> outputs =
      find_linear_outputs(probes, observed, state, system);
  const dynamics::SteadyMotion steady =
      dynamics::linearise_steadily(model, state);
  const MatrixX& Q = steady.basis.Q;
  const Index n = Q.cols();
  const VectorX scale = system.A.topRightCorner(n, n).diagonal();
  const VectorX z = VectorX::LinSpaced(2 * n, -1.0, 1.3).array().sin();
  const VectorX x = Q * z.head(n).cwiseQuotient(scale);
  const VectorX rate = Q * z.tail(n);
  const auto evaluate = [&](double h) {
    return evaluate_all(probes, model, move(model, state, steady, x, rate, h));
  };
  const std::vector<double> plus = evaluate(kStep);
  const std::vector<double> minus = evaluate(-kStep);
  ASSERT_EQ(outputs.size(), plus.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    ASSERT_EQ(outputs[i].why_none, "") << outputs[i].signal.name;
    const double slope = (plus[i] - minus[i]) / (2.0 * kStep);
    EXPECT_NEAR(outputs[i].by_state.dot(z), slope,
                kSame * (1.0 + std::abs(slope)))
        << i << " " << outputs[i].signal.name;
    largest = std::max(largest, std::abs(slope));
  }
  EXPECT_GT(largest, 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, OfLinkedBodies,
    ::testing::Combine(::testing::Range(std::size_t{0},
                                        testing::make_all_links(2.0).size()),
                       ::testing::Bool()));

}  // namespace
}  // namespace limber::scene::linear_outputs_test
