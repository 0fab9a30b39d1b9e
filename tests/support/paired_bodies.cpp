// SPDX-License-Identifier: BSD-3-Clause
#include "support/paired_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "limber/joints/pairs/point_springs.hpp"
#include "support/point_mass_body.hpp"

namespace limber::testing {
namespace {

using dynamics::AttachmentIndex;
using dynamics::BodyIndex;
using dynamics::kWorld;

constexpr int kNodes = 24;
constexpr int kModes = 8;

// Of all modes but the first, up to `size`.
flexbody::QuadraticManifold make_manifold(double size) {
  flexbody::QuadraticManifold manifold;
  for (int k = 1; k < kModes; ++k) manifold.paired.push_back(k);
  const auto pairs = flexbody::count_pairs(std::ssize(manifold.paired));
  const auto made_up = [&](Eigen::Index rows, double phase) {
    return MatrixX::NullaryExpr(
        rows, pairs, [phase, size](Eigen::Index i, Eigen::Index j) {
          return size * std::sin(phase + 1.3 * static_cast<double>(i) +
                                 2.1 * static_cast<double>(j));
        });
  };
  manifold.Q = 3.0 * made_up(kModes - 1, 0.1);
  manifold.Theta_B = made_up(3 * kNodes, 0.7);
  manifold.S2 = made_up(6, 1.9);
  return manifold;
}

// Of the mean of three nodes.
void bend(const flexbody::QuadraticManifold& manifold, int first,
          flexbody::InterfaceTable& table) {
  table.Phi2_B = Matrix3X::Zero(3, manifold.Theta_B.cols());
  table.Psi2_B = table.Phi2_B;
  for (int n = first; n < first + 3; ++n) {
    table.Phi2_B += manifold.Theta_B.middleRows<3>(3 * n) / 3.0;
  }
}

class Builder {
 public:
  explicit Builder(const PairedBodiesOptions& options) : options_(options) {}

  BodyIndex add_body(const char* name, double mass, unsigned seed) {
    bodies_.push_back(
        make_point_mass_body(kNodes, kModes, mass, 0.6, 80.0, seed));
    if (options_.is_bent) bodies_.back().reduced.manifold = make_manifold(0.5);
    return builder.add_flexible_body(
        name, share(bodies_.back()),
        options_.is_bent       ? dynamics::Fidelity::nonlinear
        : options_.is_flexible ? dynamics::Fidelity::coupled
                               : dynamics::Fidelity::rigid,
        {});
  }

  void join(const std::string& name, BodyIndex A, BodyIndex B, int count) {
    std::vector<joints::PointSprings::Line> lines;
    for (int i = 0; i < count; ++i) {
      const joints::PointSpring spring({.stiffness = options_.stiffness,
                                        .damping = options_.damping,
                                        .free_length = 0.5 + 0.01 * i});
      const AttachmentIndex a = attach(A, i);
      const AttachmentIndex b = attach(B, i + 3);
      if (!options_.by_pairs) {
        builder.add_coupler(fmt::format("{} {}", name, i), spring, a, b);
        continue;
      }
      lines.push_back({builder.find_place(a), builder.find_place(b), spring});
    }
    if (!options_.by_pairs) return;
    builder.add_pair(name, A, B,
                     std::make_shared<joints::PointSprings>(std::move(lines)));
  }

  dynamics::SystemBuilder builder;

 private:
  AttachmentIndex attach(BodyIndex body, int i) {
    if (body == kWorld) {
      return builder.attach_world(
          "w", {Matrix3::Identity(), Vector3(0.1 * i, -0.8, 0.2)});
    }
    const int first = (5 * i) % (kNodes - 3);
    const PointMassBody& masses = bodies_[static_cast<std::size_t>(body)];
    flexbody::InterfaceTable table = make_interface(masses, first, first + 3);
    if (options_.is_bent) bend(*masses.reduced.manifold, first, table);
    return builder.attach_interface("p", body, table,
                                    {Matrix3::Identity(), table.p_B});
  }

  PairedBodiesOptions options_;
  std::vector<PointMassBody> bodies_;
};

}  // namespace

PairedBodies make_paired_bodies(const PairedBodiesOptions& options) {
  Builder builder(options);
  const BodyIndex A = builder.add_body("A", 2.0, 1);
  const BodyIndex B = builder.add_body("B", 3.0, 2);
  const BodyIndex C = builder.add_body("C", 1.0, 3);
  builder.join("AB", A, B, options.lines);
  builder.join("BC", B, C, std::max(1, options.lines / 2));
  builder.join("ground", kWorld, A, 3);
  builder.builder.set_gravity({0.0, 0.0, -9.81});
  PairedBodies out{builder.builder.build(), {}};
  out.state = dynamics::make_state(out.model);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&] {
    const double x = uniform(random);
    const double y = uniform(random);
    return Vector3(x, y, uniform(random));
  };
  for (std::size_t b = 0; b < out.state.bodies.size(); ++b) {
    dynamics::BodyState& body = out.state.bodies[b];
    body.p_WB = Vector3(0.1, 0.8 * static_cast<double>(b), 0.0);
    body.quat_WB = Quaternion(1.0, 0.3, -0.2, 0.1).normalized();
    body.w_WB_B = options.spin * draw();
    body.v_WB_W = 0.2 * options.spin * draw();
  }
  for (double& rate : out.state.etadot) {
    rate = 0.05 * options.spin * uniform(random);
  }
  return out;
}

void SphereContact::describe_parameters(Manifest& out) const {
  out.add("stiffness [N/m]", stiffness_);
  out.add("radius of A [m]", radius_A_);
  out.add("radius of B [m]", radius_B_);
}

SphereContact::Gap SphereContact::find_gap(
    const joints::PairBodies& bodies) const {
  if (radius_A_ == 0.0) {
    return {bodies.B.p_WB.z() - radius_B_, Vector3::UnitZ(),
            std::numeric_limits<double>::infinity()};
  }
  const Vector3 line = bodies.B.p_WB - bodies.A.p_WB;
  const double distance = line.norm();
  return {distance - radius_A_ - radius_B_, line / distance, distance};
}

// On the line of the centres, so that no moment is left.
void SphereContact::add_point(const joints::PairBodies& bodies, const Gap& gap,
                              double force, double stiffness,
                              joints::PairResponse& out) const {
  joints::PairPoint& point = out.add();
  const Vector3 p_W = bodies.B.p_WB - radius_B_ * gap.normal_W;
  const auto place = [&](const joints::PairBody& body) {
    return Vector3(body.R_WB.transpose() * (p_W - body.p_WB));
  };
  point.on_A.x_B = place(bodies.A);
  point.on_B.x_B = place(bodies.B);
  point.force_W = force * gap.normal_W;
  const Matrix3 along = gap.normal_W * gap.normal_W.transpose();
  point.stiffness = stiffness * along;
}

void SphereContact::evaluate(const joints::PairBodies& bodies,
                             const EvaluationTime& /*now*/,
                             std::span<const double> /*memory*/,
                             joints::PairResponse& out) const {
  const Gap gap = find_gap(bodies);
  if (gap.value >= 0.0) return;
  out.energy = 0.5 * stiffness_ * gap.value * gap.value;
  add_point(bodies, gap, -stiffness_ * gap.value, stiffness_, out);
}

void SphereContact::evaluate_over_step(const joints::PairStep& step,
                                       std::span<const double> /*memory*/,
                                       joints::PairResponse& out) const {
  const Gap first = find_gap(step.begin);
  const Gap last = find_gap(step.end);
  const auto energy = [&](double gap) {
    const double depth = std::max(0.0, -gap);
    return 0.5 * stiffness_ * depth * depth;
  };
  if (first.value >= 0.0 && last.value >= 0.0) return;
  const double change = last.value - first.value;
  const double force =
      change == 0.0 ? stiffness_ * std::max(0.0, -last.value)
                    : -(energy(last.value) - energy(first.value)) / change;
  Gap mean = find_gap(step.middle);
  add_point(step.middle, mean, force, stiffness_, out);
}

}  // namespace limber::testing
