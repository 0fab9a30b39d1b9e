// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/reduce_matrices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/matrices/read_matrices.hpp"
#include "places.hpp"
#include "unit/reduction/matrices/exported_mesh.hpp"

/// Bodies from matrices against the same bodies from a mesh, and beams against
/// closed forms.
namespace limber::flexbody::matrices_test {
namespace {

using ::testing::HasSubstr;

void expect_near(const MatrixX& found, const MatrixX& expected,
                 double tolerance, const char* what) {
  ASSERT_EQ(found.rows(), expected.rows()) << what;
  ASSERT_EQ(found.cols(), expected.cols()) << what;
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(),
            tolerance * (expected.cwiseAbs().maxCoeff() + 1e-300))
      << what;
}

MatrixX join(const std::vector<Matrix3>& all) {
  MatrixX joined(3, 3 * std::ssize(all));
  for (std::size_t k = 0; k < all.size(); ++k)
    joined.middleCols<3>(3 * static_cast<Eigen::Index>(k)) = all[k];
  return joined;
}

/// All that dynamics reads of a body.
void expect_same_body(const ReducedBody& read, const ReducedBody& expected) {
  const ReducedBody found = align_signs(read, expected);
  constexpr double kSame = 1e-10;
  EXPECT_EQ(found.clamped, expected.clamped);
  EXPECT_NEAR(found.mass, expected.mass, 1e-13 * expected.mass);
  EXPECT_LT((found.p_MoBcm_M - expected.p_MoBcm_M).norm(), 1e-13);
  EXPECT_LT((found.size - expected.size).norm(), 1e-13);
  const VectorX ratio =
      (found.lambda - expected.lambda).cwiseQuotient(expected.lambda);
  EXPECT_LT(ratio.cwiseAbs().maxCoeff(), kSame);
  expect_near(found.integrals.S0, expected.integrals.S0, kSame, "S0");
  expect_near(join(found.integrals.S1), join(expected.integrals.S1), kSame,
              "S1");
  expect_near(join(found.integrals.S2), join(expected.integrals.S2), kSame,
              "S2");
  if (expected.clamped)
    expect_near(found.integrals.P, expected.integrals.P, kSame, "P");
  EXPECT_NEAR(found.levers.consistent, expected.levers.consistent,
              kSame * expected.levers.consistent);
  EXPECT_NEAR(found.levers.displacement, expected.levers.displacement,
              kSame * expected.levers.displacement);
  expect_near(found.rows.Phi_B, expected.rows.Phi_B, kSame, "rows");
  ASSERT_EQ(found.interfaces.size(), expected.interfaces.size());
  for (std::size_t i = 0; i < found.interfaces.size(); ++i) {
    const InterfaceTable& a = found.interfaces[i];
    const InterfaceTable& b = expected.interfaces[i];
    EXPECT_LT((a.p_B - b.p_B).norm(), 1e-12);
    expect_near(a.Phi_B, b.Phi_B, kSame, "Phi");
    expect_near(a.Psi_B, b.Psi_B, kSame, "Psi");
    expect_near(a.flexibility, b.flexibility, 1e-9, "flexibility");
  }
}

void compare_with_mesh(const testing::Bar& bar) {
  Recipe recipe = testing::make_recipe(bar);
  recipe.basis.eigenmodes = 6;
  recipe.rows = parse_rows({"all"});
  for (InterfaceRequest& interface : recipe.interfaces)
    interface.weighting = Weighting::equal;
  recipe.load_patterns = {{"tip", Vector3(1.0, 2.0, 3.0), Vector3::Zero()}};
  if (bar.is_clamped) {
    // Static-deformation modes nearly depend on the clamped eigenmodes: what is
    // left of them magnifies the rounding of K's entries, which a mesh avoids.
    recipe.basis.interface_modes = false;
    recipe.basis.load_modes = false;
  }
  Recipe whole = recipe;  // the exported matrices are of all nodes
  whole.clamped_groups.clear();
  const MeshedBody meshed(whole, {});
  const auto part = make_matrix_part(export_mesh(meshed), bar.mass(), 1.0);
  EXPECT_TRUE(part->system.notices.empty());
  const ReducedBody found = reduce_matrices(recipe, part);
  const ReducedBody expected = reduce(recipe);
  expect_same_body(found, expected);
}

TEST(ReduceMatrices, OfASolidMeshGiveItsBody) {
  compare_with_mesh({.corner = {0.3, -0.2, 0.1}});
}

TEST(ReduceMatrices, OfASolidMeshGiveItsClampedBody) {
  compare_with_mesh({.is_clamped = true});
}

/// tests/data/matrices/make_models.py: 1 m along x, section 20 x 30 mm.
struct Beam {
  double mass = 4.68;   // [kg]
  double EIy = 9000.0;  // bends along z [N m^2]
  double EIz = 4000.0;  // bends along y
  double GJ = 80e9 * 0.196 * 0.03 * 8e-6;
  double EA = 200e9 * 6e-4;
};

std::shared_ptr<const MatrixPart> read(const std::string& name,
                                       double mass = 4.68, double unit = 1.0) {
  MeshSource source;
  source.matrices.paths = {LIMBER_SOURCE_DIR "/tests/data/matrices/" + name};
  source.matrices.mass = mass;
  source.unit = unit;
  return read_matrix_part(source);
}

Recipe make_beam_recipe(int modes) {
  Recipe recipe;
  recipe.name = "beam";
  recipe.basis.eigenmodes = modes;
  return recipe;
}

/// f of a free beam's bending: (k L)^2 = 22.3733, 61.6728.
double calc_free_frequency(double kL_squared, double EI) {
  const Beam beam;
  return kL_squared / (2.0 * M_PI) * std::sqrt(EI / beam.mass);
}

VectorX calc_frequencies(const ReducedBody& body) {
  return body.lambda.cwiseSqrt() / (2.0 * M_PI);
}

TEST(ReduceMatrices, OfAFreeBeamHaveItsFrequencies) {
  const Beam beam;
  for (const char* name : {"beam", "beam_lumped"}) {
    const VectorX f =
        calc_frequencies(reduce_matrices(make_beam_recipe(4), read(name)));
    // Elements converge with the fourth power, lumped masses with the second.
    const double tolerance = std::string(name) == "beam" ? 1e-4 : 2e-2;
    const double expected[] = {calc_free_frequency(22.37329, beam.EIz),
                               calc_free_frequency(22.37329, beam.EIy),
                               calc_free_frequency(61.67282, beam.EIz),
                               calc_free_frequency(61.67282, beam.EIy)};
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(f[k], expected[k], tolerance * expected[k]) << name << k;
  }
}

/// The arch in N, s and millimetres: displacements are 1000 times as large.
std::shared_ptr<const MatrixPart> read_in_millimetres(double mass) {
  constexpr double kMillimetre = 1e-3;
  fem::MatrixModel model =
      fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
  model.x /= kMillimetre;
  for (auto* A : {&model.stiffness.entries, &model.mass.entries})
    for (Eigen::Index j = 0; j < A->outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(*A, j); it; ++it) {
        const auto scale = [](Eigen::Index row) {
          return row % 6 < 3 ? kMillimetre : 1.0;
        };
        it.valueRef() *= scale(it.row()) * scale(j) / kMillimetre;
      }
  return make_matrix_part(std::move(model), mass, kMillimetre);
}

TEST(ReduceMatrices, InMillimetresGiveTheSameBody) {
  Recipe recipe = make_beam_recipe(6);
  recipe.interfaces = {{"tip", TaggedNode{13}}};
  constexpr double kMass = 7.4186889;
  expect_same_body(reduce_matrices(recipe, read_in_millimetres(kMass)),
                   reduce_matrices(recipe, read("arch", kMass)));
}

/// A cantilever under a force and a moment at its end: the node's own rotation
/// and position, exact for this element.
TEST(ReduceMatrices, GiveANodeWithRotationsAFrameOfItsOwn) {
  const Beam beam;
  Recipe recipe = make_beam_recipe(4);
  recipe.clamped_groups = {"node:1"};
  recipe.interfaces = {{"tip", TaggedNode{21}}};
  const ReducedBody body = reduce_matrices(recipe, read("beam"));
  ASSERT_TRUE(body.clamped);
  const InterfaceTable& tip = body.interfaces.front();
  EXPECT_EQ(tip.rotation_rank(), 3);
  const Matrix6& f = tip.flexibility;
  const auto expect = [&](int i, int j, double value) {
    EXPECT_NEAR(f(i, j), value, 1e-9 * std::abs(value)) << i << j;
  };
  expect(0, 0, 1.0 / beam.EA);
  expect(1, 1, 1.0 / (3.0 * beam.EIz));
  expect(2, 2, 1.0 / (3.0 * beam.EIy));
  expect(3, 3, 1.0 / beam.GJ);
  expect(4, 4, 1.0 / beam.EIy);
  expect(5, 5, 1.0 / beam.EIz);
  expect(1, 5, 1.0 / (2.0 * beam.EIz));
  expect(2, 4, -1.0 / (2.0 * beam.EIy));
  // The static modes carry the load, so the basis has this flexibility too.
  MatrixX T(6, body.mode_count());
  T << tip.Phi_B, tip.Psi_B;
  const Matrix6 modal =
      T * body.lambda.cwiseInverse().asDiagonal() * T.transpose();
  EXPECT_LT((modal - f).cwiseAbs().maxCoeff(), 1e-8 * f.cwiseAbs().maxCoeff());
}

TEST(ReduceMatrices, OfModesAreFreeOfRigidMotion) {
  const auto part = read("arch", 7.4186889);
  const ReducedBody body = reduce_matrices(make_beam_recipe(10), part);
  EXPECT_LT(body.integrals.P.cwiseAbs().maxCoeff(),
            1e-12 * std::sqrt(body.mass));
  const double size = std::sqrt(body.integrals.S0.trace());
  for (std::size_t k = 0; k < body.integrals.S1.size(); ++k) {
    const Matrix3& S1 = body.integrals.S1[k];
    EXPECT_LT((S1 - S1.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size);
    // tr S2_kl = phi_k^T M phi_l
    for (std::size_t l = 0; l < 10; ++l)
      EXPECT_NEAR(body.integrals.S2[k * 10 + l].trace(), k == l ? 1.0 : 0.0,
                  1e-11);
  }
}

/// 150 elements without rotary inertia: half the rows have no mass, and the
/// modes come from Lanczos's iteration.
TEST(ReduceMatrices, MayHaveRowsWithoutMass) {
  const Beam beam;
  constexpr int kNodes = 151;
  const double a = 1.0 / (kNodes - 1);
  MatrixX K = MatrixX::Zero(6 * kNodes, 6 * kNodes);
  MatrixX M = K;
  Matrix3X x = Matrix3X::Zero(3, kNodes);
  for (int n = 0; n < kNodes; ++n) x(0, n) = n * a;
  const auto add = [&](int e, std::array<int, 4> rows, double EI, double s) {
    const double b = a * s;
    Eigen::Matrix4d bend;
    bend << 12, 6 * b, -12, 6 * b, 6 * b, 4 * a * a, -6 * b, 2 * a * a, -12,
        -6 * b, 12, -6 * b, 6 * b, 2 * a * a, -6 * b, 4 * a * a;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        K(6 * e + rows[i], 6 * e + rows[j]) +=
            EI / (a * a * a) *
            bend(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  const auto pull = [&](int e, int row, double k) {
    Eigen::Matrix2d spring;
    spring << k, -k, -k, k;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        K(6 * (e + i) + row, 6 * (e + j) + row) += spring(i, j);
  };
  for (int e = 0; e + 1 < kNodes; ++e) {
    add(e, {1, 5, 7, 11}, beam.EIz, 1.0);
    add(e, {2, 4, 8, 10}, beam.EIy, -1.0);
    pull(e, 0, beam.EA / a);
    pull(e, 3, beam.GJ / a);
    for (const int n : {e, e + 1}) {
      for (int c = 0; c < 3; ++c)
        M(6 * n + c, 6 * n + c) += 0.5 * beam.mass * a;
      M(6 * n + 3, 6 * n + 3) += 1e-4 * a;  // torsion only
    }
  }
  const auto part = make_matrix_part(make_model(x, K, M), beam.mass, 1.0);
  const VectorX f =
      calc_frequencies(reduce_matrices(make_beam_recipe(12), part));
  EXPECT_NEAR(f[0] / calc_free_frequency(22.37329, beam.EIz), 1.0, 1e-3);
  EXPECT_NEAR(f[1] / calc_free_frequency(22.37329, beam.EIy), 1.0, 1e-3);
  EXPECT_NEAR(f[2] / calc_free_frequency(61.67282, beam.EIz), 1.0, 1e-3);
}

/// Node 14 was condensed: it hangs rigidly on node 13, at an offset.
TEST(ReduceMatrices, GiveCondensedNodesTheirMotion) {
  fem::MatrixModel model =
      fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
  const Vector3 offset(0.1, -0.2, 0.3);
  model.x.conservativeResize(3, 14);
  model.x.col(13) = model.x.col(12) + offset;
  model.tags.push_back(14);
  MatrixX T = MatrixX::Zero(6, 78);
  T.block<3, 3>(0, 72).setIdentity();
  T.block<3, 3>(0, 75) = -skew(offset);
  T.block<3, 3>(3, 75).setIdentity();
  model.equations = T.sparseView();
  for (int c = 0; c < 6; ++c) model.condensed.push_back({13, c});
  const auto part = make_matrix_part(std::move(model), 7.4186889, 1.0);
  EXPECT_TRUE(part->system.notices.empty());
  Recipe recipe = make_beam_recipe(6);
  recipe.interfaces = {{"near", TaggedNode{13}}, {"far", TaggedNode{14}}};
  const ReducedBody body = reduce_matrices(recipe, part);
  const InterfaceTable& near = body.interfaces[0];
  const InterfaceTable& far = body.interfaces[1];
  EXPECT_EQ(far.rotation_rank(), 3);
  EXPECT_LT((far.p_B - near.p_B - offset).norm(), 1e-14);
  expect_near(far.Psi_B, near.Psi_B, 1e-12, "rotation");
  expect_near(far.Phi_B, near.Phi_B - skew(offset) * near.Psi_B, 1e-12,
              "translation");
}

/// A row without a node that moves with a spring between two others: its rigid
/// motion follows from the stiffness.
TEST(ReduceMatrices, MayHaveARowOfUnknownKind) {
  const fem::MatrixModel arch =
      fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
  const auto extend = [](const Eigen::SparseMatrix<double>& A) {
    MatrixX extended = MatrixX::Zero(79, 79);
    extended.topLeftCorner<78, 78>() = MatrixX(A);
    return extended;
  };
  MatrixX K = extend(arch.stiffness.entries);
  const MatrixX M = extend(arch.mass.entries);
  constexpr double kSpring = 1e4;
  for (const int end : {6 * 2 + 1, 6 * 3 + 1}) {  // along y of nodes 3 and 4
    K(78, 78) += kSpring;
    K(end, end) += kSpring;
    K(78, end) -= kSpring;
    K(end, 78) -= kSpring;
  }
  fem::MatrixModel model = arch;
  model.rows.push_back({-1, -1});
  model.stiffness.entries = K.sparseView();
  model.mass.entries = M.sparseView();
  // Nodes 3 and 4 differ in x, so the spring resists rotation about z, weakly.
  const auto part = make_matrix_part(model, 7.4186889, 1.0);
  ASSERT_EQ(part->system.notices.size(), 1U);
  EXPECT_THAT(part->system.notices.front(), HasSubstr("rotation about z"));
  model.x(0, 3) = model.x(0, 2);
  model.x(2, 3) = model.x(2, 2);
  EXPECT_NEAR(make_rigid_motions(make_matrix_system(model, 1.0))(78, 1), 1.0,
              1e-12);
}

TEST(ReduceMatrices, OfADirectionWithTwoRowsAreRefused) {
  fem::MatrixModel model =
      fem::read_matrices({{LIMBER_SOURCE_DIR "/tests/data/matrices/arch"}});
  model.rows[8] = model.rows[7];
  try {
    static_cast<void>(make_matrix_part(model, 7.4186889, 1.0));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("node 2, y has two rows"));
  }
}

std::string refuse(const std::function<void(Recipe&)>& change) {
  Recipe recipe = make_beam_recipe(2);
  change(recipe);
  try {
    static_cast<void>(reduce_matrices(recipe, read("beam")));
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    return error.what();
  }
  return "accepted";
}

TEST(ReduceMatrices, RefuseWhatNeedsElements) {
  EXPECT_THAT(refuse([](Recipe& r) { r.manifold = true; }),
              HasSubstr("Use level coupled"));
  EXPECT_THAT(refuse([](Recipe& r) { r.stress = true; }),
              HasSubstr("stress needs elements"));
  EXPECT_THAT(refuse([](Recipe& r) { r.contact_groups = {"skin"}; }),
              HasSubstr("contact needs a surface"));
}

TEST(ReduceMatrices, NameSetsAndNodesThatAreMissing) {
  EXPECT_THAT(refuse([](Recipe& r) {
                r.interfaces = {{"tip", TaggedNode{99}}};
              }),
              HasSubstr("no node has the number 99"));
  EXPECT_THAT(refuse([](Recipe& r) { r.clamped_groups = {"root"}; }),
              HasSubstr("unknown node set 'root'"));
  EXPECT_THAT(refuse([](Recipe& r) { r.clamped_groups = {"node:x"}; }),
              HasSubstr("'node:x' is not a node"));
}

}  // namespace
}  // namespace limber::flexbody::matrices_test
