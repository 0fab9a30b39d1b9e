// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/scenario_reader.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene::scenario_reader_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::HasSubstr;

const std::string kStart =
    "robot = \"r.urdf\"\n[time]\nduration = 1.0\nstep = 0.1\n";

Scenario read(const std::string& text) {
  const TemporaryFile file("scenario.toml", text);
  return read_scenario(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

TEST(ScenarioReader, FillsInDefaults) {
  const Scenario scenario = read(kStart);
  EXPECT_EQ(scenario.fidelity, dynamics::Fidelity::coupled);
  EXPECT_EQ(scenario.settings.output_times.size(), 11U);
  EXPECT_EQ(scenario.settings.output_times.back(), 1.0);
  EXPECT_EQ(scenario.robot.filename(), "r.urdf");
}

TEST(ScenarioReader, TellsOfAWrongToleranceAlone) {
  const std::string text =
      error_of("robot='r.urdf'\n[time]\nduration=1.0\ntolerance=-1e-3\n");
  EXPECT_THAT(text, ::testing::HasSubstr("tolerance"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("'step'")));
}

TEST(ScenarioReader, ReadsHowManyStepsAToleranceMayTake) {
  const Scenario scenario = read(
      "robot='r.urdf'\n[time]\nduration=1.0\ntolerance=1e-3\n"
      "most_steps=5000\n");
  EXPECT_EQ(scenario.settings.most_steps, 5000);
}

TEST(ScenarioReader, ReadsHowManyStepsAnImpactGets) {
  const std::string time = "robot='r.urdf'\n[time]\nduration=1.0\nstep=0.1\n";
  EXPECT_EQ(read(time).settings.impact_steps, 20.0);
  EXPECT_EQ(read(time + "impact_steps=48\n").settings.impact_steps, 48.0);
  for (const char* value : {"3.9", "1001", "nan", "'12'"}) {
    EXPECT_THROW(read(time + "impact_steps=" + value + "\n"), InputError)
        << value;
  }
}

TEST(ScenarioReader, TellsWhereStepsAreLongerThanTheOutputInterval) {
  const auto warnings = [](const std::string& time) {
    return read("robot='r.urdf'\n[time]\nduration=1.0\n" + time).warnings;
  };
  EXPECT_THAT(warnings("step=0.1\noutput_interval=0.05\n"),
              ::testing::ElementsAre(HasSubstr("no longer than that")));
  EXPECT_THAT(warnings("steps={from=[0,0.5],size=[0.01,0.1]}\n"
                       "output_interval=0.05\n"),
              ::testing::SizeIs(1));
  EXPECT_THAT(warnings("step=0.1\noutput_interval=0.1\n"),
              ::testing::IsEmpty());
  EXPECT_THAT(warnings("step=0.1\noutput_times=[0.05]\n"),
              ::testing::IsEmpty());
  EXPECT_THAT(warnings("tolerance=1e-3\nstep=0.1\noutput_interval=0.05\n"),
              ::testing::IsEmpty());
}

TEST(ScenarioReader, ReadsLoadsAndProbes) {
  const Scenario scenario =
      read(kStart +
           "[[load]]\nname='l'\nlink='a'\ngroup='tip'\ndistribution='equal'\n"
           "force=[1,2.5,3]\nframe='world'\n"
           "time={kind='pulse',shape='half-sine',start=0.1,duration=0.2}\n"
           "[[probe]]\nname='p'\nlink='a'\nnode=7\nquantity='velocity'\n");
  EXPECT_EQ(scenario.loads.at(0).force, Vector3(1, 2.5, 3));
  EXPECT_EQ(scenario.loads[0].frame, dynamics::LoadFrame::world);
  const auto& pulse = std::get<dynamics::Pulse>(scenario.loads[0].time);
  EXPECT_EQ(pulse.shape, dynamics::PulseShape::half_sine);
  EXPECT_EQ(std::get<PointProbeSpec>(scenario.probes.at(0).of).quantity,
            Quantity::velocity);
}

TEST(ScenarioReader, ReadsRegionsOfNodes) {
  const Scenario scenario = read(
      kStart +
      "[[load]]\nname='l'\nlink='a'\nforce=[1,0,0]\n"
      "plane={point=[0,0,5],normal=[0,0,2],tolerance=0.01}\n"
      "[[probe]]\nname='p'\nlink='a'\n"
      "cylinder={from=[0,0,0],to=[0,0,1],radius=0.5,inner_radius=0.25}\n"
      "[[probe]]\nname='q'\nlink='a'\nbox={lower=[0,0,0],upper=[1,1,1]}\n");
  EXPECT_EQ(scenario.loads.at(0).where.nodes,
            flexbody::NodeSelection(
                flexbody::PlaneNodes{{0, 0, 5}, {0, 0, 1}, 0.01}));
  const auto nodes = [&](std::size_t i) {
    return std::get<PointProbeSpec>(scenario.probes.at(i).of).where.nodes;
  };
  EXPECT_EQ(nodes(0), flexbody::NodeSelection(flexbody::CylinderNodes{
                          {0, 0, 0}, {0, 0, 1}, 0.5, 0.25}));
  EXPECT_EQ(nodes(1),
            flexbody::NodeSelection(flexbody::BoxNodes{{0, 0, 0}, {1, 1, 1}}));
}

TEST(ScenarioReader, RefusesRegionsWithoutShape) {
  const auto error_at = [](const std::string& where) {
    return error_of(kStart + "[[probe]]\nname='p'\nlink='a'\n" + where);
  };
  EXPECT_THAT(error_at("plane={point=[0,0,5]}"),
              HasSubstr("[probe 1.plane] needs 'point' and 'normal'"));
  EXPECT_THAT(error_at("plane={point=[0,0,5],normal=[0,0,0]}"),
              HasSubstr("normal is zero"));
  EXPECT_THAT(error_at("plane={point=[0,0,5],normal=[0,0,1],tolerance=0}"),
              HasSubstr("tolerance"));
  EXPECT_THAT(error_at("cylinder={from=[0,0,0],to=[0,0,1]}"),
              HasSubstr("'radius'"));
  EXPECT_THAT(error_at("cylinder={from=[1,0,0],to=[1,0,0],radius=1}"),
              HasSubstr("take them apart"));
  EXPECT_THAT(error_at("box={lower=[0,0,0]}"), HasSubstr("'upper'"));
  EXPECT_THAT(error_at("cylinder={from=[0,0,0],to=[0,0,1],radis=1}"),
              HasSubstr("did you mean 'radius'"));
  EXPECT_THAT(error_at("group='g'\nplane={point=[0,0,5],normal=[0,0,1]}"),
              HasSubstr("has more than one of"));
}

TEST(ScenarioReader, ReadsInitialStateAndLevels) {
  const Scenario scenario = read(
      kStart +
      "[fidelity]\ndefault='rigid'\nlinks={a='one-way'}\n"
      "[initial.joints]\nj={position=0.5,velocity=[2]}\n"
      "[initial.base]\nposition=[1,0,0]\n[gravity]\nacceleration=[0,0,-9.81]");
  EXPECT_EQ(scenario.fidelity_of_link.at("a"), dynamics::Fidelity::one_way);
  EXPECT_EQ(scenario.joints.at("j").position.at(0), 0.5);
  EXPECT_EQ(scenario.base.position, Vector3::UnitX());
  EXPECT_EQ(scenario.gravity.z(), -9.81);
}

TEST(ScenarioReader, ReadsInitialDeformations) {
  const Scenario scenario =
      read(kStart +
           "[initial.links]\na={modes={position=[1,2],velocity=3}}\n"
           "[initial.links.b]\ndisplacement='u.txt'\nvelocity='sub/v.txt'\n");
  EXPECT_EQ(scenario.link_starts.at("a").eta, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(scenario.link_starts.at("a").etadot, std::vector<double>{3.0});
  const LinkStart& b = scenario.link_starts.at("b");
  EXPECT_EQ(b.displacement, scenario.file.parent_path() / "u.txt");
  EXPECT_EQ(b.velocity.filename(), "v.txt");
  EXPECT_THAT(error_of(kStart + "[initial.links.a]\nvelocity='v'\n"
                                "modes={position=1}\n"),
              HasSubstr("give only one of the two"));
  EXPECT_THAT(error_of(kStart + "[initial.links.a]\nmodes={position=nan}\n"),
              HasSubstr("position"));
}

TEST(ScenarioReader, NamesTheNearestKeyAndItsLine) {
  const std::string text = error_of(kStart + "rho_info = 0.5\n");
  EXPECT_THAT(text, HasSubstr("scenario.toml:5"));
  EXPECT_THAT(text, HasSubstr("did you mean 'rho_inf'"));
}

TEST(ScenarioReader, TellsEveryProblemAtOnce) {
  const std::string text = error_of(
      "robot = 3\n[time]\nduration = 0.0\nstep = '1 ms'\n[[load]]\nname='l'\n");
  EXPECT_THAT(text, HasSubstr("robot: expected a string, got integer"));
  EXPECT_THAT(text, HasSubstr("time.duration: is 0; expected a number > 0"));
  EXPECT_THAT(text, HasSubstr("time.step: expected a number > 0, got string"));
  EXPECT_THAT(text, HasSubstr("needs 'link'"));
}

TEST(ScenarioReader, RefusesBrokenToml) {
  EXPECT_THAT(error_of("robot = \n"), HasSubstr("scenario.toml:1"));
  EXPECT_THAT(input_error([] { (void)read_scenario("/no/such.toml"); }),
              HasSubstr("/no/such.toml"));
}

TEST(ScenarioReader, RefusesOutputTimesOutsideTheRun) {
  EXPECT_THAT(error_of(kStart + "output_times=[0.0, 2.0]\n"),
              HasSubstr("output_times"));
  EXPECT_THAT(error_of(kStart + "output_times=[0.5, 0.1]\n"),
              HasSubstr("must increase"));
}

std::string with_load_time(const std::string& time) {
  return kStart + "[[load]]\nname='l'\nlink='a'\nforce=[1,0,0]\ntime={" + time +
         "}\n";
}

dynamics::TimeFunction read_function(const std::string& time) {
  return read(with_load_time(time)).loads.at(0).time;
}

// Tables inside tables, for which toml++ would run out of stack.
TEST(ScenarioReader, RefusesKeysOfVeryManyParts) {
  const auto repeat = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
  };
  for (const std::string part : {"a.", "'a,'.", "\"\\\"\" . "}) {
    const std::string keys = repeat(part, 100000) + "a";
    EXPECT_THAT(error_of(kStart + keys + " = 1"),
                HasSubstr("toml:5: a key of"));
    EXPECT_THAT(error_of(kStart + "[" + keys + "]"),
                HasSubstr("toml:5: a key"));
    EXPECT_THAT(error_of(kStart + "x = [{s=\"\"\"'\n\"\"\", " + keys + "=1}]"),
                HasSubstr("toml:6: a key of"));
  }
}

TEST(ScenarioReader, CountsNoDotsOfTextsAndNumbersAsKeys) {
  std::string numbers;
  for (int i = 0; i < 100; ++i) numbers += "0.5, ";
  const Scenario scenario = read("# " + std::string(100, '.') + "\nrobot = '" +
                                 std::string(100, '.') +
                                 "'\n[time]\nduration = 1.0\nstep = 0.1\n"
                                 "[[load]]\nname = 'l'\nlink = 'a'\n"
                                 "force = [ 0.5 , 0.5\t, 0.5 ]\n");
  EXPECT_EQ(scenario.robot.filename(), std::string(100, '.'));
  EXPECT_THAT(error_of(kStart + "output_times = [ " + numbers + "]"),
              HasSubstr("must increase"));
}

TEST(ScenarioReader, StepsMayChangeAndOutputsFollowThem) {
  const Scenario scenario = read(
      "robot='r.urdf'\n[time]\nduration=1.0\n"
      "steps={from=[0.0,0.02],size=[0.01,0.49]}\n");
  EXPECT_EQ(scenario.settings.step, 0.01);
  ASSERT_EQ(scenario.settings.step_changes.size(), 1U);
  EXPECT_EQ(scenario.settings.step_changes[0].from, 0.02);
  EXPECT_THAT(scenario.settings.output_times,
              ::testing::Pointwise(::testing::DoubleEq(),
                                   {0.0, 0.01, 0.02, 0.51, 1.0}));
}

TEST(ScenarioReader, RefusesStepsThatDoNotBeginAtTheStart) {
  const std::string time = "robot='r.urdf'\n[time]\nduration=1.0\n";
  EXPECT_THAT(error_of(time + "steps={from=[0.1],size=[0.01]}"),
              HasSubstr("begin with 0"));
  EXPECT_THAT(error_of(time + "steps={from=[0,0.5,0.5],size=[1,1,1]}"),
              HasSubstr("must increase"));
  EXPECT_THAT(error_of(time + "steps={from=[0,0.5,0.2],size=[1e-9,1,1e-9]}"),
              HasSubstr("must increase"));
  EXPECT_THAT(error_of(time + "step=0.1\nsteps={from=[0],size=[0.1]}"),
              HasSubstr("keep one"));
}

TEST(ScenarioReader, ReadsASumOfSinusoids) {
  const auto function = read_function(
      "kind='sinusoids',mean=2,frequencies=[1.0,3.0],amplitudes=[0.5,0.25],"
      "phases=[0.0,0.3],until=9.0");
  const double pi = std::numbers::pi;
  const double t = 0.37;
  EXPECT_NEAR(
      dynamics::evaluate(function, t, Side::right),
      2.0 + 0.5 * std::sin(2.0 * pi * t) + 0.25 * std::sin(6.0 * pi * t + 0.3),
      1e-14);
  EXPECT_EQ(dynamics::evaluate(function, 9.5, Side::right), 0.0);
  EXPECT_THAT(error_of(with_load_time(
                  "kind='sinusoids',frequencies=[1.0],amplitudes=[1,2]")),
              HasSubstr("as many of each"));
}

TEST(ScenarioReader, FitsAFourierSeriesToAMeasuredLoad) {
  // Four samples of 1 + sin(2 pi t) and one that closes the period.
  const TemporaryFile file("load.csv",
                           "time,force\n0,1\n0.25, 2\n0.5;1\n0.75 0\n1 1\n");
  const auto function = read_function(
      "kind='fourier',harmonics=1,until=5.0,"
      "file='" +
      file.path().string() + "'");
  for (const double t : {0.1, 0.6, 2.3}) {
    EXPECT_NEAR(dynamics::evaluate(function, t, Side::right),
                1.0 + std::sin(2.0 * std::numbers::pi * t), 1e-14);
  }
}

TEST(ScenarioReader, TellsHowFarAFourierSeriesIsFromItsTable) {
  const Scenario scenario = read(
      with_load_time("kind='fourier',harmonics=1,times=[0,1,2,3,4,5,6,7,8],"
                     "values=[0,1,0,-1,0,1,0,-1,0]"));
  EXPECT_THAT(scenario.warnings,
              ::testing::ElementsAre(HasSubstr("1 harmonics miss")));
}

TEST(ScenarioReader, RefusesATableOfALoadWithASlip) {
  const TemporaryFile words("load.txt", "0 1\n1 two\n");
  EXPECT_THAT(error_of(with_load_time("kind='table',file='" +
                                      words.path().string() + "'")),
              HasSubstr("load.txt:2"));
  EXPECT_THAT(error_of(with_load_time("kind='table',file='no.txt'")),
              HasSubstr("cannot read"));
  const TemporaryFile back("load.txt", "0 1\n1 2\n0.5 2\n");
  EXPECT_THAT(error_of(with_load_time("kind='fourier',harmonics=1,file='" +
                                      back.path().string() + "'")),
              HasSubstr("must increase"));
}

}  // namespace
}  // namespace limber::scene::scenario_reader_test
