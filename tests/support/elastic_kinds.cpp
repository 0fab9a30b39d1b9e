// SPDX-License-Identifier: BSD-3-Clause
#include "support/elastic_kinds.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "limber/common/dense/qr.hpp"
#include "support/free_top.hpp"

namespace limber::testing {

MatrixX make_basis(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MatrixX any(size, size);
  for (double& x : any.reshaped()) x = uniform(random);
  return dense::find_q(any, size);
}

flexbody::QuadraticStrain make_quadratic_strain(const VectorX& lambda,
                                                int paired, double amplitude,
                                                unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  flexbody::QuadraticStrain::Parameters p{lambda, {}, {}};
  const auto first = static_cast<int>(lambda.size()) - paired;
  for (int k = 0; k < paired; ++k) p.paired.push_back(first + k);
  p.Q.resize(paired, paired * (paired + 1) / 2);
  for (int r = 0; r < paired; ++r) {
    for (Eigen::Index c = 0; c < p.Q.cols(); ++c) {
      p.Q(r, c) =
          uniform(random) * std::sqrt(lambda[first + r]) / (paired * amplitude);
    }
  }
  return flexbody::QuadraticStrain(p);
}

flexbody::ReducedBody turn_basis(const flexbody::ReducedBody& body,
                                 const MatrixX& U) {
  flexbody::ReducedBody turned = body;
  const auto m = static_cast<std::size_t>(body.mode_count());
  turned.lambda = turn_stiffness(body.lambda, U).rest_stiffness();
  turned.rows.Phi_B = body.rows.Phi_B * U;
  turned.integrals.P = body.integrals.P * U;
  turned.integrals.S1.assign(m, Matrix3::Zero());
  turned.integrals.S2.assign(m * m, Matrix3::Zero());
  const auto at = [&](std::size_t i, std::size_t j) {
    return U(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t i = 0; i < m; ++i) {
      turned.integrals.S1[k] += at(i, k) * body.integrals.S1[i];
    }
    for (std::size_t l = 0; l < m; ++l) {
      for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) {
          turned.integrals.S2[k * m + l] +=
              at(i, k) * at(j, l) * body.integrals.S2[i * m + j];
        }
      }
    }
  }
  return turned;
}

flexbody::InterfaceTable turn_basis(const flexbody::InterfaceTable& table,
                                    const MatrixX& U) {
  flexbody::InterfaceTable turned = table;
  turned.Phi_B = table.Phi_B * U;
  turned.Psi_B = table.Psi_B * U;
  return turned;
}

flexbody::FullStiffness turn_stiffness(const VectorX& lambda,
                                       const MatrixX& U) {
  return flexbody::FullStiffness({U.transpose() * lambda.asDiagonal() * U});
}

void stiffen(dynamics::SystemModel& model, double amplitude) {
  unsigned seed = 1;
  for (dynamics::BodyModel& body : model.bodies) {
    if (body.modes == 0) continue;
    body.elasticity =
        make_quadratic_strain(flexbody::rest_stiffness(body.elasticity),
                              body.modes - 1, amplitude, seed++);
  }
}

namespace {

// 3 x pairs of entries up to `size`.
Matrix3X make_pairs(int paired, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return Matrix3X::NullaryExpr(3, paired * (paired + 1) / 2,
                               [&] { return uniform(random); });
}

// Adds a made-up change of the inertia, symmetric in the modes.
std::shared_ptr<const dynamics::ModalInertia> bend_inertia(
    const dynamics::ModalInertia& inertia, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  auto bent = std::make_shared<dynamics::ModalInertia>(inertia);
  for (int k = 1; k < inertia.modes; ++k) {
    for (int l = k; l < inertia.modes; ++l) {
      for (int c = 0; c < 6; ++c) {
        const double more = uniform(random);
        bent->columns(inertia.row(c, k), l + 1) += more;
        if (l != k) bent->columns(inertia.row(c, l), k + 1) += more;
      }
    }
  }
  return bent;
}

}  // namespace

void bend(dynamics::SystemModel& model, double amplitude) {
  std::mt19937 random(4);
  stiffen(model, amplitude);
  for (dynamics::BodyModel& body : model.bodies) {
    if (body.modes == 0) continue;
    body.fidelity = dynamics::Fidelity::nonlinear;
    body.inertia = bend_inertia(*body.inertia, random);
  }
  for (dynamics::Attachment& a : model.attachments) {
    if (a.Phi_B.cols() == 0) continue;
    const int paired = static_cast<int>(a.Phi_B.cols()) - 1;
    std::vector<int> modes(static_cast<std::size_t>(paired));
    std::iota(modes.begin(), modes.end(), 1);
    const double fraction = 1.0 / (paired * amplitude);
    a.second = std::make_shared<const flexbody::QuadraticFrame>(
        flexbody::make_quadratic_frame(
            modes,
            make_pairs(paired, fraction * a.Phi_B.cwiseAbs().maxCoeff(),
                       random),
            make_pairs(paired, fraction * a.Psi_B.cwiseAbs().maxCoeff(),
                       random)));
  }
}

flexbody::QuadraticStrain Duffing::elasticity() const {
  MatrixX Q = MatrixX::Zero(2, 3);
  Q(1, 0) = std::sqrt(0.5 * b);  // V = a q^2 / 2 + (Q q^2)^2 / 2
  return flexbody::QuadraticStrain({Eigen::Vector2d(a, 0.0), {0, 1}, Q});
}

namespace {

// q = A cn(w t, k), w^2 = a + b A^2, k^2 = b A^2 / (2 w^2).
double rate(const Duffing& d, double amplitude) {
  return std::sqrt(d.a + d.b * amplitude * amplitude);
}

double complementary(const Duffing& d, double amplitude) {
  const double k = std::sqrt(0.5 * d.b) * amplitude / rate(d, amplitude);
  return std::sqrt(1.0 - k * k);
}

}  // namespace

double Duffing::period(double amplitude) const {
  return 4.0 * complete_integral(complementary(*this, amplitude)) /
         rate(*this, amplitude);
}

double Duffing::position(double amplitude, double t) const {
  return amplitude *
         jacobi(rate(*this, amplitude) * t, complementary(*this, amplitude)).cn;
}

}  // namespace limber::testing
