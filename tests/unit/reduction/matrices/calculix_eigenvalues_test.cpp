// SPDX-License-Identifier: BSD-3-Clause
// Modes of CalculiX's matrices against its eigenvalues, in double precision
// from the .eig file of a run with *FREQUENCY, STORAGE=YES.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "limber/reduction/mode_study.hpp"
#include "places.hpp"

namespace limber::flexbody::calculix_eigenvalues_test {
namespace {

void expect_eigenvalues(const char* sample, double mass, double tolerance,
                        const std::vector<double>& expected) {
  Recipe recipe;
  recipe.mesh.matrices = {
      {std::string(LIMBER_SOURCE_DIR "/tests/data/matrices/") + sample}, mass};
  recipe.mesh.file = recipe.mesh.matrices.paths.front();
  recipe.basis.eigenmodes = static_cast<int>(expected.size());
  const VectorX lambda = study_modes(recipe).lambda;
  ASSERT_EQ(lambda.size(), std::ssize(expected));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(lambda[static_cast<Eigen::Index>(k)], expected[k],
                tolerance * expected[k])
        << sample << " " << k;
  }
}

TEST(MatricesOfCalculiX, OfBeamsHaveItsEigenvalues) {
  expect_eigenvalues("calculix_beam", 11.9317, 1e-9,
                     {1422955.1138, 3900595.3687});
}

TEST(MatricesOfCalculiX, OfShellsAcrossAFoldHaveItsEigenvalues) {
  expect_eigenvalues("calculix_fold", 780.0, 3e-8,
                     {136876.97231, 351406.75400});
}

}  // namespace
}  // namespace limber::flexbody::calculix_eigenvalues_test
