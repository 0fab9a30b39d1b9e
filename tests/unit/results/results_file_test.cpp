// SPDX-License-Identifier: BSD-3-Clause
#include "results/results_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <thread>

#include "common/hdf5_file.hpp"
#include "flexbody/body_file.hpp"
#include "raw_hdf5.hpp"
#include "small_run.hpp"
#include "temporary_folder.hpp"

namespace limber::results {
namespace {

using dynamics::BodyState;
using dynamics::EnergyBalance;
using dynamics::SystemState;
using test::find_input_error;
using test::kOutputs;
using test::make_empty_run;
using test::make_small_run;
using test::RawDataset;
using test::SmallRun;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

struct Expected {
  std::string unit;
  std::vector<std::uint64_t> shape;
};

// docs/formats/files.md, written out for the small run.
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

std::map<std::string, RawDataset> write_and_read(const SmallRun& run) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "results.h5";
  write_results(file, run.model, run.history);
  return test::read_all_datasets(file);
}

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

TEST(ResultsFile, NamesTheLevelOfEachBody) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "r.h5");
  EXPECT_EQ(in.read_text("bodies/arm/fidelity"), "coupled");
  EXPECT_EQ(in.read_text("bodies/plate/fidelity"), "rigid");
  EXPECT_EQ(in.read_text("bodies/ball/fidelity"), "rigid");
}

// --- What the file says about one moment agrees with itself -----------------

// Kinetic energy and momenta as sums over moving point masses.
struct Sums {
  double kinetic = 0.0;
  Vector3 linear = Vector3::Zero();
  Vector3 angular = Vector3::Zero();
};

// A body's motion at one output as the file tells it.
struct Motion {
  Vector3 p, v, w;
  Matrix3 R;
  VectorX eta, etadot;
};

Motion read_motion(const Hdf5File& in, const std::string& name, int i) {
  const auto row = [&](const char* what) -> VectorX {
    return in.read_matrix("bodies/" + name + "/" + what).row(i);
  };
  const VectorX q = row("quat_WB");
  return {row("p_WB"),   row("v_WB_W"),
          row("w_WB_B"), Quaternion(q[0], q[1], q[2], q[3]).toRotationMatrix(),
          row("eta"),    row("etadot")};
}

void add_masses(const testing::PointMassBody& body, const Motion& motion,
                Sums& sums) {
  const auto m = motion.eta.size();
  for (Eigen::Index i = 0; i < body.masses.size(); ++i) {
    const MatrixX Phi = body.reduced.rows.Phi_B.block(3 * i, 0, 3, m);
    const Vector3 x = body.reduced.rows.x_B.col(i) + Phi * motion.eta;
    const Vector3 p = motion.p + motion.R * x;
    const Vector3 v =
        motion.v + motion.R * (motion.w.cross(x) + Phi * motion.etadot);
    sums.kinetic += 0.5 * body.masses[i] * v.squaredNorm();
    sums.linear += body.masses[i] * v;
    sums.angular += body.masses[i] * p.cross(v);
  }
}

void add_ball(const Motion& motion, Sums& sums) {
  const double mass = 2.0;
  const Vector3 spin = Vector3(1, 2, 3).cwiseProduct(motion.w);
  sums.kinetic +=
      0.5 * mass * motion.v.squaredNorm() + 0.5 * motion.w.dot(spin);
  sums.linear += mass * motion.v;
  sums.angular += mass * motion.p.cross(motion.v) + motion.R * spin;
}

// Sums of some fifty terms, each known to a few units in the last place.
constexpr double kRoundoff = 1e-13;

TEST(ResultsFile, KineticEnergyAndMomentaAreThoseOfTheMovingMasses) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  const Hdf5File in = Hdf5File::open(folder.path() / "r.h5");
  const std::vector<std::string> names = {"arm", "hand", "plate"};
  for (int i = 0; i < kOutputs; ++i) {
    Sums sums;
    for (std::size_t b = 0; b < names.size(); ++b) {
      add_masses(run.points[b], read_motion(in, names[b], i), sums);
    }
    add_ball(read_motion(in, "ball", i), sums);
    const double kinetic = in.read_matrix("energy/kinetic_rigid")(i, 0) +
                           in.read_matrix("energy/kinetic_modal")(i, 0);
    const Vector3 linear = in.read_matrix("momentum/linear").row(i);
    const Vector3 angular = in.read_matrix("momentum/angular").row(i);
    EXPECT_GT(sums.kinetic, 1.0);
    EXPECT_NEAR(kinetic, sums.kinetic, kRoundoff * sums.kinetic);
    EXPECT_GT(sums.linear.norm(), 0.1);
    EXPECT_LT((linear - sums.linear).norm(), 10 * kRoundoff);
    EXPECT_GT(sums.angular.norm(), 0.1);
    EXPECT_LT((angular - sums.angular).norm(), 10 * kRoundoff);
  }
}

TEST(ResultsFile, ElasticEnergyIsThatOfTheModalSprings) {
  const SmallRun run = make_small_run();
  const auto all = write_and_read(run);
  for (std::size_t i = 0; i < kOutputs; ++i) {
    double expected = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {  // 60 rad/s times 1, 1.5, 2
      const double omega = 60.0 * (1.0 + 0.5 * static_cast<double>(k));
      const double eta = all.at("bodies/arm/eta").numbers.at(3 * i + k);
      expected += 0.5 * omega * omega * eta * eta;
    }
    for (std::size_t k = 0; k < 2; ++k) {  // 80 rad/s times 1, 1.5
      const double omega = 80.0 * (1.0 + 0.5 * static_cast<double>(k));
      const double eta = all.at("bodies/hand/eta").numbers.at(2 * i + k);
      expected += 0.5 * omega * omega * eta * eta;
    }
    EXPECT_GT(expected, 1e-3);
    EXPECT_NEAR(all.at("energy/elastic").numbers.at(i), expected,
                kRoundoff * expected);
  }
}

// Gravity's work is weight times the descent of the centre of mass, and what
// is not stored was dissipated; both to the integrator's error.
TEST(ResultsFile, WorkAndDissipationBalanceWhatIsStored) {
  const auto all = write_and_read(make_small_run());
  const auto energy = [&](const char* part, std::size_t i) {
    return all.at(std::string("energy/") + part).numbers.at(i);
  };
  const auto stored = [&](std::size_t i) {
    return energy("kinetic_rigid", i) + energy("kinetic_modal", i) +
           energy("elastic", i) + energy("coupler", i);
  };
  const std::size_t last = kOutputs - 1;
  const Vector3 gravity(0.3, 0.0, -9.81);
  const std::map<std::string, double> masses = {
      {"arm", 4.0}, {"hand", 3.0}, {"plate", 1.0}, {"ball", 2.0}};
  double work = 0.0;
  for (const auto& [name, mass] : masses) {
    const auto& p = all.at("bodies/" + name + "/p_WB").numbers;
    for (std::size_t a = 0; a < 3; ++a) {
      work += mass * gravity[static_cast<Eigen::Index>(a)] *
              (p.at(3 * last + a) - p.at(a));
    }
  }
  const double discretisation = 1e-3;  // of what flows; (omega h)^2 is 2e-4
  EXPECT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(energy("work", last), work, discretisation * std::abs(work));
  EXPECT_GT(energy("dissipated", last), 0.01);
  EXPECT_NEAR(stored(last) - stored(0),
              energy("work", last) - energy("dissipated", last),
              discretisation * (energy("dissipated", last) + std::abs(work)));
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

// --- What it is -------------------------------------------------------------

TEST(ResultsFile, ContentsTellTimesBodiesAndProbes) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_TRUE(is_results_file(file));
  const ResultsContents contents = read_contents(file);
  EXPECT_EQ(contents.outputs, kOutputs);
  EXPECT_EQ(contents.start, 0.0);
  EXPECT_EQ(contents.end, run.history.times.back());
  EXPECT_THAT(contents.bodies,
              UnorderedElementsAre("arm", "hand", "plate", "ball"));
  EXPECT_THAT(contents.probes, UnorderedElementsAre("tip.ux", "tip.wy"));
}

TEST(ResultsFile, ContentsOfARunWithoutOutputsNameBodiesAndProbes) {
  const SmallRun run = make_empty_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_TRUE(is_results_file(file));
  const ResultsContents contents = read_contents(file);
  EXPECT_EQ(contents.outputs, 0);
  EXPECT_EQ(contents.start, 0.0);
  EXPECT_EQ(contents.end, 0.0);
  EXPECT_THAT(contents.bodies,
              UnorderedElementsAre("arm", "hand", "plate", "ball"));
  EXPECT_THAT(contents.probes, UnorderedElementsAre("tip.ux", "tip.wy"));
}

TEST(ResultsFile, RunWithoutProbesHasNone) {
  SmallRun run = make_small_run();
  run.history.columns.clear();
  for (auto& row : run.history.probe_rows) row.clear();
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  EXPECT_THAT(read_contents(folder.path() / "r.h5").probes, IsEmpty());
}

TEST(ResultsFile, ReducedBodyIsNoResultsFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "body.h5";
  flexbody::write_body(make_empty_run().points[0].reduced, file);
  EXPECT_FALSE(is_results_file(file));
  EXPECT_THAT(find_input_error([&] { (void)read_contents(file); }),
              HasSubstr(file.string()));
}

TEST(ResultsFile, TextIsRefusedWithTheFilesName) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "notes.h5";
  std::ofstream(file) << "limber results\n";
  EXPECT_THAT(find_input_error([&] { (void)is_results_file(file); }),
              HasSubstr(file.string()));
  EXPECT_THAT(find_input_error([&] { (void)read_contents(file); }),
              HasSubstr(file.string()));
}

TEST(ResultsFile, FileWithoutTimesIsDamaged) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  Hdf5File out = Hdf5File::create(file);
  out.write("format", "limber results", "what this file is");
  out.close();
  EXPECT_TRUE(is_results_file(file));
  const std::string why = find_input_error([&] { (void)read_contents(file); });
  EXPECT_THAT(why, HasSubstr(file.string()));
  EXPECT_THAT(why, HasSubstr("time"));
}

TEST(ResultsFile, PlaceThatCannotBeWrittenIsNamed) {
  const SmallRun run = make_empty_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "no_such/results.h5";
  EXPECT_THAT(
      find_input_error([&] { write_results(file, run.model, run.history); }),
      HasSubstr(file.string()));
}

// --- Names ------------------------------------------------------------------

TEST(ResultsFile, AnyNameOfABodyComesBack) {
  const std::vector<std::string> names = {"left/arm", "upper arm", "Träger 梁",
                                          "."};
  const SmallRun run = make_small_run({names[0], names[1], names[2], names[3]});
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(read_contents(file).bodies,
              ::testing::UnorderedElementsAreArray(names));
  // One group a body: nothing but the bodies is in "bodies", and each has its
  // seven datasets directly inside.
  const Hdf5File in = Hdf5File::open(file);
  for (const std::string& group : in.list("bodies")) {
    EXPECT_EQ(in.list("bodies/" + group).size(), 7U) << group;
  }
}

TEST(ResultsFile, NamesThatDifferOnlyInOddCharactersStayApart) {
  const std::vector<std::string> names = {"a/b", "a%2Fb", "a_b", "a%252Fb"};
  const SmallRun run = make_small_run({names[0], names[1], names[2], names[3]});
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(read_contents(file).bodies,
              ::testing::UnorderedElementsAreArray(names));
}

TEST(ResultsFile, AnyNameOfAProbeComesBackWithItsValues) {
  SmallRun run = make_small_run();
  run.history.columns[0].name = "left/tip of Träger 梁.ux";
  run.history.columns[1].name = "left/tip of Träger 梁.uy";
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(
      read_contents(file).probes,
      ElementsAre("left/tip of Träger 梁.ux", "left/tip of Träger 梁.uy"));
  const Hdf5File in = Hdf5File::open(file);
  const std::vector<std::string> sets = in.list("probes");
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(in.read_matrix("probes/" + sets[1])(3, 0),
            run.history.probe_rows[3][1]);
}

}  // namespace
}  // namespace limber::results
