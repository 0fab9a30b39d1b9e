// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "support/temporary_folder.hpp"

/// Free bodies whose frequencies are known without finite elements. The error
/// of an eigenvalue on elements of order p falls as h^(2p) (Strang, Fix, An
/// Analysis of the Finite Element Method, ch. 6), and from above.
namespace limber::body_closed_forms_slow {
namespace {

const fem::ElasticMaterial kSteel{210e9, 0.3, 7850.0};

std::filesystem::path write_geo(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::filesystem::path file =
      limber::test::own_folder() /
      fmt::format("limber_{}_{}.geo", test->test_suite_name(), test->name());
  std::ofstream(file) << text;
  return file;
}

struct Spectrum {
  std::vector<double> hz;  ///< elastic frequencies [Hz]
  double nodes = 0.0;
};

Spectrum find_spectrum(const std::string& geo, const fem::MeshOptions& options,
                       int count) {
  const fem::Mesh mesh = fem::read_mesh(write_geo(geo), options);
  const auto matrices = fem::assemble(mesh, {kSteel});
  const MatrixX R = fem::make_rigid_modes(matrices.M_s, mesh.x);
  const fem::ElasticInverse inverse(matrices, R, mesh.x);
  const fem::Eigenmodes modes = fem::find_eigenmodes(inverse, count);
  Spectrum spectrum;
  for (const double lambda : modes.lambda)
    spectrum.hz.push_back(std::sqrt(lambda) / (2.0 * std::numbers::pi));
  spectrum.nodes = static_cast<double>(mesh.node_count());
  return spectrum;
}

/// A box of n0 x n1 x n2 hexahedra.
std::string box_geo(const Vector3& size, int n0, int n1, int n2) {
  return fmt::format(
      "Point(1) = {{0, 0, 0}};\n"
      "l[] = Extrude {{{}, 0, 0}} {{ Point{{1}}; Layers{{{}}}; }};\n"
      "s[] = Extrude {{0, {}, 0}} {{ Line{{l[1]}}; Layers{{{}}}; "
      "Recombine; }};\n"
      "b[] = Extrude {{0, 0, {}}} {{ Surface{{s[1]}}; Layers{{{}}}; Recombine; "
      "}};\n",
      size[0], n0, size[1], n1, size[2], n2);
}

struct Errors {
  double least = 0.0;  ///< signed, relative to the figure
  double largest = 0.0;
};

Errors compare(const std::vector<double>& found,
               const std::vector<double>& figures) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < figures.size(); ++i)
    errors.push_back(found.at(i) / figures[i] - 1.0);
  const auto [least, largest] =
      std::minmax_element(errors.begin(), errors.end());
  return {*least, *largest};
}

double rate(double coarse_error, double fine_error, double refinement) {
  return std::log(coarse_error / fine_error) / std::log(refinement);
}

/// Two meshes of one order, and what their errors must show.
struct Study {
  int order;
  int coarse, fine;   ///< cells along the shortest edge
  double least_rate;  ///< at which the largest error falls
  double error;       ///< allowed on the fine mesh, relative
};

/// On a box the rate of orders 2 and 3 is 4 less a logarithm: where edges meet
/// a cross-section, warping goes as r^2 log r. Between 4 and 8 cells
/// h^4 log(1/h) falls as h^3.4.
constexpr double kCornerRate = 3.4;

void expect_convergence(const Vector3& size, const std::array<int, 3>& cells,
                        const Study& study, const std::vector<double>& figures,
                        double digits) {
  SCOPED_TRACE(fmt::format("order {}", study.order));
  const auto errors_on = [&](int n) {
    const std::string geo =
        box_geo(size, cells[0] * n, cells[1] * n, cells[2] * n);
    const auto spectrum = find_spectrum(geo, {.order = study.order},
                                        static_cast<int>(figures.size()));
    return compare(spectrum.hz, figures);
  };
  const Errors coarse = errors_on(study.coarse);
  const Errors fine = errors_on(study.fine);
  const double refinement = static_cast<double>(study.fine) / study.coarse;
  EXPECT_GT(rate(coarse.largest, fine.largest, refinement), study.least_rate);
  EXPECT_LT(fine.largest, study.error);
  EXPECT_GT(fine.least, -digits);  // from above
}

/// Ritz solution in polynomials of the free elastic box, method of Visscher,
/// Migliori, Bell and Reinert, J. Acoust. Soc. Am. 90 (1991) 2154;
/// 0.3 x 0.2 x 0.1 m, converged to about 1e-4 [Hz].
const std::vector<double> kBox{3866.19,  4503.67,  6307.11,  7630.61,
                               8283.19,  8363.46,  8650.94,  8945.76,
                               10196.79, 11236.06, 11325.11, 11347.12};
constexpr double kBoxDigits = 1e-4;

TEST(FreeBox, FrequenciesConvergeToTheRitzSolution) {
  for (const Study& study :
       {Study{1, 6, 12, 1.9, 1e-2}, Study{2, 2, 4, kCornerRate, 1e-3},
        Study{3, 1, 2, kCornerRate, 5e-4}})
    expect_convergence({0.3, 0.2, 0.1}, {3, 2, 1}, study, kBox, kBoxDigits);
}

/// Free sphere of radius 0.05 m, by Lamb's equations (torsional: omega R / v_t
/// = 2.501133 for any Poisson's ratio) [Hz], and their multiplicities 2 l + 1.
struct Multiplet {
  double hz;
  int count;
};
const std::vector<Multiplet> kSphere{{25537.30, 5}, {27018.66, 5},
                                     {36042.2, 3},  {39459.7, 7},
                                     {40202.0, 7},  {51005.7, 1}};

/// Each multiplet whole and apart from the next: the figures stand 2e-2 from
/// each other, ten times what the modes may miss them by.
TEST(FreeSphere, HasEveryMultipletComplete) {
  std::vector<double> figures;
  for (const Multiplet& multiplet : kSphere)
    figures.insert(figures.end(), static_cast<std::size_t>(multiplet.count),
                   multiplet.hz);
  ASSERT_EQ(figures.size(), 28U);
  const auto find = [&](double size) {
    return find_spectrum(
        "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 0.05};\n",
        {.size = size, .order = 2}, 29);
  };
  const Spectrum coarse = find(0.02);
  const Spectrum fine = find(0.01);
  const Errors errors = compare(fine.hz, figures);
  EXPECT_LT(errors.largest, 2e-3);
  EXPECT_GT(errors.least, -1e-5);  // the figures' digits
  EXPECT_GT(fine.hz[28] / figures[27], 1.002);
  constexpr double kRate = 4.0;  // h^(2p)
  EXPECT_GT(rate(compare(coarse.hz, figures).largest, errors.largest,
                 std::cbrt(fine.nodes / coarse.nodes)),
            kRate);
}

/// Free beam 1 x 0.1 x 0.1 m, Ritz in polynomials as for the box [Hz]; bending
/// in pairs.
const std::vector<double> kBeam{513.8185, 513.8185, 1338.541, 1338.541,
                                1472.933, 2445.884, 2445.884, 2584.172,
                                2945.71,  3738.82,  3738.82,  4418.15};

constexpr double kBeamDigits = 1e-6;

TEST(FreeBeam, FrequenciesConvergeToTheRitzSolution) {
  for (const Study& study :
       {Study{2, 2, 4, kCornerRate, 1e-3}, Study{3, 1, 2, kCornerRate, 5e-4}})
    expect_convergence({1.0, 0.1, 0.1}, {6, 1, 1}, study, kBeam, kBeamDigits);
}

}  // namespace
}  // namespace limber::body_closed_forms_slow
