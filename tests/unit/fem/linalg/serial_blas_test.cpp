// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/serial_blas.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "places.hpp"

namespace limber::fem::serial_blas_test {
namespace {

/// OpenBLAS's own number of threads, put back at the end.
class BlasThreads : public ::testing::Test {
 protected:
  // BLAS is loaded when it is first needed.
  static void SetUpTestSuite() { const SerialBlas first; }
  BlasThreads() {
    if (get_ != nullptr) before_ = get_();
  }
  ~BlasThreads() override {
    if (set_ != nullptr) set_(before_);
  }
  void SetUp() override {
    if (get_ == nullptr || set_ == nullptr) GTEST_SKIP() << "another BLAS";
  }

  int (*get_)() = reinterpret_cast<int (*)()>(
      dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  void (*set_)(int) = reinterpret_cast<void (*)(int)>(
      dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  int before_ = 1;
};

TEST_F(BlasThreads, AreOneUntilTheLastOfTwoThreadsIsDone) {
  set_(2);
  std::latch both{2};
  std::latch first_is_done{1};
  int between = 0;
  std::thread first([&] {
    {
      const SerialBlas serial;
      both.arrive_and_wait();
    }
    first_is_done.count_down();
  });
  std::thread second([&] {
    const SerialBlas serial;
    both.arrive_and_wait();
    first_is_done.wait();
    between = get_();
  });
  first.join();
  second.join();
  EXPECT_EQ(between, 1);
  EXPECT_EQ(get_(), 2);
}

// Sums of several threads end in other digits.
TEST_F(BlasThreads, DoNotChangeABitOfModesAndAnswers) {
  const auto solve = [&](int threads) {
    set_(threads);
    const Mesh mesh = read_mesh(LIMBER_SOURCE_DIR "/meshes/beam579.msh");
    const StructuralMatrices matrices = assemble(mesh, {{210e9, 0.3, 7850.0}});
    const ElasticInverse inverse(
        matrices, make_rigid_modes(matrices.M_s, mesh.x), mesh.x);
    const MatrixX loads = MatrixX::Identity(matrices.dof_count(), 20);
    return std::pair{find_eigenmodes(inverse, 12).Phi, inverse.solve(loads)};
  };
  const auto one = solve(1);
  const auto two = solve(2);
  EXPECT_TRUE(one.first == two.first);
  EXPECT_TRUE(one.second == two.second);
}

}  // namespace
}  // namespace limber::fem::serial_blas_test
