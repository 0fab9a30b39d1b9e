// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/body_model.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/kernels/padding.hpp"

namespace limber::dynamics {
namespace {

Vector6 pack_symmetric(const Matrix3& m) {
  Vector6 c;
  c << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
  return c;
}

// tr(A) I - A of the symmetric part of S, twice: the inertia of a first
// variation of the second moment.
Matrix3 inertia_of(const Matrix3& S) {
  const Matrix3 symmetric = S + S.transpose();
  return symmetric.trace() * Matrix3::Identity() - symmetric;
}

}  // namespace

int count_pair_coordinates(const SystemModel& model, BodyIndex b) {
  if (b == kWorld) return 0;
  const BodyModel& body = model.bodies[index(b)];
  if (body.full < 0) return count_coordinates(body);
  return static_cast<int>(model.full_bodies[index(body.full)].dofs() + 1);
}

ModalInertia pack_inertia(const flexbody::InertiaShapeIntegrals& s) {
  const auto m = static_cast<int>(s.S1.size());
  LIMBER_EXPECT(s.S2.size() == s.S1.size() * s.S1.size());

  const auto padded = static_cast<Eigen::Index>(kernels::pad(s.S1.size()));
  ModalInertia packed{m, MatrixX::Zero(9 * padded, m + 1)};
  const auto set = [&](int first, int mode, int column, const auto& values) {
    for (int c = 0; c < values.size(); ++c) {
      packed.columns(packed.row(first + c, mode), column) = values[c];
    }
  };
  std::size_t pair = 0;
  for (int k = 0; k < m; ++k) {
    set(0, k, 0, pack_symmetric(inertia_of(s.S1[static_cast<std::size_t>(k)])));
    for (int l = 0; l < m; ++l) {
      const Matrix3& S2 = s.S2[pair++];
      set(0, l, k + 1, pack_symmetric(inertia_of(S2)));
      // (phi_k x phi_l)_c = eps_cab S2_ab.
      set(6, l, k + 1,
          Vector3(S2(1, 2) - S2(2, 1), S2(2, 0) - S2(0, 2),
                  S2(0, 1) - S2(1, 0)));
    }
  }
  return packed;
}

ModalInertia pack_inertia(const flexbody::InertiaShapeIntegrals& s,
                          const flexbody::QuadraticManifold& manifold) {
  flexbody::InertiaShapeIntegrals corrected = s;
  const std::vector<int>& paired = manifold.paired;
  Eigen::Index pair = 0;
  for (std::size_t a = 0; a < paired.size(); ++a) {
    for (std::size_t b = a; b < paired.size(); ++b, ++pair) {
      const auto i = static_cast<std::size_t>(paired[a]);
      const auto j = static_cast<std::size_t>(paired[b]);
      const Matrix3 D = unpack_symmetric(manifold.S2.col(pair));
      corrected.S2[i * s.S1.size() + j] += D;
      if (i != j) corrected.S2[j * s.S1.size() + i] += D;
    }
  }
  return pack_inertia(corrected);
}

const VectorX& require_eigenvalues(const BodyModel& body,
                                   std::string_view work) {
  const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity);
  if (lambda != nullptr) return *lambda;
  throw InputError(fmt::format(
      "body '{}': its elasticity couples its modes, but {} takes each mode "
      "alone; give it the elasticity of its reduced body",
      body.name, work));
}

}  // namespace limber::dynamics
