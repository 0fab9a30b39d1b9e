// SPDX-License-Identifier: BSD-3-Clause
// The exact derivative of a step's residual, through the factors that it
// completes, against central differences.
#include "limber/dynamics/newton/residual_derivative.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "support/coupled_springs.hpp"
#include "support/differences.hpp"
#include "support/elastic_kinds.hpp"
#include "support/linked_bodies.hpp"
#include "support/paired_bodies.hpp"

namespace limber::dynamics::residual_derivative_test {
namespace {

using testing::differentiate;
using testing::LinkedBodies;
using testing::make_all_links;
using testing::make_linked_bodies;
using testing::Margin;

constexpr double kGradient = 1e-8;
// For a step of 0.1 s: the terms neglected by the factors are large.
constexpr NewtonMatrix::Coefficients kCoefficients{400.0, 20.0};

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double number() { return uniform_(generator_); }
  Vector3 vector() { return {number(), number(), number()}; }
  VectorX vector(Eigen::Index size) {
    VectorX v(size);
    for (double& x : v) x = number();
    return v;
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

// A step's end, and the wrenches of Newton's iterate there.
struct Point {
  SystemState state;
  VectorX acceleration;
  VectorX motion;  // over the step
  std::vector<Vector6> wrenches;
};

Point make_point(const SystemModel& model, const SystemState& state,
                 unsigned seed) {
  Random random(seed);
  Point point{state, make_unknowns(model), make_unknowns(model), {}};
  for (const BodyModel& body : model.bodies) {
    translation_rows(body, point.acceleration) = 5.0 * random.vector();
    rotation_rows(body, point.acceleration) = 5.0 * random.vector();
    rotation_rows(body, point.motion) = random.vector();
  }
  for (const BodyModel& body : model.bodies) {
    mode_rows(body, point.acceleration) = 5.0 * random.vector(body.modes);
  }
  const std::size_t links = model.couplers.size() + model.transmissions.size();
  for (std::size_t i = 0; i < links; ++i) {
    point.wrenches.emplace_back(20.0 * random.vector(6));
  }
  return point;
}

// What increments and wrench increments make of it.
Point move(const SystemModel& model, const Point& from, const VectorX& x,
           const std::vector<Vector6>& dw, double h) {
  const double a = kCoefficients.acceleration;
  const double v = kCoefficients.velocity;
  Point to = from;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const VectorX eta = h * mode_rows(body, x);
    to.state.eta.segment(body.offset, body.modes) += eta;
    to.state.etadot.segment(body.offset, body.modes) += v * eta;
    mode_rows(body, to.acceleration) += a * eta;
    if (body.clamped) continue;
    const Vector3 p = h * translation_rows(body, x);
    const Vector3 theta = h * rotation_rows(body, x);
    const Vector3 inc =
        right_jacobian_inverse(rotation_rows(body, from.motion)) * theta;
    BodyState& s = to.state.bodies[b];
    s.p_WB += p;
    s.quat_WB = s.quat_WB * exp_quaternion(theta);
    s.v_WB_W += v * p;
    s.w_WB_B += v * inc;
    translation_rows(body, to.acceleration) += a * p;
    rotation_rows(body, to.acceleration) += a * inc;
  }
  for (std::size_t i = 0; i < dw.size(); ++i) to.wrenches[i] += h * dw[i];
  return to;
}

void evaluate(const SystemModel& model, const Point& point, SystemTerms& terms,
              VectorX& residual) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    terms.couplers[c].applied = point.wrenches[c];
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    terms.transmissions[i].applied =
        point.wrenches[model.couplers.size() + i][0];
  }
  calc_terms(model, point.state, Side::left, terms, WrenchSource::iterate);
  residual.setZero(count_unknowns(model));
  calc_residual(model, point.acceleration, terms, residual);
}

// Differences of residual and gaps along (x, dw), solved with factors and
// derivative, must give (x, dw) back.
void compare(const SystemModel& model, const Point& point, unsigned seed,
             Margin& margin, double& rest) {
  Random random(seed);
  VectorX x = random.vector(count_unknowns(model));
  const std::size_t links = model.couplers.size() + model.transmissions.size();
  std::vector<Vector6> dw(links);
  for (std::size_t i = 0; i < links; ++i) {
    dw[i] = 20.0 * random.vector(6);
    if (i >= model.couplers.size()) dw[i].tail<5>().setZero();
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Eigen::Index row =
        6 * static_cast<Eigen::Index>(b) + model.bodies[b].offset;
    if (model.bodies[b].clamped) x.segment<6>(row).setZero();
  }
  SystemTerms terms = make_terms(model);
  VectorX residual;
  const VectorX slope = differentiate([&](double h) {
    evaluate(model, move(model, point, x, dw, h), terms, residual);
    VectorX all(residual.size() + 6 * static_cast<Eigen::Index>(links));
    all.head(residual.size()) = residual;
    for (std::size_t i = 0; i < links; ++i) {
      all.segment<6>(residual.size() + 6 * static_cast<Eigen::Index>(i)) =
          NewtonMatrix::find_gap(terms, i);
    }
    return all;
  });

  evaluate(model, point, terms, residual);
  NewtonMatrix matrix(model);
  matrix.factor(model, point.state, terms, point.motion, kCoefficients);
  ResidualDerivative derivative(model);
  derivative.set_point(point.state, terms, point.acceleration, point.motion,
                       kCoefficients);
  VectorX right;
  std::vector<Vector6> gaps;
  derivative.apply_rest(x, right, gaps);
  rest = std::max(rest, right.norm() / slope.head(right.size()).norm());
  right -= slope.head(right.size());
  for (std::size_t i = 0; i < links; ++i) {
    gaps[i] -=
        slope.segment<6>(right.size() + 6 * static_cast<Eigen::Index>(i));
  }
  VectorX solved;
  matrix.solve(model, terms, right, gaps, solved);
  margin.add((solved - x).norm(), x.norm());
  for (std::size_t i = 0; i < links; ++i) {
    margin.add((matrix.wrench_increments()[i] - dw[i]).norm(), dw[i].norm());
  }
}

class ResidualDerivativeOf : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static LinkedBodies make(std::array<bool, 3> flexible,
                                         unsigned seed) {
    const auto links = make_all_links(2.0);
    return make_linked_bodies(links.at(static_cast<std::size_t>(GetParam())),
                              flexible, seed, 1.0);
  }
};

TEST_P(ResidualDerivativeOf, LinksIsThatOfDifferences) {
  Margin margin;
  double rest = 0.0;
  for (const auto flexible :
       {std::array{true, true, true}, std::array{true, false, true}}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const LinkedBodies linked = make(flexible, seed);
      compare(linked.model, make_point(linked.model, linked.state, seed),
              seed + 50, margin, rest);
    }
  }
  margin.expect_below(kGradient);
  EXPECT_GT(rest, 0.01);  // the factors alone are far from it
}

// The dense tangent stands in the factors.
TEST_P(ResidualDerivativeOf, StiffeningBodiesIsThatOfDifferences) {
  Margin margin;
  double rest = 0.0;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    LinkedBodies linked = make({true, false, true}, seed);
    testing::stiffen(linked.model, linked.state.eta.cwiseAbs().maxCoeff());
    compare(linked.model, make_point(linked.model, linked.state, seed),
            seed + 50, margin, rest);
  }
  margin.expect_below(kGradient);
}

// The geometric stiffness of interfaces stands in the factors, too.
TEST_P(ResidualDerivativeOf, NonlinearBodiesIsThatOfDifferences) {
  Margin margin;
  double rest = 0.0;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    LinkedBodies linked = make({true, false, true}, seed);
    testing::bend(linked.model, linked.state.eta.cwiseAbs().maxCoeff());
    compare(linked.model, make_point(linked.model, linked.state, seed),
            seed + 50, margin, rest);
  }
  margin.expect_below(kGradient);
}

INSTANTIATE_TEST_SUITE_P(
    All, ResidualDerivativeOf,
    ::testing::Range(0, static_cast<int>(make_all_links(0.0).size())),
    [](const auto& param) {
      return make_all_links(0.0)[static_cast<std::size_t>(param.param)].name;
    });

void add_nodal_loads(SystemModel& model) {
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) {
    const int m = count_coordinates(model.bodies[static_cast<std::size_t>(b)]);
    Random random(7);
    flexbody::NodalLoad history;
    history.times = {-1.0};
    history.force = 5.0 * random.vector();
    history.moment = 5.0 * random.vector();
    history.moment_by_mode = 5.0 * random.vector(3 * m).reshaped(3, m);
    history.modal = random.vector(m);
    model.body_loads.push_back({"nodal", b, history, {}});
  }
}

// On the far end of every body: forces and moments in either axes.
void add_loads(const LinkedBodies& linked, SystemModel& model) {
  for (AttachmentIndex i(0); i < std::ssize(linked.model.attachments); ++i) {
    model.loads.push_back({.name = "load",
                           .where = i,
                           .force = {3, -2, 4},
                           .moment = {1, 5, -2},
                           .in_world = i % 2 == 0,
                           .function = Constant{}});
  }
  add_nodal_loads(model);
}

TEST(ResidualDerivative, IsThatOfDifferencesAtEveryLevelUnderLoads) {
  const auto links = make_all_links(2.0);
  for (const Fidelity level : {Fidelity::rigid, Fidelity::uncoupled,
                               Fidelity::one_way, Fidelity::coupled}) {
    for (const bool clamped : {false, true}) {
      Margin margin;
      double rest = 0.0;
      for (unsigned seed = 1; seed <= 4; ++seed) {
        const bool flexible = level != Fidelity::rigid;
        const LinkedBodies linked =
            make_linked_bodies(links[1], {flexible, true, flexible}, seed, 1.0);
        SystemModel model = linked.model;
        add_loads(linked, model);
        model.gravity_W = {1, -9, 2};
        model.bodies[0].fidelity = model.bodies[2].fidelity = level;
        if (clamped) {
          BodyModel& first = model.bodies[0];
          first.clamped = true;
          first.P = Matrix3X::Constant(3, first.modes, 0.3);
        }
        SystemState state = linked.state;
        if (clamped) {
          state.bodies[0].v_WB_W.setZero();
          state.bodies[0].w_WB_B.setZero();
        }
        compare(model, make_point(model, state, seed), seed + 50, margin, rest);
      }
      SCOPED_TRACE(static_cast<int>(level));
      margin.expect_below(kGradient);
      EXPECT_GT(rest, 0.01);
    }
  }
}

// Points of pairs, nodal loads, and gravity on a clamped body: of products of
// modes at level nonlinear, too.
TEST(ResidualDerivative, OfPairsAndLoadsOnPointsIsThatOfDifferences) {
  for (const bool is_bent : {false, true}) {
    for (const bool clamped : {false, true}) {
      Margin margin;
      double rest = 0.0;
      for (unsigned seed = 1; seed <= 4; ++seed) {
        testing::PairedBodies paired =
            testing::make_paired_bodies({.is_bent = is_bent, .damping = 2.0});
        SystemModel& model = paired.model;
        model.gravity_W = {1, -9, 2};
        Random random(seed);
        paired.state.eta = 0.3 * random.vector(model.modal_count);
        add_nodal_loads(model);
        if (clamped) {
          BodyModel& first = model.bodies[0];
          first.clamped = true;
          first.P = random.vector(3 * count_coordinates(first))
                        .reshaped(3, count_coordinates(first));
          paired.state.bodies[0].v_WB_W.setZero();
          paired.state.bodies[0].w_WB_B.setZero();
        }
        compare(model, make_point(model, paired.state, seed), seed + 50, margin,
                rest);
      }
      SCOPED_TRACE(is_bent ? "nonlinear" : "coupled");
      margin.expect_below(kGradient);
      EXPECT_GT(rest, 1e-4);  // springs are soft: of 0.1 s
    }
  }
}

TEST(ResidualDerivative, OfPairsWhosePointsAreCoupledIsThatOfDifferences) {
  Margin margin;
  double rest = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    testing::PairedBodies paired = testing::make_paired_bodies({.lines = 3});
    SystemModel& model = paired.model;
    for (Pair& pair : model.pairs) {
      const auto modes_of = [&](BodyIndex body) {
        return body == kWorld ? 0 : model.bodies[index(body)].modes;
      };
      pair.law = std::make_shared<testing::CoupledSprings>(
          modes_of(pair.body_A), modes_of(pair.body_B), seed);
    }
    paired.state.eta = 0.3 * Random(seed).vector(model.modal_count);
    compare(model, make_point(model, paired.state, seed), seed + 50, margin,
            rest);
  }
  margin.expect_below(kGradient);
}

// So many couplers between A and B that the one with most, in all, stays among
// the unknowns: B, or A where enough hold it to the world; a gear on both.
TEST(ResidualDerivative, OfBodiesThatManyCouplersHoldIsThatOfDifferences) {
  const auto make_links = [](int grounds) -> testing::Link {
    return {
        "many",
        [grounds](SystemBuilder& builder, const testing::BodyEnds& ends) {
          const joints::Joint joint =
              testing::make_test_joint(joints::JointKind::revolute, 2.0, {});
          for (int i = 0; i < 12; ++i) {
            builder.add_coupler(fmt::format("first {}", i), joint, ends.far[0],
                                ends.near[1]);
          }
          builder.add_coupler("second", joint, ends.far[1], ends.near[2]);
          for (int i = 0; i < grounds; ++i) {
            builder.add_coupler(fmt::format("ground {}", i), joint,
                                builder.attach_world("world", {}),
                                ends.near[0]);
          }
          const joints::ScalarSpring spring(
              {.curve = joints::SpringCurve({.stiffness = 20.0}),
               .damping = 2.0});
          builder.add_joint_sum(
              "gear",
              {{{CouplerIndex(0), 0, 1.0}, {CouplerIndex(12), 0, -0.5}}, 0.1},
              {spring});
        }};
  };
  for (const auto flexible :
       {std::array{true, true, true}, std::array{false, true, true},
        std::array{true, false, false}}) {
    for (const auto& [clamped, grounds] :
         {std::pair{false, 1}, std::pair{true, 1}, std::pair{false, 6},
          std::pair{true, 6}}) {
      Margin margin;
      double rest = 0.0;
      const LinkedBodies linked =
          make_linked_bodies(make_links(grounds), flexible, 3, 1.0);
      SystemModel model = linked.model;
      SystemState state = linked.state;
      if (clamped && flexible[0]) {
        model.bodies[0].clamped = true;
        model.bodies[0].P = Matrix3X::Constant(3, model.bodies[0].modes, 0.3);
        state.bodies[0].v_WB_W.setZero();
        state.bodies[0].w_WB_B.setZero();
      }
      compare(model, make_point(model, state, 4), 51, margin, rest);
      margin.expect_below(kGradient);
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::residual_derivative_test
