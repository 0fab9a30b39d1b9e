// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/results_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "unit/results/written_run.hpp"

namespace limber::results::results_file_test {
namespace {

using dynamics::BodyState;
using dynamics::EnergyBalance;
using dynamics::SystemState;
using test::kOutputs;
using test::make_empty_run;
using test::make_small_run;
using test::SmallRun;
using test::TemporaryFolder;
using test::write_and_read;
using ::testing::ElementsAreArray;

struct Expected {
  std::string unit;
  std::vector<std::uint64_t> shape;
};

// docs/reference/files.md, written out for the small run.
std::map<std::string, Expected> expect_numbers(std::uint64_t outputs,
                                               std::uint64_t events) {
  const std::uint64_t t = outputs;
  std::map<std::string, Expected> all = {
      {"time", {"s", {t, 1}}},
      {"events/time", {"s", {events, 1}}},
      {"events/rate", {"m/s or rad/s", {events, 1}}},
      {"version", {"1", {1}}},
      {"probes/tip.ux", {"m", {t, 1}}},
      {"probes/tip.wy", {"rad/s", {t, 1}}},
      {"momentum/linear", {"kg m/s", {t, 3}}},
      {"momentum/angular", {"kg m^2/s", {t, 3}}}};
  for (const char* part : {"kinetic_rigid", "kinetic_modal", "elastic",
                           "coupler", "dissipated", "work"}) {
    all[std::string("energy/") + part] = {"J", {t, 1}};
  }
  const std::map<std::string, std::uint64_t> modes = {
      {"arm", 3}, {"hand", 2}, {"plate", 0}, {"ball", 0}};
  for (const auto& [name, m] : modes) {
    const std::string at = "bodies/" + name + "/";
    all[at + "p_WB"] = {"m", {t, 3}};
    all[at + "quat_WB"] = {"1", {t, 4}};
    all[at + "v_WB_W"] = {"m/s", {t, 3}};
    all[at + "w_WB_B"] = {"rad/s", {t, 3}};
    all[at + "eta"] = {"kg^1/2 m", {t, m}};
    all[at + "etadot"] = {"kg^1/2 m/s", {t, m}};
  }
  return all;
}

const std::vector<std::string> kTexts = {"format",
                                         "events/source",
                                         "events/what",
                                         "bodies/arm/fidelity",
                                         "bodies/hand/fidelity",
                                         "bodies/plate/fidelity",
                                         "bodies/ball/fidelity"};

void check_layout(const SmallRun& run) {
  const auto expected =
      expect_numbers(run.history.times.size(), run.history.events.size());
  const auto all = write_and_read(run);
  std::set<std::string> names(kTexts.begin(), kTexts.end());
  for (const auto& [name, data] : expected) names.insert(name);
  std::set<std::string> found;
  for (const auto& [name, data] : all) found.insert(name);
  EXPECT_THAT(found, ElementsAreArray(names));
  for (const auto& [name, e] : expected) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(all.contains(name));
    EXPECT_EQ(all.at(name).shape, e.shape);
    ASSERT_TRUE(all.at(name).attributes.contains("unit"));
    EXPECT_EQ(all.at(name).attributes.at("unit"), e.unit);
  }
  for (const auto& [name, data] : all) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(data.attributes.contains("meaning"));
    EXPECT_NE(data.attributes.at("meaning"), "");
  }
}

// HDF5's time stamps count seconds.
TEST(ResultsFile, OfTheSameRunIsTheSameToTheByteAtAnyTime) {
  const TemporaryFolder folder;
  const SmallRun run = make_small_run();
  write_results(folder.path() / "a.h5", run.model, run.history);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_results(folder.path() / "b.h5", run.model, run.history);
  EXPECT_EQ(test::read_bytes(folder.path() / "a.h5"),
            test::read_bytes(folder.path() / "b.h5"));
}

TEST(ResultsFile, HoldsTheDocumentedDatasetsWithShapesAndUnits) {
  check_layout(make_small_run());
}

TEST(ResultsFile, HasTheSameDatasetsBeforeTheFirstOutput) {
  check_layout(make_empty_run());
}

// One row of a matrix in the file, bit by bit.
std::vector<std::uint64_t> bits(const VectorX& values) {
  std::vector<std::uint64_t> all;
  for (const double x : values) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

TEST(ResultsFile, StatesAreThoseOfTheRunToTheLastBit) {
  const SmallRun run = make_small_run();
  ASSERT_EQ(run.history.times.size(), kOutputs);
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "r.h5");
  const std::vector<std::string> names = {"arm", "hand", "plate", "ball"};
  const std::vector<int> offsets = {0, 3, 5, 5};
  const std::vector<int> modes = {3, 2, 0, 0};
  for (std::size_t b = 0; b < names.size(); ++b) {
    SCOPED_TRACE(names[b]);
    const auto row = [&](const char* what, int i) {
      return bits(in.read_matrix("bodies/" + names[b] + "/" + what).row(i));
    };
    for (int i = 0; i < kOutputs; ++i) {
      const SystemState& s = run.history.states[static_cast<std::size_t>(i)];
      const BodyState& body = s.bodies[b];
      const Quaternion& q = body.quat_WB;
      EXPECT_EQ(row("p_WB", i), bits(body.p_WB));
      EXPECT_EQ(row("quat_WB", i),
                bits(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())));
      EXPECT_EQ(row("v_WB_W", i), bits(body.v_WB_W));
      EXPECT_EQ(row("w_WB_B", i), bits(body.w_WB_B));
      EXPECT_EQ(row("eta", i), bits(s.eta.segment(offsets[b], modes[b])));
      EXPECT_EQ(row("etadot", i), bits(s.etadot.segment(offsets[b], modes[b])));
    }
  }
}

// Most of them are in the temporary file, and matrices have several parts.
TEST(ResultsFile, OfManyOutputsHasEachInItsRow) {
  SmallRun run = make_small_run();
  const History few = run.history;
  run.history = {};
  run.history.columns = few.columns;
  constexpr std::size_t kMany = 20001;
  for (std::size_t i = 0; i < kMany; ++i) {
    run.history.times.push_back(static_cast<double>(i));
    run.history.probe_rows.push_back(few.probe_rows[i % kOutputs]);
    run.history.states.push_back(few.states[i % kOutputs]);
    run.history.energies.push_back(few.energies[i % kOutputs]);
  }
  EXPECT_LT(run.history.states.held_bytes(), std::size_t{1} << 20);
  const TemporaryFolder folder;
  write_results(folder.path() / "few.h5", run.model, few);
  write_results(folder.path() / "many.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "few.h5");
  const Hdf5File many = Hdf5File::open(folder.path() / "many.h5");
  EXPECT_EQ(many.read_matrix("time")(kMany - 1, 0), kMany - 1.0);
  for (const char* name :
       {"bodies/arm/p_WB", "bodies/arm/quat_WB", "bodies/hand/etadot",
        "bodies/ball/w_WB_B", "probes/tip.wy", "energy/work",
        "momentum/angular"}) {
    const MatrixX expected = in.read_matrix(name);
    const MatrixX found = many.read_matrix(name);
    ASSERT_EQ(found.rows(), Eigen::Index{kMany});
    for (Eigen::Index i = 0; i < found.rows(); ++i) {
      ASSERT_EQ(found.row(i), expected.row(i % kOutputs)) << name << ' ' << i;
    }
  }
}

TEST(ResultsFile, ScalarsAreThoseOfTheRunToTheLastBit) {
  const SmallRun run = make_small_run();
  const auto all = write_and_read(run);
  using Balance = EnergyBalance;
  const std::map<std::string, double Balance::*> parts = {
      {"kinetic_rigid", &Balance::kinetic_rigid},
      {"kinetic_modal", &Balance::kinetic_modal},
      {"elastic", &Balance::elastic},
      {"coupler", &Balance::coupler},
      {"dissipated", &Balance::dissipated},
      {"work", &Balance::work}};
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (std::size_t i = 0; i < run.history.times.size(); ++i) {
    const EnergyBalance& e = run.history.energies[i];
    for (const auto& [name, part] : parts) {
      EXPECT_TRUE(same(all.at("energy/" + name).numbers.at(i), e.*part))
          << name;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      EXPECT_TRUE(same(all.at("momentum/linear").numbers.at(3 * i + a),
                       e.linear_momentum[axis]));
      EXPECT_TRUE(same(all.at("momentum/angular").numbers.at(3 * i + a),
                       e.angular_momentum[axis]));
    }
    EXPECT_TRUE(same(all.at("time").numbers.at(i), run.history.times[i]));
    EXPECT_TRUE(same(all.at("probes/tip.ux").numbers.at(i),
                     run.history.probe_rows[i][0]));
    EXPECT_TRUE(same(all.at("probes/tip.wy").numbers.at(i),
                     run.history.probe_rows[i][1]));
  }
}

TEST(ResultsFile, HasTheErrorsThatAreKnown) {
  SmallRun run = make_small_run();
  run.history.columns[1].error = 0.25;
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "r.h5");
  EXPECT_THAT(in.list("errors"), ElementsAreArray({"tip.wy"}));
  EXPECT_EQ(in.read_matrix("errors/tip.wy")(0, 0), 0.25);
  EXPECT_EQ(in.read_unit("errors/tip.wy"), "rad/s");
}

TEST(ResultsFile, NamesTheLevelOfEachBody) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "r.h5");
  EXPECT_EQ(in.read_text("bodies/arm/fidelity"), "coupled");
  EXPECT_EQ(in.read_text("bodies/plate/fidelity"), "rigid");
  EXPECT_EQ(in.read_text("bodies/ball/fidelity"), "rigid");
}

TEST(ResultsFile, HoldsEveryEvent) {
  SmallRun run = make_small_run();
  run.history.events = {{0.25, "push", "load edge", 0.0},
                        {0.5, "elbow\njoint", "stop reached", -1.5}};
  check_layout(run);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  const Hdf5File in = Hdf5File::open(file);
  EXPECT_EQ(in.read_matrix("events/time"), Eigen::Vector2d(0.25, 0.5));
  EXPECT_EQ(in.read_matrix("events/rate"), Eigen::Vector2d(0.0, -1.5));
  EXPECT_EQ(in.read_text("events/source"), "push\nelbow joint\n");
  EXPECT_EQ(in.read_text("events/what"), "load edge\nstop reached\n");
  EXPECT_EQ(read_contents(file).events, 2);
}

}  // namespace
}  // namespace limber::results::results_file_test
