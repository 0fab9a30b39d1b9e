// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): POSIX
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): POSIX

#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <utility>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/results/gnuplot.hpp"
#include "limber/results/offset.hpp"
#include "png_pixels.hpp"
#include "small_run.hpp"
#include "temporary_folder.hpp"

namespace limber::results::pictures_test {
namespace {

using dynamics::SystemState;
using test::make_empty_run;
using test::make_small_run;
using test::read_bytes;
using test::SmallRun;
using test::TemporaryFolder;
using ::testing::HasSubstr;

// Sets PATH, and sets it back.
class Path {
 public:
  explicit Path(const std::string& value) {
    if (const char* old = getenv("PATH")) old_ = old;
    setenv("PATH", value.c_str(), 1);
  }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  ~Path() { setenv("PATH", old_.c_str(), 1); }

 private:
  std::string old_;
};

struct Size {
  std::uint32_t width = 0;   // [pixels]
  std::uint32_t height = 0;  // [pixels]
};

// What the header chunk of a whole PNG says; zeros if it is no whole PNG.
// Source: PNG specification (ISO/IEC 15948), 5.2 and 11.2.2.
Size read_png_size(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  const std::string signature = "\x89PNG\r\n\x1a\n";
  const std::string end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  if (bytes.size() < 33 + end.size() || bytes.compare(0, 8, signature) != 0 ||
      bytes.compare(8, 8, std::string("\0\0\0\x0dIHDR", 8)) != 0 ||
      bytes.compare(bytes.size() - end.size(), end.size(), end) != 0) {
    return {};
  }
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  return {number(16), number(20)};
}

// Draws into a new folder and checks its content.
template <typename Draw>
Size draw_and_measure(const Draw& draw) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "picture.png";
  EXPECT_EQ(draw(file), "");
  EXPECT_TRUE(std::filesystem::exists(file));
  return read_png_size(file);
}

// Large enough to read on a screen, small enough to fit one.
void expect_sensible(const Size& size) {
  EXPECT_GE(size.width, 600U);
  EXPECT_LE(size.width, 2000U);
  EXPECT_GE(size.height, 300U);
  EXPECT_LE(size.height, 2000U);
}

Series make_series(const std::string& name, std::vector<double> values) {
  Series series{name, {}, std::move(values)};
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    series.times.push_back(0.1 * static_cast<double>(i));
  }
  return series;
}

std::vector<double> wave(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(std::sin(0.1 * static_cast<double>(i)));
  }
  return values;
}

/// Draws only where gnuplot can be run.
class Pictures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (system("gnuplot --version >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "gnuplot is not installed";
    }
  }
};

TEST_F(Pictures, OverlayIsAPngThatGrowsWithItsPanels) {
  const Panel panel{"u [m]",
                    {make_series("a", wave(50)), make_series("b", wave(40))}};
  const Size one = draw_and_measure(
      [&](const auto& file) { return draw_overlay(file, "tip", {panel}); });
  const Size three = draw_and_measure([&](const auto& file) {
    return draw_overlay(file, "tip", {panel, panel, panel});
  });
  expect_sensible(one);
  expect_sensible(three);
  EXPECT_EQ(three.width, one.width);
  EXPECT_GT(three.height, 2 * one.height);
}

TEST_F(Pictures, EnergyAndSceneOfARunArePngs) {
  const SmallRun run = make_small_run();
  expect_sensible(draw_and_measure(
      [&](const auto& file) { return draw_energy(file, "run", run.history); }));
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_scene(file, "run", run.model, run.history, {});
  }));
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_displacement(file, "run", run.model, run.history.states.front(),
                             run.history.states.back(), 20.0, {});
  }));
}

SmallRun make_run_at(const Vector3& place) {
  SmallRun run = make_small_run();
  test::move_bodies(run.history, place);
  return run;
}

template <typename Draw>
test::Pixels draw_pixels(const Draw& draw) {
  const TemporaryFolder folder;
  EXPECT_EQ(draw(folder.path() / "picture.png"), "");
  return test::read_png(folder.path() / "picture.png");
}

// Apart from labels of axes and the smoothed edges of triangles.
void expect_same(const test::Pixels& near, const test::Pixels& far) {
  EXPECT_GT(test::find_inked_fraction(near), 0.05);
  EXPECT_LT(test::find_different_fraction(near, far), 0.01);
}

TEST_F(Pictures, ScenesFarAwayAreThoseNearTheOriginButForLabels) {
  const SmallRun near = make_small_run();
  const auto draw = [](const SmallRun& run) {
    return draw_pixels([&](const auto& file) {
      return draw_scene(file, "run", run.model, run.history, {});
    });
  };
  const test::Pixels expected = draw(near);
  for (const Vector3& place :
       {Vector3(3e5, -2e5, 5e5), Vector3(1e7, 0.0, 0.0)}) {
    SCOPED_TRACE(place.transpose());
    expect_same(expected, draw(make_run_at(place)));
  }
  // That the comparison can fail: another moment.
  SmallRun other = near;
  other.history.states = {near.history.states.front()};
  EXPECT_GT(test::find_different_fraction(expected, draw(other)), 0.01);
}

TEST_F(Pictures, ScenesThatTravelAreDrawnFromTheMeanOfTheirBodies) {
  SmallRun still = make_small_run();
  SmallRun fast = still;
  const Home home = find_home(still.model, still.history.states);
  ASSERT_FALSE(home.travels);
  double output = 0.0;
  test::change_states(fast.history, [&](SystemState& state) {
    state = shift_bodies(state, -output * Vector3(1e5, 0.0, 2e5));
    output += 1.0;
  });
  test::change_states(still.history, [](SystemState& state) {
    Vector3 mean = Vector3::Zero();
    for (const auto& body : state.bodies) mean += body.p_WB;
    state = shift_bodies(state, mean / double(state.bodies.size()));
  });
  const auto draw = [](const SmallRun& run) {
    return draw_pixels([&](const auto& file) {
      return draw_scene(file, "run", run.model, run.history, {});
    });
  };
  expect_same(draw(still), draw(fast));
}

TEST_F(Pictures, DisplacementsFarAwayAreThoseNearTheOriginButForLabels) {
  const auto draw = [](const SmallRun& run) {
    return draw_pixels([&](const auto& file) {
      return draw_displacement(file, "run", run.model,
                               run.history.states.front(),
                               run.history.states.back(), 20.0, {});
    });
  };
  expect_same(draw(make_small_run()), draw(make_run_at({1e7, 0.0, -2e6})));
}

// Values of nine digits would be stairs of 0.01 m, all with the same label; a
// curve beside them, of deformations, would count as round-off.
TEST_F(Pictures, CurvesOfPlacesFarAwayAreThoseNearTheOriginButForLabels) {
  const auto draw = [](double x, double start) {
    Series place = make_series("x", wave(200));
    for (double& value : place.values) value = x + 1e-3 * value;
    for (double& t : place.times) t = start + 1e-3 * t;
    Series small = make_series("u", wave(200));
    for (double& value : small.values) value *= 1e-4;
    small.times = place.times;
    const std::vector<Mark> marks = {{place.times[60], "touch"}};
    return draw_pixels([&](const auto& file) {
      return draw_overlay(file, "p", {{"x [m]", {place}}, {"u [m]", {small}}},
                          marks);
    });
  };
  const test::Pixels near = draw(0.0, 0.0);
  EXPECT_GT(test::find_inked_fraction(near), 0.01);
  for (const double x : {1e3, 6e5, -1e7}) {
    for (const double start : {0.0, 1e5}) {
      const double bound = start == 0.0 ? 0.002 : 0.01;
      EXPECT_LT(test::find_different_fraction(near, draw(x, start)), bound)
          << x << ' ' << start;
    }
  }
  EXPECT_LT(test::find_different_fraction(near, draw(0.0, 1e5)), 0.01);
}

TEST_F(Pictures, ShapesOfMeshesFarFromTheirOriginAreThoseNearIt) {
  const auto draw = [](double x) {
    Surface surface;
    surface.points.resize(3, 4);
    surface.points << 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
        1.0;
    surface.points.row(0).array() += x;
    surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const Matrix3X u = 0.1 * Matrix3X::Ones(3, 4);
    return draw_pixels([&](const auto& file) {
      return draw_deformation(file, "run", surface, u, 2.0);
    });
  };
  expect_same(draw(0.0), draw(1e7));
}

// Without a shape it is an ellipsoid of its inertia.
TEST_F(Pictures, SceneOfRigidBodiesAloneIsAPng) {
  dynamics::SystemBuilder builder;
  const auto ball = builder.add_rigid_body("ball", {2.0, Matrix3::Identity()});
  const dynamics::SystemModel model = builder.build();
  History history;
  history.states = {make_state(model)};
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_scene(file, "ball", model, history, {});
  }));
  Scenery scenery;
  scenery.shapes = {
      {"ball", ball, {}, {"box", Vector3(1.0, 2.0, 3.0), {}, {}}},
      {"floor", dynamics::kWorld, {}, {"plane", Vector3::Zero(), {}, {}}}};
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_scene(file, "ball", model, history, scenery);
  }));
}

TEST_F(Pictures, SceneWithoutAStateSaysSo) {
  const TemporaryFolder folder;
  const std::string why = draw_scene(folder.path() / "scene.png", "run",
                                     make_empty_run().model, {}, {});
  EXPECT_THAT(why, HasSubstr("no state"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct OddSeries {
  std::string name;
  std::vector<double> values;
  friend std::ostream& operator<<(std::ostream& out, const OddSeries& series) {
    return out << series.name;
  }
};

const std::vector<OddSeries> kOddSeries = {
    {"NaNInside", {0.0, 1.0, kNaN, -1.0, 0.5}},
    {"NaNFirst", {kNaN, 1.0, 2.0}},
    {"NaNAlone", {kNaN, kNaN, kNaN}},
    {"InfinityInside", {0.0, 1.0, kInf, -kInf, 0.5}},
    {"InfinityAlone", {kInf, -kInf}},
    {"OneSample", {1.0}},
    {"OneZero", {0.0}},
    {"OneNaN", {kNaN}},
    {"Constant", {3.0, 3.0, 3.0}},
    {"LargeConstant", {-1e300, -1e300}},
    {"Zeros", {0.0, 0.0, 0.0}},
    {"Tiny", {1e-310, -1e-310, 0.0}},
    {"Huge", {1e308, -1e308, 0.0}}};

class OddSeriesPicture : public Pictures,
                         public ::testing::WithParamInterface<OddSeries> {};

TEST_P(OddSeriesPicture, IsDrawnAlone) {
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_overlay(file, "odd",
                        {{"u [m]", {make_series("s", GetParam().values)}}});
  }));
}

TEST_P(OddSeriesPicture, IsDrawnBesideAnOrdinaryPanel) {
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_overlay(file, "odd",
                        {{"u [m]", {make_series("s", wave(30))}},
                         {"v [m/s]", {make_series("s", GetParam().values)}}});
  }));
}

TEST_P(OddSeriesPicture, IsDrawnAsEnergy) {
  History history;
  for (const double value : GetParam().values) {
    history.times.push_back(0.1 * static_cast<double>(history.times.size()));
    dynamics::EnergyBalance energy;
    energy.kinetic_rigid = value;
    energy.kinetic_modal = value;
    energy.elastic = value;
    energy.coupler = value;
    energy.dissipated = value;
    energy.work = value;
    history.energies.push_back(energy);
  }
  expect_sensible(draw_and_measure(
      [&](const auto& file) { return draw_energy(file, "odd", history); }));
}

INSTANTIATE_TEST_SUITE_P(Values, OddSeriesPicture,
                         ::testing::ValuesIn(kOddSeries),
                         [](const auto& odd) { return odd.param.name; });

TEST_F(Pictures, NamesOfAnyKindAreTextAndNotCommands) {
  const TemporaryFolder folder;
  const std::string trap = (folder.path() / "trap").string();
  const std::string name = "Träger 'x'\n\"y\" `touch " + trap +
                           "` {/*2 a_b^c} \\n'; system 'touch " + trap + "'; #";
  const std::filesystem::path file = folder.path() / "it's \"a\" $(b) `c`.png";
  EXPECT_EQ(draw_overlay(file, name, {{name, {make_series(name, wave(9))}}}),
            "");
  expect_sensible(read_png_size(file));
  EXPECT_FALSE(std::filesystem::exists(trap));
}

TEST_F(Pictures, FileThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "no_such/tip.png";
  const Panel panel{"u [m]", {make_series("a", wave(50))}};
  ::testing::internal::CaptureStdout();
  const std::string why = draw_overlay(file, "tip", {panel});
  // The picture does not go to our own output instead.
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_THAT(why, HasSubstr("'tip.png'"));
}

TEST_F(Pictures, FailureLeavesNoOldPicture) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "p.png";
  std::ofstream(file) << "an older picture";
  GnuplotScript script(file, 600, 400);
  script.add("plot no_such_thing");
  EXPECT_THAT(script.run(), HasSubstr("'p.png'"));
  EXPECT_NE(read_bytes(file), "an older picture");
}

// --- Without gnuplot --------------------------------------------------------

TEST(PicturesWithoutGnuplot, SayWhatToInstallAndLeaveNothing) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  const TemporaryFolder empty;
  const Path path(empty.path().string());
  const std::filesystem::path file = folder.path() / "picture.png";
  const Panel panel{"u [m]", {make_series("a", wave(50))}};
  for (const std::string& why : {draw_overlay(file, "tip", {panel}),
                                 draw_energy(file, "t", run.history)}) {
    EXPECT_THAT(why, HasSubstr("gnuplot is not installed"));
    EXPECT_THAT(why, HasSubstr("gnuplot-nox"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PicturesWithoutGnuplot, HaveScenes) {
  const SmallRun run = make_small_run();
  const TemporaryFolder empty;
  const Path path(empty.path().string());
  expect_sensible(draw_and_measure([&](const auto& file) {
    return draw_scene(file, "run", run.model, run.history, {});
  }));
}

TEST(Scenes, SayThatTheirFileCannotBeWritten) {
  const SmallRun run = make_small_run();
  EXPECT_THAT(
      draw_scene("/no/such/scene.png", "run", run.model, run.history, {}),
      HasSubstr("'/no/such/scene.png' cannot be written"));
}

// More text than a pipe holds (64 KiB): writing continues after the shell
// without gnuplot has ended.
TEST(PicturesWithoutGnuplot, LargePictureDoesNotEndTheProgram) {
  const TemporaryFolder folder;
  const TemporaryFolder empty;
  const Path path(empty.path().string());
  const Panel panel{"u [m]", {make_series("a", wave(200000))}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(draw_overlay(folder.path() / "p.png", "tip", {panel, panel}),
                HasSubstr("gnuplot-nox"));
  }
  // Nor is the signal left pending.
  sigset_t pending;
  sigset_t blocked;
  ASSERT_EQ(sigpending(&pending), 0);
  ASSERT_EQ(pthread_sigmask(SIG_SETMASK, nullptr, &blocked), 0);
  EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
  EXPECT_EQ(sigismember(&blocked, SIGPIPE), 0);
}

// --- Quotation --------------------------------------------------------------

TEST(GnuplotQuote, DoublesQuotesAndLeavesTheRest) {
  EXPECT_EQ(quote("it's \"a\" \\n `b`"), "'it''s \"a\" \\n `b`'");
}

TEST(GnuplotQuote, StaysOnOneLine) {
  EXPECT_EQ(quote("a\nb").find('\n'), std::string::npos);
}

}  // namespace
}  // namespace limber::results::pictures_test
