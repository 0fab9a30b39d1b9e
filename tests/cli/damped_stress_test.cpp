// SPDX-License-Identifier: BSD-3-Clause
// Stress of a link with a loss factor, in linear models and exported results.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/damped_arm.hpp"
#include "cli/shell.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/types.hpp"
#include "places.hpp"

namespace limber::test::damped_stress_test {
namespace {

using nlohmann::json;

/// Frequency response of a linear model's output to its load.
std::complex<double> find_response(const json& model, const std::string& output,
                                   double omega) {
  const auto read = [&](const char* name) {
    const json& rows = model.at(name);
    MatrixX values(std::ssize(rows), std::ssize(rows.at(0)));
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      for (Eigen::Index j = 0; j < values.cols(); ++j) {
        values(i, j) = rows[std::size_t(i)][std::size_t(j)].get<double>();
      }
    }
    return values;
  };
  const std::vector<std::string> names = model.at("output_names");
  const auto row = std::find(names.begin(), names.end(), output);
  EXPECT_NE(row, names.end()) << output;
  const MatrixX A = read("A");
  Eigen::MatrixXcd pencil = -A.cast<std::complex<double>>();
  pencil.diagonal().array() += std::complex<double>(0.0, omega);
  const Eigen::VectorXcd x = pencil.partialPivLu().solve(
      read("B").col(0).cast<std::complex<double>>());
  return (read("C").row(row - names.begin()).cast<std::complex<double>>() * x)
      .value();
}

// Of a statically determinate link stress does not depend on stiffness; near
// the first mode it leads the deflection by about the loss angle, as higher
// modes lag less.
TEST(DampedStress, OfALinearModelIsThatOfTheRelaxedMaterial) {
  const Workspace place;
  const auto linearize = [&](const std::string& damping) {
    write_arm(place, {.holds = "clamp", .damping = damping});
    place.write("s.toml", read_text(place.folder() / "s.toml") +
                              "[[probe]]\nname = 's'\nlink = 'bar'\n"
                              "nearest = [0.1, 0.01, 0.004]\n"
                              "quantity = 'stress'\n");
    const CommandResult r = place.limber("linearize s.toml -o lin.json");
    EXPECT_EQ(r.status, 0) << r.errors;
    return json::parse(read_text(place.folder() / "lin.json"));
  };
  const json elastic = linearize("ratio='1e-6'");
  const json damped = linearize("ratio='0.1'");
  const double still = find_response(elastic, "s.sxx", 0.0).real();
  EXPECT_NEAR(find_response(damped, "s.sxx", 0.0).real() / still, 1.0, 1e-5);
  const double first =
      2.0 * std::numbers::pi * frequency_of(find_modes(place).at(0));
  const std::complex<double> angle =
      find_response(damped, "s.sxx", 0.9 * first) /
      find_response(damped, "t.uz", 0.9 * first);
  EXPECT_NEAR(std::abs(angle.imag() / angle.real()), 0.2, 0.05);
}

TEST(DampedStress, OfExportedResultsIsThatOfTheRun) {
  const Workspace place;
  write_arm(place, {.damping = "ratio='0.1'", .duration = 0.03});
  place.write("s.toml", read_text(place.folder() / "s.toml") +
                            "stress = true\n[[probe]]\nname = 's'\n"
                            "link = 'bar'\nquantity = 'von_mises'\n");
  ASSERT_EQ(place.limber("run s.toml --out o --xdmf").status, 0);
  ASSERT_EQ(place.limber("export o -o m.xdmf").status, 0);
  const Hdf5File run = Hdf5File::open(place.folder() / "o" / "motion.h5");
  const Hdf5File exported = Hdf5File::open(place.folder() / "m.h5");
  for (const char* step : {"000010", "000030", "000050"}) {
    const std::string at = std::string("steps/") + step + "/stress";
    const MatrixX stress = run.read_matrix(at);
    EXPECT_GT(stress.norm(), 1.0);
    EXPECT_LT((exported.read_matrix(at) - stress).norm(), 1e-4 * stress.norm())
        << step;
  }
}

}  // namespace
}  // namespace limber::test::damped_stress_test
