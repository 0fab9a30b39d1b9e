// SPDX-License-Identifier: BSD-3-Clause
// What every coupler and transmission owes to the bodies that it joins.
#include <gtest/gtest.h>

#include <random>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "support/draw_vector.hpp"
#include "support/linked_bodies.hpp"

namespace limber::dynamics::coupler_contract_test {
namespace {

using testing::Link;
using testing::LinkedBodies;
using testing::make_all_links;
using testing::make_linked_bodies;

constexpr int kLinkCount = 16;
constexpr double kGradient = 1e-8;
constexpr double kRoundoff = 1e-12;

// Which link, which bodies are flexible.
using Case = std::tuple<int, std::array<bool, 3>>;

class CouplerContract : public ::testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] static LinkedBodies make(unsigned seed, double damping,
                                         double speed) {
    const auto links = make_all_links(damping);
    const auto i = static_cast<std::size_t>(std::get<0>(GetParam()));
    return make_linked_bodies(links.at(i), std::get<1>(GetParam()), seed,
                              speed);
  }
};

// Of all that moves, per unit of a parameter.
struct Direction {
  std::vector<Vector3> p, theta_B;
  VectorX eta;
};

SystemState move(const SystemState& from, const Direction& d, double h) {
  SystemState to = from;
  for (std::size_t b = 0; b < to.bodies.size(); ++b) {
    to.bodies[b].p_WB += h * d.p[b];
    to.bodies[b].quat_WB =
        to.bodies[b].quat_WB * exp_quaternion(h * d.theta_B[b]);
  }
  to.eta += h * d.eta;
  return to;
}

SystemTerms evaluate_forces(const LinkedBodies& linked) {
  SystemTerms terms = make_terms(linked.model);
  calc_terms(linked.model, linked.state, Side::right, terms);
  return terms;
}

// Power of the couplers' forces along a direction of motion.
double find_power(const LinkedBodies& linked, const SystemTerms& terms,
                  const Direction& d) {
  double power = 0.0;
  for (std::size_t b = 0; b < terms.bodies.size(); ++b) {
    const BodyModel& body = linked.model.bodies[b];
    power += terms.bodies[b].force_W.dot(d.p[b]);
    // The modes turn and shift with the body; theta is about its own origin.
    power += terms.bodies[b].moment_B.dot(d.theta_B[b]);
    power +=
        terms.bodies[b].modal_force.dot(d.eta.segment(body.offset, body.modes));
  }
  return power;
}

Direction random_direction(const LinkedBodies& linked, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    return testing::draw_vector([&] { return uniform(random); });
  };
  Direction d;
  for (std::size_t b = 0; b < linked.model.bodies.size(); ++b) {
    d.p.push_back(vector());
    d.theta_B.push_back(vector());
  }
  d.eta = VectorX::Zero(linked.model.modal_count);
  for (double& x : d.eta) x = uniform(random);
  return d;
}

TEST_P(CouplerContract, ForcesAreTheNegativeGradientOfTheEnergy) {
  double largest = 0.0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const LinkedBodies linked = make(seed, 0.0, 0.0);
    const SystemTerms terms = evaluate_forces(linked);
    const Direction d = random_direction(linked, seed + 100);
    // Richardson's extrapolation of central differences.
    const auto slope = [&](double h) {
      return (calc_energy(linked.model, move(linked.state, d, h)).coupler -
              calc_energy(linked.model, move(linked.state, d, -h)).coupler) /
             (2.0 * h);
    };
    const double h = 2e-4;  // short, so that no kink lies within
    const double gradient = (4.0 * slope(0.5 * h) - slope(h)) / 3.0;
    const double scale =
        calc_energy(linked.model, linked.state).coupler + std::abs(gradient);
    EXPECT_NEAR(find_power(linked, terms, d), -gradient, kGradient * scale)
        << seed;
    largest = std::max(largest, std::abs(gradient));
  }
  EXPECT_GT(largest, 0.1);
}

TEST_P(CouplerContract, NoNetForceOrMomentActsOnTheBodies) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const LinkedBodies linked = make(seed, 2.0, 1.0);
    const SystemTerms terms = evaluate_forces(linked);
    Vector3 force = Vector3::Zero();
    Vector3 moment = Vector3::Zero();
    double size = 0.0;
    for (std::size_t b = 0; b < terms.bodies.size(); ++b) {
      const BodyTerms& t = terms.bodies[b];
      force += t.force_W;
      const Vector3 about_origin =
          t.R_WB * t.moment_B + linked.state.bodies[b].p_WB.cross(t.force_W);
      moment += about_origin;
      size += t.force_W.norm() + about_origin.norm();
    }
    EXPECT_LT(force.norm(), kRoundoff * size) << seed;
    EXPECT_LT(moment.norm(), kRoundoff * size) << seed;
    EXPECT_GT(size, 1e-3) << seed;
  }
}

TEST_P(CouplerContract, WhatIsTakenFromTheMotionIsStoredOrDissipated) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const LinkedBodies linked = make(seed, 2.0, 1.0);
    const SystemTerms terms = evaluate_forces(linked);
    Direction d;
    for (const BodyState& b : linked.state.bodies) {
      d.p.push_back(b.v_WB_W);
      d.theta_B.push_back(b.w_WB_B);
    }
    d.eta = linked.state.etadot;
    const auto slope = [&](double h) {
      return (calc_energy(linked.model, move(linked.state, d, h)).coupler -
              calc_energy(linked.model, move(linked.state, d, -h)).coupler) /
             (2.0 * h);
    };
    const double h = 2e-4;
    const double stored = (4.0 * slope(0.5 * h) - slope(h)) / 3.0;
    EnergyFlows powers = make_flows(linked.model);
    add_powers(terms, 1.0, powers);
    const double dissipated = powers.dissipated.sum();
    const double scale = std::abs(stored) + dissipated +
                         calc_energy(linked.model, linked.state).coupler;
    EXPECT_NEAR(find_power(linked, terms, d),
                powers.supplied.sum() - stored - dissipated, kGradient * scale)
        << seed;
    EXPECT_GE(dissipated, 0.0);
  }
}

TEST(AllLinks, AreInTheContract) {
  EXPECT_EQ(make_all_links(0.0).size(), kLinkCount);
}

INSTANTIATE_TEST_SUITE_P(
    All, CouplerContract,
    ::testing::Combine(::testing::Range(0, kLinkCount),
                       ::testing::Values(std::array{false, false, false},
                                         std::array{true, false, true},
                                         std::array{true, true, true})),
    [](const auto& param) {
      const auto i = static_cast<std::size_t>(std::get<0>(param.param));
      std::string name = make_all_links(0.0).at(i).name + "_";
      for (const bool flexible : std::get<1>(param.param)) {
        name += flexible ? 'f' : 'r';
      }
      return name;
    });

}  // namespace
}  // namespace limber::dynamics::coupler_contract_test
