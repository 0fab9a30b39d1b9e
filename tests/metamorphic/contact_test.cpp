// SPDX-License-Identifier: BSD-3-Clause
// A strike of two bodies does not depend on place, velocity, units, names,
// sides or company, and keeps energy and momentum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "limber/common/rotation.hpp"
#include "metamorphic/contact_relations.hpp"
#include "metamorphic/scene_count.hpp"

namespace limber::metamorphic::contact_test {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr int kDisturbed = 2;
/// Parts of a step that an impact is divided into, about.
constexpr double kPartsOfAStep = 20.0;
/// Two runs each have an error of the steps, of order 2.
constexpr double kStepErrors = 4.0;
/// Beyond this part of its speed a comparison shows nothing.
constexpr double kMeaningful = 1e-2;

/// Largest difference of velocities, and of angular ones times the arm [m/s].
double compare(const ContactPlan& plan, const Strike& first,
               const Strike& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const StrikingBody& body = plan.bodies[i];
    if (body.is_world()) continue;
    const double arm = std::sqrt(body.inertia_B.maxCoeff() / body.mass);
    const Strike::Body& a = first.bodies[i];
    const Strike::Body& b = other.bodies[i];
    const double T = plan.settings.end_time;
    most = std::max({most, (a.v_WB_W - b.v_WB_W).norm(),
                     arm * (a.w_WB_B - b.w_WB_B).norm(),
                     (a.X_WB.p - b.X_WB.p).norm() / T,
                     arm * (a.X_WB.R - b.X_WB.R).norm() / T});
  }
  return most;
}

double find_speed(const ContactPlan& plan) {
  double speed = 0.0;
  for (const StrikingBody& body : plan.bodies) {
    if (body.is_world()) continue;
    const double arm = std::sqrt(body.inertia_B.maxCoeff() / body.mass);
    speed = std::max(speed, body.v_WB_W.norm() + arm * body.w_WB_B.norm());
  }
  return speed;
}

double find_extent(const ContactPlan& plan) {
  double extent = 0.0;
  for (const StrikingBody& body : plan.bodies) {
    if (body.is_world()) continue;
    extent =
        std::max(extent, body.X_WB.p.norm() +
                             std::sqrt(body.inertia_B.maxCoeff() / body.mass));
  }
  return extent;
}

/// What round-off of places and speeds like the changed ones does [m/s].
double find_noise(const ContactPlan& plan, const Strike& first, double place,
                  double speed, RandomDraw& draw) {
  double most = 0.0;
  for (int i = 0; i < kDisturbed; ++i) {
    ContactPlan other = plan;
    for (StrikingBody& body : other.bodies) {
      if (body.is_world()) continue;
      body.X_WB.p += kEps * place * draw.direction();
      body.X_WB.R = body.X_WB.R * exp_rotation(kEps * draw.vector());
      body.v_WB_W += kEps * speed * draw.direction();
      body.w_WB_B += kEps * body.w_WB_B.norm() * draw.direction();
    }
    const Strike strike = run(other);
    if (strike.refusal.empty()) {
      most = std::max(most, compare(plan, first, strike));
    }
  }
  return most;
}

Strike run_finer(ContactPlan plan, double factor) {
  plan.settings.step /= factor;
  plan.settings.impact_steps *= factor;
  return run(plan);
}

double find_step_error(const ContactPlan& plan, const Strike& first) {
  return kStepErrors * compare(plan, first, run_finer(plan, 2.0));
}

struct Counts {
  int compared = 0;
  int refused = 0;
  int other_steps = 0;
  int sensitive = 0;
  double largest_bound = 0.0;  // where steps are the same [-]
};

class MetamorphicContact : public ::testing::TestWithParam<ContactRelation> {
 protected:
  void check(unsigned seed) {
    const ContactPlan plan = draw_contact(seed);
    SCOPED_TRACE(GetParam().name + ", " + plan.description);
    RandomDraw draw(seed + 1'000'000U);
    const auto changed = GetParam().change(plan, draw);
    if (!changed) return;
    const Strike first = run(plan);
    Strike other = run(changed->plan);
    if (!first.refusal.empty() || !other.refusal.empty()) {
      EXPECT_EQ(first.refusal.empty(), other.refusal.empty())
          << "first: " << first.refusal << "\nchanged: " << other.refusal;
      ++counts_.refused;
      return;
    }
    for (Strike::Body& body : other.bodies) changed->undo(body);
    const double place = find_extent(plan) + changed->place;
    const double speed = find_speed(plan) + changed->speed;
    const double noise = find_noise(plan, first, place, speed, draw);
    const double steps = kPartsOfAStep * static_cast<double>(first.steps + 1);
    double bound =
        steps * (noise + kEps * (speed + place / plan.settings.end_time));
    const double found = compare(plan, first, other);
    if (found > bound) {
      ++counts_.other_steps;
      bound += find_step_error(plan, first);
    } else {
      counts_.largest_bound =
          std::max(counts_.largest_bound, bound / find_speed(plan));
    }
    if (bound > kMeaningful * find_speed(plan)) {
      ++counts_.sensitive;
      return;
    }
    ++counts_.compared;
    EXPECT_LE(found, bound) << "[m/s] of " << find_speed(plan);
  }

  Counts counts_;
};

TEST_P(MetamorphicContact, StrikesAsBefore) {
  const unsigned scenes = count_scenes();
  for (unsigned seed = 0; seed < scenes; ++seed) check(seed);
  fmt::print(
      "{}: {} strikes compared, {} of them within the error of the steps, {} "
      "refused, {} too sensitive; the others within {:.2g} at most\n",
      GetParam().name, counts_.compared, counts_.other_steps, counts_.refused,
      counts_.sensitive, counts_.largest_bound);
  EXPECT_GE(2 * counts_.compared, static_cast<int>(scenes / 2));
}

std::string name_of(const ::testing::TestParamInfo<ContactRelation>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Of, MetamorphicContact,
                         ::testing::ValuesIn(contact_relations()), name_of);

/// Of the energy-conserving scheme.
class StrikeOf : public ::testing::Test {
 protected:
  static ContactPlan draw(unsigned seed) {
    ContactPlan plan = draw_contact(seed);
    plan.settings.integrator = dynamics::IntegratorKind::energy_conserving;
    return plan;
  }
};

// Friction of two smooth shapes is that of the middle of a step, and right to
// the second order in it.
bool has_friction_of_a_point(const ContactPlan& plan) {
  const auto is_smooth = [](const StrikingBody& body) {
    return std::holds_alternative<contact::Sphere>(body.shape.kind) ||
           std::holds_alternative<contact::Capsule>(body.shape.kind) ||
           std::holds_alternative<contact::Ellipsoid>(body.shape.kind);
  };
  return plan.parameters.friction.sliding > 0.0 && is_smooth(plan.bodies[0]) &&
         (is_smooth(plan.bodies[1]) || plan.bodies[1].is_world());
}

TEST_F(StrikeOf, RandomBodiesGainsNoEnergy) {
  constexpr double kMostGain = 1e-6;         // of what the impact has [-]
  constexpr double kMostGainOfPoint = 1e-3;  // [-]
  int impacts = 0;
  int refused = 0;
  double worst[2] = {};
  for (unsigned seed = 0; seed < count_scenes(); ++seed) {
    const ContactPlan plan = draw(seed);
    const Strike strike = run(plan);
    SCOPED_TRACE(plan.description + " " + strike.refusal);
    refused += strike.refusal.empty() ? 0 : 1;
    const bool is_point = has_friction_of_a_point(plan);
    for (const dynamics::ContactRecord& contact : strike.record.contacts) {
      const dynamics::ImpactEnergy& energy = contact.energy;
      const double gain = energy.error / std::max(energy.in, energy.returned);
      EXPECT_LE(gain, is_point ? kMostGainOfPoint : kMostGain) << contact.time;
      worst[is_point ? 1 : 0] = std::max(worst[is_point ? 1 : 0], gain);
      ++impacts;
    }
  }
  fmt::print(
      "{} impacts, {} runs refused, largest gain {:.2g}, with friction of two "
      "smooth shapes {:.2g}\n",
      impacts, refused, worst[0], worst[1]);
  EXPECT_GE(2 * impacts, static_cast<int>(count_scenes()));
  EXPECT_LE(100 * refused, static_cast<int>(count_scenes()));
}

// The change from one step to its half, over that to its quarter.
TEST_F(StrikeOf, RandomBodiesConvergesWithTheStep) {
  std::vector<double> ratios;
  for (unsigned seed = 0; seed < count_scenes(); ++seed) {
    const ContactPlan plan = draw(seed);
    const Strike first = run(plan);
    const Strike half = run_finer(plan, 2.0);
    const Strike quarter = run_finer(plan, 4.0);
    const double change = compare(plan, half, quarter);
    if (!(change > 0.0)) continue;
    ratios.push_back(compare(plan, first, half) / change);
  }
  ASSERT_GE(2 * ratios.size(), count_scenes());
  const auto middle = ratios.begin() + std::ssize(ratios) / 2;
  std::nth_element(ratios.begin(), middle, ratios.end());
  fmt::print("{} strikes, median ratio {:.3g}\n", ratios.size(), *middle);
  EXPECT_GT(*middle, 2.0);
}

TEST_F(StrikeOf, RandomFreeBodiesKeepsMomenta) {
  constexpr double kSame = 1e-12;  // of what passes through the contact [-]
  int compared = 0;
  double worst_linear = 0.0;
  double worst_angular = 0.0;
  for (unsigned seed = 0; seed < count_scenes(); ++seed) {
    const ContactPlan plan = draw(seed);
    if (plan.bodies[1].is_world()) continue;
    const Strike strike = run(plan);
    if (!strike.refusal.empty() || strike.record.contacts.empty()) continue;
    SCOPED_TRACE(plan.description);
    const Momenta before = find_momenta(plan, find_start(plan));
    const Momenta after = find_momenta(plan, strike.bodies);
    double throughput = 0.0;
    for (const StrikingBody& body : plan.bodies) {
      throughput += body.mass * find_speed(plan);
    }
    const double arm = find_extent(plan);
    const double linear = (after.linear - before.linear).norm() / throughput;
    const double angular =
        (after.angular - before.angular).norm() / (throughput * arm);
    EXPECT_LE(linear, kSame);
    EXPECT_LE(angular, kSame);
    worst_linear = std::max(worst_linear, linear);
    worst_angular = std::max(worst_angular, angular);
    ++compared;
  }
  fmt::print("{} strikes, linear {:.2g}, angular {:.2g}\n", compared,
             worst_linear, worst_angular);
  EXPECT_GE(4 * compared, static_cast<int>(count_scenes()));
}

}  // namespace
}  // namespace limber::metamorphic::contact_test
