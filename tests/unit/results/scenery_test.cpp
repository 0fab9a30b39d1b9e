// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scenery.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/results/results_file.hpp"
#include "limber/version.hpp"
#include "unit/results/small_run.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::scenery_test {
namespace {

using dynamics::AttachmentIndex;
using dynamics::BodyIndex;
using dynamics::Load;
using dynamics::TimeFunction;
using test::make_small_run;
using test::SmallRun;
using test::TemporaryFolder;
using ::testing::ElementsAre;

/// A results file with its scene, opened.
class Written {
 public:
  explicit Written(const SmallRun& run, const Scenery& scenery = {})
      : file_(write(folder_, run, scenery)) {}
  const Hdf5File* operator->() const { return &file_; }

 private:
  static Hdf5File write(const TemporaryFolder& folder, const SmallRun& run,
                        const Scenery& scenery) {
    const auto file = folder.path() / "results.h5";
    write_results(file, run.model, run.history, &scenery);
    return Hdf5File::open(file);
  }

  TemporaryFolder folder_;
  Hdf5File file_;
};

SmallRun make_loaded_run(const TimeFunction& function) {
  SmallRun run = make_small_run();
  Load load;
  load.name = "push";
  load.where = AttachmentIndex(0);
  load.force = {1.0, 2.0, 3.0};
  load.function = function;
  run.model.loads.push_back(load);
  return run;
}

TEST(Scenery, KeepsTheTextsThatTheRunCameFrom) {
  Scenery scenery;
  scenery.name = "n";
  scenery.scenario = "robot = 'r.urdf'\n";
  scenery.robots = {{"arm", "<robot/>"}};
  scenery.settings = "--set time.step=1\n";
  const Written in(make_small_run(), scenery);
  EXPECT_EQ(in->read_text("scene/limber"), LIMBER_VERSION);
  EXPECT_EQ(in->read_text("scene/name"), "n");
  EXPECT_EQ(in->read_text("scene/scenario"), "robot = 'r.urdf'\n");
  EXPECT_EQ(in->read_text("scene/robots/0/name"), "arm");
  EXPECT_EQ(in->read_text("scene/robots/0/text"), "<robot/>");
  EXPECT_EQ(in->read_text("scene/settings"), "--set time.step=1\n");
}

// Triangles of the arm: rows 0 to 5 and 21 to 23 of 24.
TEST(Scenery, SurfacesAreTheRowsThatTrianglesUse) {
  const SmallRun run = make_small_run();
  const Written in(run);
  ASSERT_EQ(in->list("scene/surfaces").size(), 3U);
  const std::string at =
      "scene/surfaces/" + in->read_text("scene/bodies/arm/surface") + "/";
  EXPECT_THAT(in->read_integers(at + "triangles"),
              ElementsAre(0, 1, 2, 3, 4, 5, 8, 7, 6));
  const auto& rows = run.points[0].reduced.rows;
  const std::vector<Eigen::Index> used = {0, 1, 2, 3, 4, 5, 21, 22, 23};
  const MatrixX x = in->read_matrix(at + "x_B");
  const MatrixX Phi = in->read_matrix(at + "Phi_B");
  ASSERT_EQ(Phi.rows(), 27);
  ASSERT_EQ(Phi.cols(), 3);
  for (Eigen::Index i = 0; i < 9; ++i) {
    const Eigen::Index row = used[static_cast<std::size_t>(i)];
    EXPECT_EQ(x.col(i), rows.x_B.col(row));
    const MatrixX wanted = rows.Phi_B.middleRows<3>(3 * row);
    EXPECT_LT((Phi.middleRows<3>(3 * i) - wanted).norm(), 1e-7 * wanted.norm());
  }
}

TEST(Scenery, OfARigidLinkHasASurfaceWithoutModes) {
  const Written in(make_small_run());
  const std::string at =
      "scene/surfaces/" + in->read_text("scene/bodies/plate/surface") + "/";
  EXPECT_EQ(in->read_matrix(at + "Phi_B").cols(), 0);
  EXPECT_FALSE(in->has("scene/bodies/ball/surface"));
  EXPECT_EQ(in->read_matrix("scene/bodies/ball/inertia").diagonal(),
            Vector3(1, 2, 3));
}

TEST(Scenery, OfABodyWithoutTrianglesSaysSo) {
  SmallRun run = make_small_run();
  auto bare = *run.model.bodies[0].reduced;
  bare.triangles.clear();
  run.model.bodies[0].reduced =
      std::make_shared<const flexbody::ReducedBody>(bare);
  const Written in(run);
  EXPECT_EQ(in->read_text("scene/bodies/arm/surface"), "none");
}

TEST(Scenery, CouplersFollowTheModesAtTheirEnds) {
  const SmallRun run = make_small_run();
  const Written in(run);
  const std::string at = "scene/couplers/0000/";
  EXPECT_EQ(in->read_text(at + "name"), "wrist");
  EXPECT_EQ(in->read_text(at + "F/body"), "arm");
  EXPECT_EQ(in->read_text(at + "M/body"), "hand");
  const auto& [F, M] =
      std::pair(run.model.couplers[0].frame_F, run.model.couplers[0].frame_M);
  const auto& attachments = run.model.attachments;
  EXPECT_EQ(in->read_matrix(at + "M/Phi_B"), attachments[index(M)].Phi_B);
  EXPECT_EQ(Vector3(in->read_matrix(at + "F/p_B").transpose()),
            attachments[index(F)].p_BF);
}

// Between outputs 5 ms apart: both sides of its jumps, which no output shows.
TEST(Scenery, LoadsJumpWhereTheirPulsesDo) {
  const Written in(make_loaded_run(
      dynamics::Pulse{dynamics::PulseShape::rectangular, 0.006, 0.002}));
  const MatrixX course = in->read_matrix("scene/loads/0000/course");
  double area = 0.0;
  int jumps = 0;
  for (Eigen::Index i = 1; i < course.rows(); ++i) {
    const double step = course(i, 0) - course(i - 1, 0);
    ASSERT_GE(step, 0.0);
    area += 0.5 * step * (course(i, 1) + course(i - 1, 1));
    if (course(i, 1) != course(i - 1, 1)) {
      EXPECT_EQ(step, 0.0);
      ++jumps;
    }
  }
  EXPECT_EQ(jumps, 2);
  EXPECT_NEAR(area, 0.002, 1e-12);
}

// The integral of a half sine; the trapezoidal rule on 16 parts misses 0.4 %.
TEST(Scenery, LoadsHaveTheShapeOfTheirPulses) {
  const Written in(make_loaded_run(
      dynamics::Pulse{dynamics::PulseShape::half_sine, 0.006, 0.002}));
  const MatrixX course = in->read_matrix("scene/loads/0000/course");
  double area = 0.0;
  for (Eigen::Index i = 1; i < course.rows(); ++i) {
    area += 0.5 * (course(i, 0) - course(i - 1, 0)) *
            (course(i, 1) + course(i - 1, 1));
  }
  EXPECT_NEAR(area / (0.004 / std::numbers::pi), 1.0, 0.005);
}

// Corners are stored in single precision, places in double.
TEST(Scenery, MeshesFarFromTheirOriginKeepTheirCorners) {
  SceneryShape shape;
  shape.name = "terrain";
  shape.form.kind = "mesh";
  shape.form.x.resize(3, 3);
  shape.form.x << 5e6, 5e6 + 0.3, 5e6, 3e5, 3e5, 3e5 + 0.2, 0.1, 0.0, 0.0;
  shape.form.corners = {0, 1, 2};
  shape.X_BS.p = {1.0, 2.0, 3.0};
  shape.X_BS.R =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitZ()).matrix();
  Scenery scenery;
  scenery.shapes = {shape};
  const Written in(make_small_run(), scenery);
  const Vector3 p = in->read_matrix("scene/shapes/0000/p_BS").row(0);
  const Matrix3X x = in->read_matrix("scene/shapes/0000/x");
  for (int i = 0; i < 3; ++i) {
    const Vector3 expected = shape.X_BS * Vector3(shape.form.x.col(i));
    const Vector3 found = p + shape.X_BS.R * x.col(i);
    EXPECT_LT((found - expected).norm(), 1e-7) << i;
  }
}

TEST(Scenery, ShapesKeepKindSizeAndPlace) {
  SceneryShape shape;
  shape.name = "hull";
  shape.body = BodyIndex(3);
  shape.form.kind = "capsule";
  shape.form.size = {0.1, 0.5, 0.0};
  shape.X_BS.p = {1.0, 2.0, 3.0};
  shape.X_BS.R =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitZ()).matrix();
  Scenery scenery;
  scenery.shapes = {shape};
  const Written in(make_small_run(), scenery);
  const std::string at = "scene/shapes/0000/";
  EXPECT_EQ(in->read_text(at + "body"), "ball");
  EXPECT_EQ(in->read_text(at + "kind"), "capsule");
  EXPECT_EQ(Vector3(in->read_matrix(at + "size").transpose()), shape.form.size);
  EXPECT_EQ(Vector3(in->read_matrix(at + "p_BS").transpose()), shape.X_BS.p);
  const double root = std::sqrt(0.5);
  EXPECT_LT((in->read_matrix(at + "quat_BS") -
             Eigen::RowVector4d(root, 0.0, 0.0, root))
                .norm(),
            1e-15);
}

TEST(Scenery, IsTheSameInEveryRun) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  const Scenery scenery;
  write_results(folder.path() / "a.h5", run.model, run.history, &scenery);
  write_results(folder.path() / "b.h5", run.model, run.history, &scenery);
  EXPECT_EQ(test::read_bytes(folder.path() / "a.h5"),
            test::read_bytes(folder.path() / "b.h5"));
}

}  // namespace
}  // namespace limber::results::scenery_test
