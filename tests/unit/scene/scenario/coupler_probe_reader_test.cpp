// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/coupler_probe_reader.hpp"

#include <gmock/gmock.h>

#include "limber/scene/scenario/scenario_reader.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::coupler_probe_reader_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::HasSubstr;

Scenario read(const std::string& text) {
  const TemporaryFile file("scenario.toml",
                           "robot = \"r.urdf\"\n[time]\nduration = 1.0\n"
                           "step = 0.1\n" +
                               text);
  return read_scenario(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

TEST(CouplerProbeReader, ReadsProbesOfCouplers) {
  const Scenario scenario = read(
      "[[probe]]\nname='p'\ncoupler='c'\nquantity='force'\nside='F'\n"
      "frame='world'\n[[probe]]\nname='q'\ncoupler='c'\n"
      "quantity='coordinate'\n");
  const auto& force = std::get<CouplerProbeSpec>(scenario.probes.at(0).of);
  EXPECT_EQ(force.coupler, "c");
  EXPECT_EQ(force.quantity, CouplerQuantity::force);
  EXPECT_EQ(force.side, ProbeSide::F);
  EXPECT_EQ(force.axes, ProbeAxes::world);
  const auto& angle = std::get<CouplerProbeSpec>(scenario.probes.at(1).of);
  EXPECT_EQ(angle.quantity, CouplerQuantity::coordinate);
}

TEST(CouplerProbeReader, TakesAJointByThatNameAndItsCoordinateByDefault) {
  const std::string probe = "[[probe]]\nname='p'\njoint='hinge'\n";
  const Scenario scenario = read(probe);
  const auto& found = std::get<CouplerProbeSpec>(scenario.probes.at(0).of);
  EXPECT_EQ(found.coupler, "hinge");
  EXPECT_EQ(found.quantity, CouplerQuantity::coordinate);
  EXPECT_THAT(error_of(probe + "coupler='c'\n"),
              HasSubstr("both 'coupler' and 'joint'"));
  EXPECT_THAT(error_of(probe + "link='a'\n"),
              HasSubstr("both 'link' and 'joint'"));
}

TEST(CouplerProbeReader, RefusesKeysThatTheQuantityDoesNotHave) {
  const std::string probe = "[[probe]]\nname='p'\ncoupler='c'\n";
  EXPECT_THAT(error_of(probe + "quantity='froce'\n"),
              HasSubstr("did you mean 'force'"));
  EXPECT_THAT(error_of(probe + "quantity='energy'\nframe='world'\n"),
              HasSubstr("has no axes"));
  EXPECT_THAT(error_of(probe + "quantity='relative_position'\nside='F'\n"),
              HasSubstr("only to 'force' and 'moment'"));
  EXPECT_THAT(error_of(probe + "quantity='force'\nlink='a'\n"),
              HasSubstr("both 'link' and 'coupler'"));
}

}  // namespace
}  // namespace limber::scene::coupler_probe_reader_test
