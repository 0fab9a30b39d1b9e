// SPDX-License-Identifier: BSD-3-Clause
// What a results file says about one moment agrees with itself.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "unit/results/written_run.hpp"

namespace limber::results::results_consistency_test {
namespace {

using test::kOutputs;
using test::make_small_run;
using test::SmallRun;
using test::TemporaryFolder;
using test::write_and_read;

// Kinetic energy and momenta as sums over moving point masses.
struct Sums {
  double kinetic = 0.0;
  Vector3 linear = Vector3::Zero();
  Vector3 angular = Vector3::Zero();
};

// A body's motion at one output as stored in the file.
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

}  // namespace
}  // namespace limber::results::results_consistency_test
