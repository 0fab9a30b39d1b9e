// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/drive_reader.hpp"

#include <gmock/gmock.h>

#include "limber/scene/scenario/scenario_reader.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::drive_reader_test {
namespace {

using joints::DriveMode;
using test::input_error;
using test::TemporaryFile;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kStart =
    "robot = \"r.urdf\"\n[time]\nduration = 1.0\nstep = 0.1\n";

Scenario read(const std::string& text) {
  const TemporaryFile file("scenario.toml", kStart + text);
  return read_scenario(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

const std::string kEffort = "[[drive]]\njoint='j'\nmode='effort'\n";

joints::Signal read_signal(const std::string& signal,
                           const std::string& more = "") {
  return read(kEffort + "signal={" + signal + "}\n" + more)
      .drives.at(0)
      .drive.signal;
}

TEST(DriveReader, ReadsEveryKeyOfAPositionDrive) {
  const Scenario scenario = read(
      "[[drive]]\nname='motor'\njoint='elbow'\ncoordinate=2\nmode='position'\n"
      "stiffness=1e5\ndamping=100.0\nmax_effort=50.0\nmax_speed=7.0\n"
      "signal={kind='ramp',from=0.5,to=3.5,start=0.1,duration=2.0,"
      "shape='smooth'}\nshaper={kind='zv',frequency=2.0}\n");
  const DriveSpec& spec = scenario.drives.at(0);
  EXPECT_EQ(spec.name, "motor");
  EXPECT_EQ(spec.joint, "elbow");
  EXPECT_EQ(spec.tendon, "");
  EXPECT_EQ(spec.coordinate, 2);
  EXPECT_EQ(spec.drive.mode, DriveMode::position);
  EXPECT_EQ(spec.drive.stiffness, 1e5);
  EXPECT_EQ(spec.drive.damping, 100.0);
  EXPECT_EQ(spec.drive.max_effort, 50.0);
  EXPECT_EQ(spec.drive.max_speed, 7.0);
  EXPECT_FALSE(spec.drive.pulls_only);
  const auto& ramp = std::get<joints::RampSignal>(spec.drive.signal.base);
  EXPECT_EQ(ramp.from, 0.5);
  EXPECT_EQ(ramp.to, 3.5);
  EXPECT_EQ(ramp.start, 0.1);
  EXPECT_EQ(ramp.duration, 2.0);
  EXPECT_EQ(ramp.shape, joints::RampShape::smooth);
  // Undamped: two halves, half a period apart.
  const auto& shaper = spec.drive.signal.shaper;
  ASSERT_EQ(shaper.size(), 2U);
  EXPECT_EQ(shaper[0].fraction, 0.5);
  EXPECT_EQ(shaper[1].delay, 0.25);
}

TEST(DriveReader, DriveOnATendonPullsAndTakesItsName) {
  const Scenario scenario = read(
      "[[drive]]\ntendon='flexor'\nmode='effort'\n"
      "signal={kind='constant',value=5}\n");
  EXPECT_EQ(scenario.drives.at(0).name, "flexor");
  EXPECT_TRUE(scenario.drives[0].drive.pulls_only);
  EXPECT_EQ(scenario.drives[0].drive.max_effort, joints::Drive::kUnlimited);
}

TEST(DriveReader, ReadsEveryKindOfSignal) {
  EXPECT_EQ(std::get<joints::ConstantSignal>(
                read_signal("kind='constant',value=-2.5").base)
                .value,
            -2.5);
  const auto ramp = std::get<joints::RampSignal>(
      read_signal("kind='ramp',to=1,duration=2,shape='trapezoid',rise=0.1")
          .base);
  EXPECT_EQ(ramp.rise, 0.1);
  const auto sine = std::get<joints::SineSignal>(
      read_signal("kind='sine',mean=1,amplitude=2,frequency=3,phase=4,start=5")
          .base);
  EXPECT_THAT((std::vector{sine.mean, sine.amplitude, sine.frequency,
                           sine.phase, sine.start}),
              ElementsAre(1, 2, 3, 4, 5));
  const auto table = std::get<joints::TableSignal>(
      read_signal("kind='table',times=[0,1,3],values=[5,6,7]").base);
  EXPECT_THAT(table.times, ElementsAre(0, 1, 3));
  EXPECT_THAT(table.values, ElementsAre(5, 6, 7));
  const TemporaryFile file("signal.csv", "time,angle\n0,1\n2,3\n");
  const auto measured = std::get<joints::TableSignal>(
      read_signal("kind='table',file='" + file.path().string() + "'").base);
  EXPECT_THAT(measured.times, ElementsAre(0, 2));
  EXPECT_THAT(measured.values, ElementsAre(1, 3));
}

TEST(DriveReader, RefusesSignalsWithASlip) {
  const auto error = [](const std::string& signal) {
    return error_of(kEffort + "signal={" + signal + "}\n");
  };
  EXPECT_THAT(error("kind='rmap',to=1,duration=1"),
              HasSubstr("did you mean 'ramp'"));
  EXPECT_THAT(error("value=1"), HasSubstr("needs 'kind'"));
  EXPECT_THAT(error("kind='constant'"), HasSubstr("needs 'value'"));
  EXPECT_THAT(error("kind='ramp',to=1,duration=0"), HasSubstr("duration"));
  EXPECT_THAT(error("kind='ramp',to=1,duration=1,rise=0.7,shape='trapezoid'"),
              HasSubstr("rise"));
  EXPECT_THAT(error("kind='ramp',to=1,duration=1,rise=0.2"),
              HasSubstr("only to shape 'trapezoid'"));
  EXPECT_THAT(error("kind='sine',amplitude=1,frequency=-1"),
              HasSubstr("frequency: is -1; expected a number > 0"));
  EXPECT_THAT(error("kind='table',times=[0,0],values=[1,2]"),
              HasSubstr("times do not increase"));
  EXPECT_THAT(error("kind='table',times=[0,1],values=[1]"),
              HasSubstr("2 times and 1 values"));
  EXPECT_THAT(error("kind='table',file='no.csv'"), HasSubstr("cannot read"));
  EXPECT_THAT(error("kind='constant',value=1,size=2"), HasSubstr("size"));
  EXPECT_THAT(error_of(kEffort), HasSubstr("needs 'signal'"));
}

TEST(DriveReader, RefusesShapersWithASlip) {
  const auto error = [](const std::string& shaper) {
    return error_of(kEffort + "signal={kind='constant',value=1}\nshaper={" +
                    shaper + "}\n");
  };
  EXPECT_THAT(error("kind='zvdd',frequency=1"), HasSubstr("zvd"));
  EXPECT_THAT(error("kind='zv'"), HasSubstr("needs 'frequency'"));
  EXPECT_THAT(error("kind='zv',frequency=1,damping_ratio=1"),
              HasSubstr("damping_ratio: is 1"));
}

TEST(DriveReader, RefusesGainsThatTheModeDoesNotHave) {
  const std::string signal = "signal={kind='constant',value=1}\n";
  const auto error = [&](const std::string& text) {
    return error_of("[[drive]]\njoint='j'\n" + text + signal);
  };
  EXPECT_THAT(error(""), HasSubstr("needs 'mode'"));
  EXPECT_THAT(error("mode='position'\n"), HasSubstr("needs 'stiffness'"));
  EXPECT_THAT(error("mode='velocity'\n"), HasSubstr("needs 'damping'"));
  EXPECT_THAT(error("mode='velocity'\ndamping=1\nstiffness=2\n"),
              HasSubstr("does not apply in this mode"));
  EXPECT_THAT(error("mode='effort'\ndamping=1\n"),
              HasSubstr("does not apply in this mode"));
  EXPECT_THAT(error("mode='effort'\nmax_effort=0.5\n"),
              HasSubstr("commands an effort of 1; its limit is 0.5"));
  EXPECT_THAT(error("mode='effort'\nmax_speed=0\n"), HasSubstr("max_speed"));
  EXPECT_THAT(error("mode='effort'\ncoordinate=4\n"), HasSubstr("coordinate"));
}

TEST(DriveReader, RefusesADriveWithoutOnePlace) {
  const std::string rest = "mode='effort'\nsignal={kind='constant',value=1}\n";
  EXPECT_THAT(error_of("[[drive]]\n" + rest),
              HasSubstr("needs one of 'joint' and 'tendon'"));
  EXPECT_THAT(error_of("[[drive]]\njoint='a'\ntendon='b'\n" + rest),
              HasSubstr("needs one of 'joint' and 'tendon'"));
  EXPECT_THAT(error_of("[[drive]]\ntendon='b'\ncoordinate=1\n" + rest),
              HasSubstr("a tendon has only its length"));
  EXPECT_THAT(error_of("[[drive]]\njoint='a'\n" + rest +
                       "[[drive]]\njoint='a'\n" + rest),
              HasSubstr("'a' is given twice"));
}

TEST(DriveReader, ReadsReleasesOfLatches) {
  const Scenario scenario = read(
      "[[release]]\nlatch='grip'\ntime=1.5\n"
      "[[release]]\nlatch='palm'\ntime=0\n");
  EXPECT_EQ(scenario.releases.size(), 2U);
  EXPECT_EQ(scenario.releases.at("grip"), 1.5);
  EXPECT_THAT(error_of("[[release]]\nlatch='grip'\n"),
              HasSubstr("needs 'time'"));
  EXPECT_THAT(error_of("[[release]]\nlatch='grip'\ntime=-1\n"),
              HasSubstr("time: is -1"));
  EXPECT_THAT(error_of("[[release]]\nlatch='grip'\ntime=1\n"
                       "[[release]]\nlatch='grip'\ntime=2\n"),
              HasSubstr("released twice"));
}

}  // namespace
}  // namespace limber::scene::drive_reader_test
