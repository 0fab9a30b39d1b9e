// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/kernels/column_kernels.hpp"
#include "limber/dynamics/kernels/inertia_kernel.hpp"
#include "limber/dynamics/kernels/padding.hpp"
#include "limber/dynamics/system/body_model.hpp"

/// Kernels against the products that they stand for, by Eigen.
namespace limber::dynamics {
namespace {

// Around the blocks that kernels compute at once.
const std::vector<int> kSizes = {1, 2, 3, 4, 5, 7, 8, 11, 12, 13, 31};

constexpr double kRoundoff = 1e-13;

// With a value behind the last one that no kernel may read as a number.
class Guarded {
 public:
  explicit Guarded(const MatrixX& values)
      : data_(values.data(), values.data() + values.size()) {
    data_.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  [[nodiscard]] const double* data() const { return data_.data(); }

 private:
  std::vector<double> data_;
};

struct Inertia {
  explicit Inertia(int m)
      : J1(MatrixX::Random(m, 6)),
        padded(static_cast<Eigen::Index>(
            kernels::pad(static_cast<std::size_t>(m)))),
        columns(MatrixX::Zero(9 * padded, m + 1)) {
    for (int c = 0; c < 6; ++c) {
      columns.block(c * padded, 0, m, 1) = J1.col(c);
      J2.emplace_back(MatrixX::Random(m, m));
      columns.block(c * padded, 1, m, m) = J2.back();
    }
    for (int c = 0; c < 3; ++c) {
      beta.emplace_back(MatrixX::Random(m, m));
      columns.block((6 + c) * padded, 1, m, m) = beta.back();
    }
  }
  MatrixX J1;
  std::vector<MatrixX> J2;    // of each component
  std::vector<MatrixX> beta;  // likewise
  Eigen::Index padded;
  MatrixX columns;
};

TEST(InertiaKernel, SumsOverTheModes) {
  for (const int m : kSizes) {
    const Inertia inertia(m);
    const VectorX eta = VectorX::Random(m);
    const VectorX etadot = VectorX::Random(m);
    const Vector3 w = Vector3::Random();
    const Vector6 half = half_square(w);
    MatrixX products = MatrixX::Zero(inertia.padded, 12);
    const VectorX start = VectorX::Random(m);
    VectorX bias = start;
    const kernels::InertiaSums sums = kernels::calc_inertia(
        {inertia.columns.data(), static_cast<std::size_t>(m)},
        Guarded(eta).data(), Guarded(etadot).data(), w.data(), half.data(),
        products.data(), bias.data());
    VectorX expected = start;
    for (int c = 0; c < 6; ++c) {
      const VectorX dJ = inertia.J1.col(c) + inertia.J2[c] * eta;
      EXPECT_TRUE(products.col(c).head(m).isApprox(dJ, kRoundoff)) << m;
      EXPECT_NEAR(
          sums.J[c],
          inertia.J1.col(c).dot(eta) + 0.5 * eta.dot(inertia.J2[c] * eta),
          kRoundoff * m);
      EXPECT_NEAR(sums.Jdot[c], dJ.dot(etadot), kRoundoff * m);
      expected -= half[c] * dJ;
    }
    for (int c = 0; c < 3; ++c) {
      const VectorX H = inertia.beta[c] * eta;
      const VectorX rate = inertia.beta[c] * etadot;
      EXPECT_TRUE(products.col(6 + c).head(m).isApprox(H, kRoundoff)) << m;
      EXPECT_TRUE(products.col(9 + c).head(m).isApprox(rate, kRoundoff)) << m;
      EXPECT_NEAR(sums.h[c], H.dot(etadot), kRoundoff * m);
      expected += 2.0 * w[c] * rate;
    }
    EXPECT_LE((bias - expected).cwiseAbs().maxCoeff(), kRoundoff * m);
  }
}

TEST(ColumnKernels, MoveAndPushAnInterface) {
  for (const int m : kSizes) {
    const Matrix3X Phi = Matrix3X::Random(3, m);
    const Matrix3X Psi = Matrix3X::Random(3, m);
    const VectorX eta = VectorX::Random(m);
    const VectorX etadot = VectorX::Random(m);
    const Guarded first(Phi);
    const Guarded second(Psi);
    const kernels::InterfaceColumns columns{first.data(), second.data(),
                                            static_cast<std::size_t>(m)};
    const kernels::InterfaceMotion motion = kernels::calc_interface_motion(
        columns, Guarded(eta).data(), Guarded(etadot).data());
    const auto expect = [&](const std::array<double, 3>& is,
                            const Vector3& expected) {
      EXPECT_LE((Eigen::Map<const Vector3>(is.data()) - expected).norm(),
                kRoundoff * m)
          << m;
    };
    expect(motion.u, Phi * eta);
    expect(motion.psi, Psi * eta);
    expect(motion.udot, Phi * etadot);
    expect(motion.psidot, Psi * etadot);

    const Vector3 force = Vector3::Random();
    const Vector3 moment = Vector3::Random();
    VectorX modal = VectorX::Ones(m);
    kernels::add_interface_force(columns, force.data(), moment.data(),
                                 modal.data());
    const VectorX expected =
        VectorX::Ones(m) + Phi.transpose() * force + Psi.transpose() * moment;
    EXPECT_LE((modal - expected).cwiseAbs().maxCoeff(), kRoundoff) << m;
  }
}

TEST(ColumnKernels, MultiplyTheRowsOfALink) {
  for (const int count : kSizes) {
    const Matrix6X G = Matrix6X::Random(6, count);
    const Matrix6X Z = Matrix6X::Random(6, count);
    const Guarded rows(G);
    const auto size = static_cast<std::size_t>(count);
    const VectorX x = VectorX::Random(count);
    const Vector6 wrench = Vector6::Random();

    Vector6 sum = Vector6::Ones();
    kernels::add_product(rows.data(), Guarded(x).data(), size, sum.data());
    EXPECT_LE((sum - Vector6::Ones() - G * x).norm(), kRoundoff * count);

    VectorX forces = x;
    kernels::add_transposed_product(rows.data(), wrench.data(), size,
                                    forces.data());
    EXPECT_LE((forces - x - G.transpose() * wrench).cwiseAbs().maxCoeff(),
              kRoundoff);

    Matrix6 block = Matrix6::Identity();
    kernels::add_outer_products(rows.data(), Guarded(Z).data(), size,
                                block.data());
    EXPECT_LE((block - Matrix6::Identity() - G * Z.transpose()).norm(),
              kRoundoff * count);
  }
}

}  // namespace
}  // namespace limber::dynamics
