// SPDX-License-Identifier: BSD-3-Clause
// Names in a model, and checks of a whole one.
#include "limber/dynamics/system/system_model.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/model_check.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::system_model_test {
namespace {

using joints::JointKind;
using ::testing::HasSubstr;

/// World - arm - hand, a gear of both joints, a push.
SystemModel make_arm() {
  SystemBuilder builder;
  const auto arm = builder.add_rigid_body("arm", {1.0, Matrix3::Identity()});
  const auto points = testing::make_point_mass_body(12, 4, 2.0, 0.5, 100.0, 3);
  const auto hand = builder.add_flexible_body("hand", testing::share(points),
                                              Fidelity::coupled, {});
  const auto shoulder =
      builder.add_joint("shoulder", JointKind::revolute, {}, {arm});
  const auto tip = builder.attach_frame("tip", hand, {});
  const auto wrist = builder.add_coupler(
      "wrist",
      joints::make_joint(JointKind::revolute, Vector3::UnitZ(),
                         Vector3::UnitX(), {.translational_stiffness = 1e3}),
      builder.attach_frame("end", arm, {}), tip);
  builder.add_joint_sum("gear", {{{shoulder, 0, 1.0}, {wrist, 0, 2.0}}, 0.0},
                        {});
  builder.add_load("push", tip, {1, 0, 0}, {0, 0, 0}, LoadFrame::body,
                   Constant{});
  return builder.build();
}

template <typename Work>
std::string text_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SystemModel, FindsItsThingsByName) {
  const SystemModel model = make_arm();
  EXPECT_EQ(model.find_body("arm"), BodyIndex(0));
  EXPECT_EQ(model.find_body("hand"), BodyIndex(1));
  EXPECT_EQ(model.find_coupler("wrist"), CouplerIndex(1));
  EXPECT_EQ(model.find_transmission("gear"), TransmissionIndex(0));
  EXPECT_EQ(model.find_load("push"), LoadIndex(0));
  const AttachmentIndex tip = model.find_attachment("tip");
  EXPECT_EQ(model.attachments[static_cast<std::size_t>(tip)].name, "tip");
}

TEST(SystemModel, TellsTheNearestOfAnUnknownName) {
  const SystemModel model = make_arm();
  EXPECT_THAT(text_of([&] { (void)model.find_body("amr"); }),
              HasSubstr("unknown body 'amr'; did you mean 'arm'?"));
  EXPECT_THAT(text_of([&] { (void)model.find_coupler("Wrist"); }),
              HasSubstr("did you mean 'wrist'?"));
  EXPECT_THAT(text_of([&] { (void)model.find_load(""); }),
              HasSubstr("unknown load ''"));
  EXPECT_THAT(text_of([&] { (void)model.find_body("a\x1b[2Jm"); }),
              HasSubstr("a\\x1b[2Jm"));
  EXPECT_THAT(text_of([&] { (void)model.find_transmission("gear "); }),
              HasSubstr("did you mean 'gear'?"));
  EXPECT_THROW((void)SystemModel{}.find_body("arm"), InputError);
}

TEST(SystemModel, DoesNotChooseAmongAttachmentsOfOneName) {
  SystemModel model = make_arm();
  model.attachments.push_back(model.attachments.back());
  EXPECT_THAT(text_of([&] {
                (void)model.find_attachment(model.attachments.back().name);
              }),
              HasSubstr("2 attachments are called"));
}

TEST(CheckModel, TakesWhatABuilderBuilds) {
  EXPECT_NO_THROW(check_model(make_arm()));
  EXPECT_THROW((void)SystemBuilder().build(), InputError);
}

TEST(CheckModel, TellsAllThatIsWrongAtOnce) {
  SystemModel model = make_arm();
  model.bodies[0].mass = 0.0;
  model.couplers[1].frame_M = AttachmentIndex(40);
  model.loads[0].where = AttachmentIndex();
  const std::string text = text_of([&] { check_model(model); });
  EXPECT_THAT(text, HasSubstr("body 'arm': it has no mass"));
  EXPECT_THAT(text, HasSubstr("coupler 'wrist': it joins no two frames"));
  EXPECT_THAT(text, HasSubstr("load 'push': it acts on no frame"));
}

TEST(CheckModel, FindsEachChangeOfAGoodModel) {
  using Edit = void (*)(SystemModel&);
  const std::vector<std::pair<Edit, const char*>> edits = {
      {[](SystemModel& m) { m.bodies[1].name = "arm"; }, "another body"},
      {[](SystemModel& m) { m.bodies[1].name.clear(); }, "has no name"},
      {[](SystemModel& m) { m.bodies[1].mass = NAN; }, "no mass"},
      {[](SystemModel& m) { m.bodies[0].J0(1, 1) = NAN; }, "inertia"},
      {[](SystemModel& m) { m.bodies[1].offset = 1; }, "modal coordinates"},
      {[](SystemModel& m) { m.bodies[1].modes = 3; }, "one a mode"},
      {[](SystemModel& m) {
         m.bodies[1].elasticity = flexbody::DiagonalStiffness();
       },
       "one a mode"},
      {[](SystemModel& m) { m.bodies[1].damping[2] = NAN; }, "not finite"},
      {[](SystemModel& m) { m.bodies[1].damping.resize(0); }, "one a mode"},
      {[](SystemModel& m) { m.bodies[1].inertia.reset(); }, "by mode"},
      {[](SystemModel& m) { m.bodies[0].full = 0; }, "mesh is missing"},
      {[](SystemModel& m) { m.modal_count = 7; }, "together, not 7"},
      {[](SystemModel& m) { m.nodal_count = 3; }, "together, not 3"},
      {[](SystemModel& m) { m.full_bodies.emplace_back(); }, "unreduced"},
      {[](SystemModel& m) { m.attachments[2].p_BF[0] = NAN; }, "pose"},
      {[](SystemModel& m) { m.attachments[2].body = BodyIndex(2); },
       "on no body"},
      {[](SystemModel& m) { m.attachments[2].body = BodyIndex(0); },
       "a column for each mode"},
      {[](SystemModel& m) { m.couplers[0].frame_F = m.couplers[0].frame_M; },
       "same body"},
      {[](SystemModel& m) { m.couplers[0].name = "wrist"; }, "another coupler"},
      {[](SystemModel& m) { m.couplers[0].law = joints::Bushing({}); },
       "not a coordinate of a joint"},
      {[](SystemModel& m) {
         std::get<JointSum>(m.transmissions[0].coordinate).terms[0].factor = 0;
       },
       "factor"},
      {[](SystemModel& m) {
         m.transmissions[0].coordinate = PathCoordinate{{AttachmentIndex(0)}};
       },
       "fewer than two"},
      {[](SystemModel& m) { m.loads[0].force[1] = NAN; }, "force or moment"},
      {[](SystemModel& m) { m.loads[0].where = m.couplers[0].frame_F; },
       "acts on the world"},
      {[](SystemModel& m) {
         m.body_loads.push_back({"f", BodyIndex(5), {}, {}});
       },
       "acts on no body"},
      {[](SystemModel& m) { m.loads[0].function = InputFunction{.input = 0}; },
       "one of its inputs does not exist"},
      {[](SystemModel& m) { m.controllers.emplace_back().writes = {2}; },
       "one of its inputs does not exist"},
      {[](SystemModel& m) { m.controllers.emplace_back().name = "pid"; },
       "it has no law"},
      {[](SystemModel& m) {
         m.pairs.push_back({"touch", BodyIndex(7), BodyIndex(1), nullptr});
       },
       "one of its bodies does not exist"},
      {[](SystemModel& m) {
         m.pairs.push_back({"touch", BodyIndex(1), BodyIndex(1), nullptr});
       },
       "its two bodies are one"},
      {[](SystemModel& m) { m.gravity_W[2] = NAN; }, "gravity"},
      {[](SystemModel& m) { m.bodies.clear(); }, "no body that can move"},
  };
  for (const auto& [edit, text] : edits) {
    SystemModel model = make_arm();
    edit(model);
    EXPECT_THAT(text_of([&m = model] { check_model(m); }), HasSubstr(text));
  }
}

}  // namespace
}  // namespace limber::dynamics::system_model_test
