// SPDX-License-Identifier: BSD-3-Clause
// Modes of CalculiX's matrices against the eigenvalues that it prints.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "limber/reduction/mode_study.hpp"
#include "places.hpp"

namespace limber::flexbody::calculix_eigenvalues_test {
namespace {

// Seven digits, of 14 in the matrices.
void expect_eigenvalues(const char* sample, double mass,
                        const std::vector<double>& printed) {
  Recipe recipe;
  recipe.mesh.matrices = {
      {std::string(LIMBER_SOURCE_DIR "/tests/data/matrices/") + sample}, mass};
  recipe.mesh.file = recipe.mesh.matrices.paths.front();
  recipe.basis.eigenmodes = static_cast<int>(printed.size());
  const VectorX lambda = study_modes(recipe).lambda;
  ASSERT_EQ(lambda.size(), std::ssize(printed));
  for (std::size_t k = 0; k < printed.size(); ++k) {
    EXPECT_NEAR(lambda[static_cast<Eigen::Index>(k)], printed[k],
                5e-7 * printed[k])
        << sample << " " << k;
  }
}

TEST(MatricesOfCalculiX, OfBeamsHaveItsEigenvalues) {
  expect_eigenvalues("calculix_beam", 11.9317, {1422955, 3900595, 17487970});
}

TEST(MatricesOfCalculiX, OfShellsAcrossAFoldHaveItsEigenvalues) {
  expect_eigenvalues("calculix_fold", 780.0, {136877.0, 351406.8});
}

}  // namespace
}  // namespace limber::flexbody::calculix_eigenvalues_test
