// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/measured_probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::scene::measured_probe_test {
namespace {

Probe make_probe() {
  PointProbe point;
  point.body = dynamics::BodyIndex(0);
  point.quantity = Quantity::position;
  point.p_B = Vector3(1.0, 2.0, 3.0);
  return {"tip", point};
}

TEST(MeasuredProbe, IsTheColumnThatItIsAskedFor) {
  dynamics::SystemBuilder builder;
  builder.add_rigid_body("body", {1.0, Matrix3::Identity()});
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[0].p_WB = Vector3(0.5, -0.25, 8.0);
  const Probe probe = make_probe();
  const std::vector<ProbeColumnName> columns = column_names(probe);
  ASSERT_EQ(columns.size(), 3U);
  const Vector3 expected(1.5, 1.75, 11.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const dynamics::Measurement measured =
        measure_probe(probe, columns[i].name);
    EXPECT_EQ(measured.name, columns[i].name);
    EXPECT_EQ(measured.measure(model, state),
              expected[static_cast<Eigen::Index>(i)]);
  }
}

TEST(MeasuredProbe, IsIdentifiedByAllOfTheProbe) {
  const Probe probe = make_probe();
  const std::string column = column_names(probe)[0].name;
  Probe moved = probe;
  std::get<PointProbe>(moved.of).p_B.z() = 4.0;
  EXPECT_EQ(measure_probe(probe, column).of, measure_probe(probe, column).of);
  EXPECT_NE(measure_probe(probe, column).of, measure_probe(moved, column).of);
}

TEST(MeasuredProbe, RefusesAColumnThatIsNotThereAndNamesThoseThatAre) {
  try {
    (void)measure_probe(make_probe(), "tip.w");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'tip.w'"));
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr(column_names(make_probe())[2].name));
  }
}

}  // namespace
}  // namespace limber::scene::measured_probe_test
