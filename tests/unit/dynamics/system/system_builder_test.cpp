// SPDX-License-Identifier: BSD-3-Clause
// What SystemBuilder promises to refuse, and that it names the thing.
#include "limber/dynamics/system/system_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/full_lattice.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::system_builder_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Lattice;
using testing::make_point_mass_body;
using testing::PointMassBody;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <typename Error, typename Call>
void expect_refused(const Call& call, const std::string& who,
                    const std::string& why) {
  try {
    call();
    ADD_FAILURE() << "taken: " << who << ", " << why;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(who), HasSubstr(why)));
  }
}

/// A rigid and a flexible body with a hinge between them.
class SystemBuilderTest : public ::testing::Test {
 protected:
  template <typename Call>
  void expect_input_error(const Call& call, const std::string& who,
                          const std::string& why) {
    expect_refused<InputError>(call, who, why);
  }
  template <typename Call>
  void expect_contract_error(const Call& call, const std::string& who,
                             const std::string& why) {
    expect_refused<ContractError>(call, who, why);
  }
  void refuse_inertia(const Matrix3& inertia, const std::string& why) {
    expect_input_error(
        [&] {
          builder_.add_rigid_body("odd", {1.0, inertia});
        },
        "body 'odd'", why);
  }
  void refuse_moments(const Vector3& moments, const std::string& why) {
    refuse_inertia(moments.asDiagonal(), why);
  }
  void take_moments(const Vector3& moments) {
    SystemBuilder builder;
    EXPECT_NO_THROW(
        builder.add_rigid_body("sane", {1.0, Matrix3(moments.asDiagonal())}));
  }
  void refuse_damping(const ModalDamping& damping, const std::string& why) {
    expect_input_error(
        [&] {
          builder_.add_flexible_body("soft", share(body_), Fidelity::coupled,
                                     damping);
        },
        "body 'soft'", why);
  }
  void refuse_body(const flexbody::ReducedBody& reduced,
                   const std::string& why) {
    const auto shared = std::make_shared<const flexbody::ReducedBody>(reduced);
    try {
      builder_.add_flexible_body("soft", shared, Fidelity::coupled, {});
      ADD_FAILURE() << "taken: " << why;
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr("body 'soft'"), HasSubstr(why)));
    }
  }
  static joints::CouplerLaw hinge() {
    return joints::make_joint(
        joints::JointKind::revolute, Vector3::UnitZ(), Vector3::UnitX(),
        {.translational_stiffness = 1e6, .rotational_stiffness = 1e6});
  }

  PointMassBody body_ = make_point_mass_body(12, 4, 2.0, 0.5, 100.0, 3);
  SystemBuilder builder_;
  BodyIndex rigid_ =
      builder_.add_rigid_body("rigid", {1.0, Matrix3::Identity()});
  BodyIndex flexible_ =
      builder_.add_flexible_body("bar", share(body_), Fidelity::coupled, {});
  AttachmentIndex world_frame_ = builder_.attach_world("ground", {});
  AttachmentIndex rigid_frame_ = builder_.attach_frame("end", rigid_, {});
  CouplerIndex joint_ =
      builder_.add_coupler("pivot", hinge(), world_frame_, rigid_frame_);
};

TEST_F(SystemBuilderTest, RefusesANameThatIsTakenOrEmpty) {
  const auto twice = [&](const auto& add, const std::string& who) {
    expect_input_error([&] { add(); }, who, "another");
  };
  const auto add_body = [&] {
    builder_.add_rigid_body("bar", {1.0, Matrix3::Identity()});
  };
  const auto add_coupler = [&] {
    builder_.add_coupler("pivot", hinge(), world_frame_, rigid_frame_);
  };
  const auto add_load = [&] {
    builder_.add_load("push", rigid_frame_, Vector3::UnitX(), Vector3::Zero(),
                      LoadFrame::world, Constant{});
  };
  const auto add_sum = [&] {
    builder_.add_joint_sum("gear", {{{joint_, 0, 1.0}}, 0.0}, {});
  };
  const auto add_path = [&] {
    builder_.add_path("gear", {world_frame_, rigid_frame_}, {});
  };
  add_load();
  add_sum();
  twice(add_body, "body 'bar'");
  twice(add_coupler, "coupler 'pivot'");
  twice(add_load, "load 'push'");
  twice(add_sum, "transmission 'gear'");
  twice(add_path, "transmission 'gear'");
  expect_input_error(
      [&] {
        builder_.add_rigid_body("", {1.0, Matrix3::Identity()});
      },
      "body", "no name");
  // Rejected objects are not added.
  EXPECT_EQ(builder_.build().bodies.size(), 2U);
  EXPECT_EQ(builder_.build().couplers.size(), 1U);
}

TEST_F(SystemBuilderTest, RefusesAnInertiaThatNoMassHas) {
  refuse_moments({1.0, 1.0, 3.0}, "(1, 1, 3) kg m^2, the largest exceeds");
  refuse_moments({1.0, 1.0, 2.01}, "the largest exceeds");
  refuse_moments({1e-12, 1e-12, 3e-12}, "the largest exceeds");
  refuse_moments({1.0, 1.0, -1.0}, "expected all > 0");
  refuse_moments({1.0, 1.0, 0.0}, "expected all > 0");
  for (const double bad : {kNaN, kInf}) {
    refuse_moments({1.0, bad, 1.0}, "not finite");
  }
  Matrix3 skewed = Matrix3::Identity();
  skewed(0, 1) = 0.5;
  refuse_inertia(skewed, "not symmetric");
  // Turned axes: the moments are those of its eigenvalues.
  const Matrix3 turn =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).matrix();
  const Matrix3 odd =
      turn * Vector3(1.0, 1.0, 3.0).asDiagonal() * turn.transpose();
  refuse_inertia(0.5 * (odd + odd.transpose()), "the largest exceeds");
}

TEST_F(SystemBuilderTest, TakesThinRodsAndPlatesAndPrintedDigits) {
  take_moments({1e-9, 1.0, 1.0});  // a rod
  take_moments({1.0, 1.0, 2.0});   // a plate
  take_moments({1.0 / 3.0, 1.0, 1.0 / 3.0 + 1.0 + 1e-15});
  take_moments({0.0833, 0.0833, 0.1667});  // one of 4 digits
}

TEST_F(SystemBuilderTest, RefusesAMassThatIsNotPositiveAndFinite) {
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    expect_input_error(
        [&] {
          builder_.add_rigid_body("odd", {bad, Matrix3::Identity()});
        },
        "body 'odd'", "mass is");
  }
}

TEST_F(SystemBuilderTest, RefusesDampingThatFeedsEnergyIn) {
  for (const double bad : {-1e-3, kNaN, kInf}) {
    refuse_damping({.rayleigh_mass = bad, .ratios = {}},
                   "Rayleigh damping of mass");
    refuse_damping({.rayleigh_stiffness = bad, .ratios = {}},
                   "Rayleigh damping of stiffness");
    refuse_damping({.ratios = {bad}}, "a damping ratio is");
    refuse_damping({.ratios = {0.1, 0.1, bad, 0.1}}, "a damping ratio is");
  }
  // Not made good by what another kind adds.
  refuse_damping({.rayleigh_mass = -1.0, .ratios = {0.9}}, "of mass");
  refuse_damping({.ratios = {0.1, 0.1}}, "2 damping ratios for 4 modes");
  refuse_damping({.rayleigh_stiffness = 1e308, .ratios = {}}, "highest mode");
}

TEST_F(SystemBuilderTest, RefusesAReducedBodyThatIsNotWhole) {
  const auto edited = [&](const auto& edit) {
    flexbody::ReducedBody body = body_.reduced;
    edit(body);
    return body;
  };
  using Body = flexbody::ReducedBody;
  refuse_body(edited([](Body& b) { b.mass = kNaN; }), "mass is nan");
  refuse_body(edited([](Body& b) { b.integrals.S0(0, 0) = kInf; }),
              "inertia is not finite");
  refuse_body(edited([](Body& b) { b.lambda[2] = -4.0; }),
              "eigenvalue 3 is -4");
  refuse_body(edited([](Body& b) { b.lambda[0] = kNaN; }), "eigenvalue 1");
  refuse_body(edited([](Body& b) { b.integrals.S1.pop_back(); }),
              "S1 has 3 columns; expected 4");
  refuse_body(edited([](Body& b) { b.integrals.S2.pop_back(); }),
              "S2 has 15 columns; expected 16");
  refuse_body(edited([](Body& b) { b.integrals.S1[1](0, 2) = kNaN; }),
              "S1 is not finite");
  refuse_body(edited([](Body& b) { b.integrals.S2[7](1, 1) = kNaN; }),
              "S2 is not finite");
  refuse_body(edited([](Body& b) {
                b.clamped = true;
                b.integrals.P = Matrix3X::Zero(3, 2);
              }),
              "2 columns; expected 4");
  expect_contract_error(
      [&] {
        builder_.add_flexible_body("soft", share(body_), Fidelity::full, {});
      },
      "body 'soft'", "add_full_body");
}

TEST_F(SystemBuilderTest, RefusesFramesOfNoBody) {
  const flexbody::InterfaceTable table = make_interface(body_, 0, 4);
  for (const int odd : {-1, 2, 1000}) {
    const std::string why = "there is no body " + std::to_string(odd);
    expect_contract_error(
        [&] { builder_.attach_frame("f", BodyIndex(odd), {}); }, "frame 'f'",
        why);
    expect_contract_error(
        [&] { builder_.attach_interface("f", BodyIndex(odd), table, {}); },
        "frame 'f'", why);
    expect_contract_error(
        [&] { builder_.attach_nodes("f", BodyIndex(odd), {}, {}); },
        "frame 'f'", why);
    expect_contract_error(
        [&] { builder_.add_nodal_load("l", BodyIndex(odd), {}); },
        "nodal load 'l'", why);
  }
  EXPECT_EQ(builder_.build().attachments.size(), 2U);
}

TEST_F(SystemBuilderTest, RefusesAPoseThatIsNone) {
  Pose nowhere;
  nowhere.p[1] = kNaN;
  Pose stretched;
  stretched.R *= 1.001;
  Pose mirrored;
  mirrored.R(2, 2) = -1.0;
  for (const std::pair<Pose, const char*>& odd :
       {std::pair{nowhere, "not finite"}, std::pair{stretched, "a rotation"},
        std::pair{mirrored, "a rotation"}}) {
    expect_input_error([&] { builder_.attach_frame("f", rigid_, odd.first); },
                       "frame 'f'", odd.second);
    expect_input_error([&] { builder_.attach_world("f", odd.first); },
                       "frame 'f'", odd.second);
  }
}

TEST_F(SystemBuilderTest, RefusesInterfaceTablesOfAnotherSize) {
  flexbody::InterfaceTable table = make_interface(body_, 0, 4);
  table.name = "root";
  const auto attach = [&](const auto& edit) {
    flexbody::InterfaceTable odd = table;
    edit(odd);
    builder_.attach_interface("f", flexible_, odd, {});
  };
  using Table = flexbody::InterfaceTable;
  expect_contract_error(
      [&] { attach([](Table& t) { t.Phi_B.conservativeResize(3, 3); }); },
      "frame 'f'", "interface 'root', translation has 3 columns; expected 4");
  expect_contract_error(
      [&] { attach([](Table& t) { t.Psi_B.conservativeResize(3, 0); }); },
      "frame 'f'", "interface 'root', rotation has 0 columns; expected 4");
  expect_input_error([&] { attach([](Table& t) { t.Phi_B(0, 1) = kNaN; }); },
                     "frame 'f'", "interface 'root' is not finite");
  expect_input_error([&] { attach([](Table& t) { t.p_B[2] = kInf; }); },
                     "frame 'f'", "interface 'root' is not finite");
}

TEST_F(SystemBuilderTest, RefusesCouplersOfNoFrameOrOfOneBody) {
  for (const int number : {-1, 2, 99}) {
    const AttachmentIndex odd(number);
    const std::string why = "there is no frame " + std::to_string(number);
    expect_contract_error(
        [&] { builder_.add_coupler("c", hinge(), odd, rigid_frame_); },
        "coupler 'c'", why);
    expect_contract_error(
        [&] { builder_.add_coupler("c", hinge(), world_frame_, odd); },
        "coupler 'c'", why);
    expect_contract_error(
        [&] {
          builder_.add_path("t", {world_frame_, odd}, {});
        },
        "tendon 't'", why);
    expect_contract_error(
        [&] {
          builder_.add_load("l", odd, Vector3::UnitX(), Vector3::Zero(),
                            LoadFrame::world, Constant{});
        },
        "load 'l'", why);
  }
  expect_input_error(
      [&] { builder_.add_coupler("c", hinge(), rigid_frame_, rigid_frame_); },
      "coupler 'c'", "same body");
  expect_input_error([&] { builder_.add_path("t", {rigid_frame_}, {}); },
                     "tendon 't'", "1 point of one body");
}

TEST_F(SystemBuilderTest, RefusesTransmissionsOfJointsThatDoNotExist) {
  const auto add = [&](const JointSum& sum) {
    builder_.add_joint_sum("gear", sum, {});
  };
  for (const int odd : {-1, 1, 50}) {
    expect_contract_error(
        [&] {
          add({{{CouplerIndex(odd), 0, 1.0}}, 0.0});
        },
        "transmission 'gear'", "there is no coupler " + std::to_string(odd));
    expect_contract_error(
        [&] {
          add({{{joint_, odd, 1.0}}, 0.0});
        },
        "transmission 'gear', coupler 'pivot'",
        "there is no coordinate " + std::to_string(odd));
  }
  expect_contract_error([&] { add({}); }, "transmission 'gear'", "no joint");
  for (const double bad : {0.0, kNaN, kInf}) {
    expect_input_error(
        [&] {
          add({{{joint_, 0, bad}}, 0.0});
        },
        "transmission 'gear'", "the factor of 'pivot'");
  }
  expect_input_error(
      [&] {
        add({{{joint_, 0, 1.0}}, kNaN});
      },
      "transmission 'gear'", "offset is not finite");
}

TEST_F(SystemBuilderTest, RefusesLoadsThatAreNotFiniteOrMoveNothing) {
  const auto add = [&](AttachmentIndex where, const Vector3& force,
                       const Vector3& moment, const TimeFunction& function) {
    builder_.add_load("l", where, force, moment, LoadFrame::body, function);
  };
  const Vector3 odd(0.0, kNaN, 0.0);
  const Vector3 push = Vector3::UnitX();
  const Vector3 none = Vector3::Zero();
  expect_input_error([&] { add(rigid_frame_, odd, none, Constant{}); },
                     "load 'l'", "not finite");
  expect_input_error([&] { add(rigid_frame_, none, odd, Constant{}); },
                     "load 'l'", "not finite");
  expect_input_error([&] { add(rigid_frame_, push, none, Pulse{}); },
                     "load 'l'", "pulse");
  expect_input_error([&] { add(world_frame_, push, none, Constant{}); },
                     "load 'l'", "world");
  for (const double bad : {kNaN, kInf}) {
    expect_input_error(
        [&] {
          builder_.set_gravity({0.0, 0.0, bad});
        },
        "gravity", "not finite");
  }
}

TEST_F(SystemBuilderTest, RefusesNodalLoadsOfAnotherSizeOrNotFinite) {
  const auto history = flexbody::reduce_nodal_load(body_.reduced, {0.0, 1.0},
                                                   MatrixX::Ones(36, 2));
  const auto add = [&](const auto& edit) {
    flexbody::NodalLoad odd = history;
    edit(odd);
    builder_.add_nodal_load("l", flexible_, odd);
  };
  using Load = flexbody::NodalLoad;
  const auto sized = [&](const auto& edit, const std::string& why) {
    expect_contract_error([&] { add(edit); }, "nodal load 'l'", why);
  };
  const auto valued = [&](const auto& edit, const std::string& why) {
    expect_input_error([&] { add(edit); }, "nodal load 'l'", why);
  };
  sized([](Load& l) { l.force.conservativeResize(3, 1); }, "its force has 1");
  sized([](Load& l) { l.moment.conservativeResize(3, 1); }, "its moment has 1");
  sized([](Load& l) { l.modal.conservativeResize(4, 1); },
        "its modal force has 1");
  sized([](Load& l) { l.modal.conservativeResize(3, 2); }, "3 rows");
  sized([](Load& l) { l.moment_by_mode.conservativeResize(3, 7); },
        "its moment by mode has 7 columns; expected 8");
  valued([](Load& l) { l.force(0, 1) = kNaN; }, "not finite");
  valued([](Load& l) { l.modal(3, 1) = kInf; }, "not finite");
  valued([](Load& l) { l.moment_by_mode(0, 5) = kNaN; }, "not finite");
  valued([](Load& l) { l.times = {1.0, 1.0}; }, "time 2 is 1 s");
  valued([](Load& l) { l.times[0] = kNaN; }, "time 1 is nan s");
  EXPECT_TRUE(builder_.build().body_loads.empty());
}

TEST(FullBodyBuilder, RefusesNodesThatItDoesNotHave) {
  Lattice lattice;
  SystemBuilder& builder = lattice.builder;
  const int count = static_cast<int>(lattice.full->node_count());
  const auto attach = [&](int last, const VectorX& weights, int moments) {
    builder.attach_nodes(
        "f", BodyIndex(0),
        {"set", {0, last}, weights, Matrix3X::Zero(3, moments)}, {});
  };
  const VectorX half = VectorX::Constant(2, 0.5);
  expect_refused<ContractError>([&] { attach(count, half, 2); },
                                "frame 'f', node set 'set'",
                                "there is no node");
  expect_refused<ContractError>([&] { attach(1, VectorX::Ones(1), 2); },
                                "frame 'f'", "2 nodes and 1 weights");
  expect_refused<InputError>([&] { attach(1, VectorX::Ones(2), 2); },
                             "frame 'f'", "sum to 2");
  expect_refused<ContractError>([&] { attach(1, half, 1); }, "frame 'f'",
                                "1 moments");
  expect_refused<ContractError>(
      [&] { builder.attach_interface("f", BodyIndex(0), {}, {}); }, "frame 'f'",
      "at level full");
  const flexbody::NodalLoad history{
      {0.0}, Matrix3X::Zero(3, 1), Matrix3X::Zero(3, 1), {}, {}};
  expect_refused<ContractError>(
      [&] {
        builder.add_nodal_load("l", BodyIndex(0), history, MatrixX::Zero(3, 1));
      },
      "nodal load 'l'", "3 x 1 nodal forces");
  flexbody::ReducedBody odd = *lattice.reduced;
  odd.rows.Phi_B.conservativeResize(Eigen::NoChange, 1);
  expect_refused<ContractError>(
      [&] {
        builder.add_full_body(
            "odd", std::make_shared<const flexbody::ReducedBody>(odd),
            lattice.full, {});
      },
      "body 'odd'", "mode shapes has 1 columns");
}

TEST(SystemBuilder, RefusesASystemWithoutABody) {
  expect_refused<InputError>([] { static_cast<void>(SystemBuilder().build()); },
                             "system", "no body");
}

}  // namespace
}  // namespace limber::dynamics::system_builder_test
