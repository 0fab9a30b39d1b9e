// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "places.hpp"

/// Trees of rigid links on ideal joints against MuJoCo's, in joint coordinates
/// (tests/data/ideal_joints/README.md).
namespace limber::dynamics::ideal_tree_test {
namespace {

using joints::JointKind;

constexpr double kEnd = 0.5;  // [s]

Pose at(double x, double y, double z) {
  return {Matrix3::Identity(), Vector3(x, y, z)};
}

struct Tree {
  SystemModel model;
  SystemState state;
};

// As in fixed.xml, or on a floating base as in free.xml.
Tree make_tree(bool is_free) {
  SystemBuilder builder;
  const auto add_link = [&](const std::string& name, double mass, double x,
                            double y, double z) {
    return builder.add_rigid_body(name, {mass, Vector3(x, y, z).asDiagonal()});
  };
  const BodyIndex base =
      is_free ? add_link("base", 4.0, 0.3, 0.4, 0.5) : kWorld;
  const BodyIndex a = add_link("a", 1.5, 0.02, 0.03, 0.04);
  const BodyIndex b = add_link("b", 0.8, 0.01, 0.012, 0.008);
  const BodyIndex c = add_link("c", 0.5, 0.004, 0.006, 0.005);
  const BodyIndex d = add_link("d", 1.1, 0.02, 0.004, 0.021);
  const BodyIndex e = add_link("e", 0.7, 0.009, 0.002, 0.01);
  const JointOptions ideal{.held = {.is_ideal = true}};
  const auto join = [&](const std::string& name, JointKind kind,
                        const JointSide& parent, const JointSide& child,
                        const Vector3& axis) {
    builder.add_joint(name, kind, parent, child, axis, ideal);
  };
  join("a", JointKind::revolute, {base, at(is_free ? 0.4 : 0.0, 0.0, 0.0)},
       {a, at(-0.3, 0.0, 0.0)}, {1.0, 2.0, 2.0});
  join("b", JointKind::prismatic, {a, at(0.3, 0.1, -0.1)},
       {b, at(-0.1, -0.2, 0.1)}, {0.0, 1.0, 1.0});
  join("c", JointKind::ball, {b, at(0.2, 0.0, 0.0)}, {c, at(0.0, -0.15, 0.05)},
       Vector3::UnitX());
  join("d", JointKind::revolute, {a, at(-0.1, 0.2, 0.0)},
       {d, at(0.0, -0.25, 0.0)}, Vector3::UnitX());
  join("e", JointKind::revolute, {d, at(0.0, 0.25, 0.0)},
       {e, at(0.0, -0.2, 0.02)}, Vector3::UnitZ());
  if (!is_free) builder.set_gravity({0.0, 0.0, -9.81});

  SystemModel model = builder.build();
  SystemState state = make_state(model, {});
  if (is_free) {
    state.bodies.front().v_WB_W = {0.1, -0.2, 0.3};
    state.bodies.front().w_WB_B = {0.2, 0.1, -0.3};
  }
  place_bodies(model,
               {{"a", {{0.0}, {1.3}}},
                {"b", {{0.0}, {0.4}}},
                {"c", {{0.0, 0.0, 0.0}, {0.5, -0.8, 1.2}}},
                {"d", {{0.0}, {-2.1}}},
                {"e", {{0.0}, {1.7}}}},
               state);
  return {std::move(model), std::move(state)};
}

// Position [m] and quaternion (w, x, y, z) of the links at the end.
using Places = std::vector<double>;

Places run(Tree tree, double step) {
  SimulationSettings settings;
  settings.step = step;
  settings.end_time = kEnd;
  settings.newton_tolerance = 1e-13;
  simulate(tree.model, tree.state, settings, {});
  Places places;
  for (const BodyState& body : tree.state.bodies) {
    const Quaternion& q = body.quat_WB;
    const double sign = q.w() < 0.0 ? -1.0 : 1.0;
    places.insert(places.end(),
                  {body.p_WB.x(), body.p_WB.y(), body.p_WB.z(), sign * q.w(),
                   sign * q.x(), sign * q.y(), sign * q.z()});
  }
  return places;
}

Places read_reference(const std::string& name) {
  std::ifstream file(std::string(LIMBER_SOURCE_DIR) +
                     "/tests/data/ideal_joints/" + name + ".csv");
  Places numbers;
  for (std::string cell; std::getline(file, cell, ',');) {
    numbers.push_back(std::stod(cell));
  }
  EXPECT_GT(numbers.size(), 4U);
  EXPECT_NEAR(numbers.front(), kEnd, 1e-9);
  return {numbers.begin() + 1, numbers.end() - 3};
}

// A quaternion and its opposite are one rotation.
double find_distance(const Places& a, const Places& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i + 7 <= std::min(a.size(), b.size()); i += 7) {
    const Eigen::Map<const Eigen::Matrix<double, 7, 1>> first(a.data() + i);
    Eigen::Matrix<double, 7, 1> second;
    std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(i), 7, second.data());
    if (first.tail<4>().dot(second.tail<4>()) < 0.0) second.tail<4>() *= -1.0;
    largest = std::max(largest, (first - second).cwiseAbs().maxCoeff());
  }
  return largest;
}

// Without the errors of second, third and fourth order.
Places extrapolate(std::vector<Places> runs) {
  for (int order = 2; runs.size() > 1; ++order) {
    const double factor = std::exp2(order);
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      for (std::size_t k = 0; k < runs[i].size(); ++k) {
        runs[i][k] = (factor * runs[i + 1][k] - runs[i][k]) / (factor - 1.0);
      }
    }
    runs.pop_back();
  }
  return runs.front();
}

class IdealTree : public ::testing::TestWithParam<bool> {};

TEST_P(IdealTree, MovesAsMujocosDoesInJointCoordinates) {
  const Tree tree = make_tree(GetParam());
  const Places reference = read_reference(GetParam() ? "free" : "fixed");
  std::vector<Places> runs;
  std::vector<double> errors;
  for (const double step : {2e-3, 1e-3, 5e-4, 2.5e-4}) {
    runs.push_back(run(tree, step));
    errors.push_back(find_distance(runs.back(), reference));
  }
  EXPECT_NEAR(std::log2(errors[2] / errors[3]), 2.0, 0.1);
  EXPECT_LT(find_distance(extrapolate(runs), reference), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(FixedAndFree, IdealTree, ::testing::Bool());

}  // namespace
}  // namespace limber::dynamics::ideal_tree_test
