// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/xdmf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/results/offset.hpp"
#include "raw_hdf5.hpp"
#include "small_run.hpp"
#include "temporary_folder.hpp"
#include "xml_element.hpp"

namespace limber::results::xdmf_test {
namespace {

using test::find_children;
using test::find_input_error;
using test::kOutputs;
using test::make_empty_run;
using test::make_small_run;
using test::RawDataset;
using test::SmallRun;
using test::TemporaryFolder;
using test::XmlElement;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Rows of the three bodies that have a mesh: arm, hand, plate.
constexpr std::uint64_t kNodes = 24 + 15 + 10;
constexpr std::uint64_t kTriangles = 3 + 1 + 2;

struct Written {
  XmlElement root;
  std::map<std::string, RawDataset> data;
};

Written write_and_read(const SmallRun& run, const std::string& name = "m") {
  const TemporaryFolder folder;
  EXPECT_THAT(
      write_xdmf(folder.path() / (name + ".xdmf"), run.model, run.history),
      ::testing::IsEmpty());
  return {test::parse_xml(test::read_bytes(folder.path() / (name + ".xdmf"))),
          test::read_all_datasets(folder.path() / (name + ".h5"))};
}

// The grid that holds one grid an output time.
XmlElement find_collection(const Written& written) {
  EXPECT_EQ(written.root.tag, "Xdmf");
  const auto domains = find_children(written.root, "Domain");
  EXPECT_THAT(domains, SizeIs(1));
  const auto grids = find_children(domains.at(0), "Grid");
  EXPECT_THAT(grids, SizeIs(1));
  EXPECT_EQ(grids.at(0).attributes.at("GridType"), "Collection");
  EXPECT_EQ(grids.at(0).attributes.at("CollectionType"), "Temporal");
  return grids.at(0);
}

std::string spell(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t n : shape) {
    text += (text.empty() ? "" : " ") + std::to_string(n);
  }
  return text;
}

// The dataset that the one item inside `element` points to, which must be as
// the item says.
const RawDataset& follow(const Written& written, const XmlElement& element) {
  const auto items = find_children(element, "DataItem");
  EXPECT_THAT(items, SizeIs(1));
  const XmlElement& item = items.at(0);
  EXPECT_EQ(item.attributes.at("Format"), "HDF");
  EXPECT_EQ(item.attributes.at("Precision"), "8");
  const std::string start = "m.h5:/";
  EXPECT_EQ(item.text.substr(0, start.size()), start);
  const RawDataset& data = written.data.at(item.text.substr(start.size()));
  EXPECT_EQ(item.attributes.at("Dimensions"), spell(data.shape));
  const bool is_float = item.attributes.at("NumberType") == "Float";
  EXPECT_EQ(is_float, !data.numbers.empty());
  EXPECT_EQ(!is_float, !data.integers.empty());
  return data;
}

TEST(Xdmf, HasOneGridAnOutputTime) {
  const SmallRun run = make_small_run();
  const Written written = write_and_read(run);
  const auto grids = find_children(find_collection(written), "Grid");
  ASSERT_THAT(grids, SizeIs(kOutputs));
  for (std::size_t i = 0; i < grids.size(); ++i) {
    EXPECT_EQ(grids[i].attributes.at("GridType"), "Uniform");
    const auto times = find_children(grids[i], "Time");
    ASSERT_THAT(times, SizeIs(1));
    EXPECT_EQ(std::strtod(times[0].attributes.at("Value").c_str(), nullptr),
              run.history.times[i]);
  }
}

// Far away: relative to an offset, so that readers in single precision see the
// motion.
TEST(Xdmf, PointsFarAwayAreThoseNearTheOriginFromAnOffset) {
  const SmallRun near = make_small_run();
  SmallRun far = make_small_run();
  const Vector3 place(1e7, 0.0, -2e6);
  test::move_bodies(far.history, place);
  const Written here = write_and_read(near);
  const Written there = write_and_read(far);
  EXPECT_THAT(here.data.at("offset").numbers, ElementsAre(0.0, 0.0, 0.0));
  EXPECT_THAT(there.data.at("offset").numbers, ElementsAre(1e7, 0.0, -2e6));
  const auto notes =
      find_children(find_children(there.root, "Domain").at(0), "Information");
  ASSERT_THAT(notes, SizeIs(1));
  EXPECT_EQ(notes[0].attributes.at("Name"), "offset");
  EXPECT_EQ(notes[0].attributes.at("Value"), "10000000 0 -2000000");
  const double rounding = 0x1p-52 * 1e7;  // of the states themselves [m]
  for (const char* name : {"points", "displacement"}) {
    const std::string at = std::string("steps/000004/") + name;
    const auto& expected = here.data.at(at).numbers;
    const auto& found = there.data.at(at).numbers;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], rounding) << at << ' ' << i;
    }
  }
}

TEST(Xdmf, TrianglesAreTheBodiesOwnCountedOn) {
  const Written written = write_and_read(make_small_run());
  for (const XmlElement& grid :
       find_children(find_collection(written), "Grid")) {
    const auto topologies = find_children(grid, "Topology");
    ASSERT_THAT(topologies, SizeIs(1));
    EXPECT_EQ(topologies[0].attributes.at("TopologyType"), "Triangle");
    EXPECT_EQ(topologies[0].attributes.at("NumberOfElements"),
              std::to_string(kTriangles));
    const RawDataset& triangles = follow(written, topologies[0]);
    EXPECT_THAT(triangles.shape, ElementsAre(kTriangles, 3));
    EXPECT_THAT(triangles.integers,
                ::testing::Each(::testing::AllOf(
                    ::testing::Ge(0),
                    ::testing::Lt(static_cast<std::int64_t>(kNodes)))));
    // The hand's nodes follow the arm's 24, the plate's the hand's 15.
    EXPECT_THAT(
        triangles.integers,
        ElementsAre(0, 1, 2, 3, 4, 5, 23, 22, 21, 24 + 14, 24 + 0, 24 + 7,
                    39 + 9, 39 + 8, 39 + 7, 39 + 1, 39 + 0, 39 + 9));
  }
}

// u = Phi eta in the body frame, one node after the other, term by term.
std::vector<Vector3> find_displacements(const testing::PointMassBody& body,
                                        const std::vector<double>& eta) {
  std::vector<Vector3> all;
  const MatrixX& Phi = body.reduced.rows.Phi_B;
  for (Eigen::Index i = 0; i < body.masses.size(); ++i) {
    Vector3 u = Vector3::Zero();
    for (std::size_t k = 0; k < eta.size(); ++k) {
      for (Eigen::Index a = 0; a < 3; ++a) {
        u[a] += Phi(3 * i + a, static_cast<Eigen::Index>(k)) * eta[k];
      }
    }
    all.push_back(u);
  }
  return all;
}

// Rodrigues' form of the rotation by a unit quaternion (w, r).
Vector3 rotate(const Quaternion& quat, const Vector3& x) {
  const Vector3 r = quat.vec();
  return x + 2.0 * quat.w() * r.cross(x) + 2.0 * r.cross(r.cross(x));
}

constexpr double kRoundoff = 1e-14;  // positions are of order 1 m

TEST(Xdmf, PointsAreTheDeformedBodiesInTheWorld) {
  const SmallRun run = make_small_run();
  const Written written = write_and_read(run);
  const auto grids = find_children(find_collection(written), "Grid");
  ASSERT_THAT(grids, SizeIs(kOutputs));
  const std::vector<std::size_t> first_mode = {0, 3, 5};
  const std::vector<std::size_t> modes = {3, 2, 0};  // the plate is rigid
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto geometries = find_children(grids[i], "Geometry");
    const auto attributes = find_children(grids[i], "Attribute");
    ASSERT_THAT(geometries, SizeIs(1));
    ASSERT_THAT(attributes, SizeIs(3));
    EXPECT_EQ(geometries[0].attributes.at("GeometryType"), "XYZ");
    EXPECT_EQ(attributes[0].attributes.at("Name"), "deformation");
    EXPECT_EQ(attributes[0].attributes.at("Center"), "Node");
    const RawDataset& points = follow(written, geometries[0]);
    const RawDataset& deformation = follow(written, attributes[0]);
    ASSERT_THAT(points.shape, ElementsAre(kNodes, 3));
    ASSERT_THAT(deformation.shape, ElementsAre(kNodes));
    EXPECT_EQ(attributes[1].attributes.at("Name"), "deformation_vector");
    EXPECT_EQ(attributes[2].attributes.at("Name"), "displacement");
    const RawDataset& bending = follow(written, attributes[1]);
    const RawDataset& displacement = follow(written, attributes[2]);
    const RawDataset& start =
        follow(written, find_children(grids[0], "Geometry")[0]);
    ASSERT_THAT(bending.shape, ElementsAre(kNodes, 3));
    ASSERT_THAT(displacement.shape, ElementsAre(kNodes, 3));
    const dynamics::SystemState& state = run.history.states[i];
    std::size_t row = 0;
    double largest = 0.0;
    for (std::size_t b = 0; b < 3; ++b) {
      const auto begin =
          state.eta.begin() + static_cast<Eigen::Index>(first_mode[b]);
      const std::vector<double> eta(
          begin, begin + static_cast<Eigen::Index>(modes[b]));
      const auto u = find_displacements(run.points[b], eta);
      for (std::size_t n = 0; n < u.size(); ++n, ++row) {
        const Vector3 x =
            run.points[b].reduced.rows.x_B.col(static_cast<Eigen::Index>(n));
        const Vector3 expected =
            state.bodies[b].p_WB + rotate(state.bodies[b].quat_WB, x + u[n]);
        const Eigen::Map<const Vector3> point(points.numbers.data() + 3 * row);
        EXPECT_LT((point - expected).norm(), kRoundoff)
            << "output " << i << ", body " << b << ", node " << n;
        EXPECT_NEAR(deformation.numbers[row], u[n].norm(), kRoundoff);
        const auto take = [row](const RawDataset& values) {
          return Vector3(values.numbers.data() + 3 * row);
        };
        EXPECT_LT(
            (take(bending) - rotate(state.bodies[b].quat_WB, u[n])).norm(),
            kRoundoff);
        EXPECT_LT((take(displacement) - (expected - take(start))).norm(),
                  kRoundoff);
        largest = std::max(largest, u[n].norm());
      }
    }
    EXPECT_EQ(row, kNodes);
    EXPECT_GT(largest, 1e-3);
  }
}

TEST(Xdmf, DataCarryTheirUnitsAndMeaning) {
  const Written written = write_and_read(make_small_run());
  ASSERT_THAT(written.data, SizeIs(2 + 4 * kOutputs));
  for (const auto& [name, data] : written.data) {
    EXPECT_EQ(data.attributes.at("unit"), name == "triangles" ? "1" : "m");
    EXPECT_NE(data.attributes.at("meaning"), "") << name;
  }
}

TEST(Xdmf, ARunWithoutOutputsHasNoGrid) {
  const Written written = write_and_read(make_empty_run());
  EXPECT_THAT(find_children(find_collection(written), "Grid"), SizeIs(0));
}

TEST(Xdmf, FileNameWithMarkupStaysWellFormed) {
  const SmallRun run = make_small_run();
  const std::string name = "a & <b> 'c' \"d\" Träger";
  const Written written = write_and_read(run, name);
  const auto grids = find_children(find_collection(written), "Grid");
  ASSERT_THAT(grids, SizeIs(kOutputs));
  const XmlElement item =
      find_children(find_children(grids[0], "Topology").at(0), "DataItem")
          .at(0);
  EXPECT_EQ(item.text, name + ".h5:/triangles");
}

TEST(Xdmf, RefusesFileNamesThatItCannotHoldBeforeItWrites) {
  const SmallRun run = make_small_run();
  for (const char* name :
       {"run 10:30", "a|b", " lead", "bad\xff", "line\nbreak", ":"}) {
    const TemporaryFolder folder;
    const std::filesystem::path file =
        folder.path() / (std::string(name) + ".xdmf");
    EXPECT_THROW((void)write_xdmf(file, run.model, run.history), InputError)
        << name;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << name;
  }
}

// Folders are not part of the name of the data beside the file.
TEST(Xdmf, IsWrittenInAFolderOfAnyName) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  const std::filesystem::path inner = folder.path() / " 10:30 | \xff";
  std::filesystem::create_directory(inner);
  EXPECT_THAT(write_xdmf(inner / "a.xdmf", run.model, run.history), SizeIs(0));
  EXPECT_TRUE(std::filesystem::exists(inner / "a.h5"));
}

TEST(Xdmf, SystemWithoutAMeshIsAnInputError) {
  dynamics::SystemBuilder builder;
  builder.add_rigid_body("ball", {2.0, Matrix3::Identity()});
  const dynamics::SystemModel model = builder.build();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "motion.xdmf";
  EXPECT_THAT(write_xdmf(file, model, {}),
              ElementsAre(HasSubstr("no motion.xdmf: no body has a mesh")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Xdmf, TellsOfBodiesWhoseSurfaceWasNotKept) {
  SmallRun run = make_small_run();
  auto bare = *run.model.bodies[0].reduced;
  bare.triangles.clear();
  run.model.bodies[0].reduced =
      std::make_shared<const flexbody::ReducedBody>(bare);
  const TemporaryFolder folder;
  const auto file = folder.path() / "motion.xdmf";
  EXPECT_THAT(write_xdmf(file, run.model, run.history),
              ElementsAre(::testing::AllOf(HasSubstr("without 'arm'"),
                                           HasSubstr("rows=\"boundary\""))));
  const auto data = test::read_all_datasets(folder.path() / "motion.h5");
  EXPECT_EQ(data.at("triangles").shape.at(0), kTriangles - 3);
  EXPECT_EQ(data.count("steps/000000/stress"), 0U);
}

// Stress modes at rows in the order of the body's: sigma = Sigma_B eta, turned
// by R sigma R^T, in XDMF's order xx, xy, xz, yy, yz, zz.
TEST(Xdmf, StressIsThatOfTheModesInTheWorld) {
  SmallRun run = make_small_run();
  auto stressed = *run.model.bodies[0].reduced;
  const auto n = std::ssize(stressed.rows.tags);
  flexbody::StressModes modes;
  for (std::size_t i = 0; i < stressed.rows.tags.size(); ++i) {
    modes.rows.push_back(i);
    modes.materials.push_back(0);
    modes.on_surface.push_back(1);
  }
  modes.Sigma_B.resize(6 * n, stressed.mode_count());
  for (Eigen::Index i = 0; i < modes.Sigma_B.size(); ++i) {
    modes.Sigma_B.data()[i] = std::sin(0.7 * static_cast<double>(i));
  }
  stressed.stress = modes;
  run.model.bodies[0].reduced =
      std::make_shared<const flexbody::ReducedBody>(stressed);
  const TemporaryFolder folder;
  ASSERT_TRUE(
      write_xdmf(folder.path() / "m.xdmf", run.model, run.history).empty());
  const auto data = test::read_all_datasets(folder.path() / "m.h5");
  const auto& state = run.history.states[2];
  const auto& found = data.at("steps/000002/stress");
  const auto& mises = data.at("steps/000002/von_mises");
  ASSERT_THAT(found.shape, ElementsAre(kNodes, 6));
  const Matrix3 R = state.bodies[0].quat_WB.toRotationMatrix();
  const VectorX all = modes.Sigma_B * state.eta.head(stressed.mode_count());
  const std::size_t node = 7;
  const Vector6 s = all.segment<6>(6 * node);
  Matrix3 t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  t = R * t * R.transpose();
  const double wanted[] = {t(0, 0), t(0, 1), t(0, 2),
                           t(1, 1), t(1, 2), t(2, 2)};
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(found.numbers[6 * node + c], wanted[c], 1e-12 * s.norm());
  }
  const Matrix3 deviator = t - t.trace() / 3.0 * Matrix3::Identity();
  EXPECT_NEAR(mises.numbers[node], std::sqrt(1.5) * deviator.norm(),
              1e-12 * s.norm());
  EXPECT_TRUE(std::isnan(mises.numbers[24]));  // of a body without stress
}

TEST(Xdmf, PlaceThatCannotBeWrittenIsNamed) {
  const SmallRun run = make_empty_run();
  const TemporaryFolder folder;
  EXPECT_THAT(find_input_error([&] {
                (void)write_xdmf(folder.path() / "no_such/motion.xdmf",
                                 run.model, run.history);
              }),
              HasSubstr((folder.path() / "no_such/motion").string()));
  // The data can be written, but a folder stands where the text should be.
  std::filesystem::create_directory(folder.path() / "motion.xdmf");
  EXPECT_THAT(find_input_error([&] {
                (void)write_xdmf(folder.path() / "motion.xdmf", run.model,
                                 run.history);
              }),
              HasSubstr((folder.path() / "motion.xdmf").string()));
}

}  // namespace
}  // namespace limber::results::xdmf_test
