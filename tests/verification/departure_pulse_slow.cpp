// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/solid/elastic_inverse.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "limber/reduction/departure.hpp"
#include "verification/body_reference.hpp"

/// The report's beam loaded at its tip by sin^4(pi t / T). Slow because the
/// full linear model is all modes of the mesh: a dense eigenproblem of 1737
/// unknowns.
namespace limber::departure_pulse_slow {
namespace {

using flexbody::ReducedBasis;

MatrixX dense_mass(const fem::SparseMatrix& M_s) {
  const Eigen::Index n = 3 * M_s.cols();
  return fem::multiply_mass(M_s, MatrixX::Identity(n, n));
}

flexbody::Recipe make_recipe(bool is_clamped) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh", is_clamped);
  recipe.interfaces = {
      {"tip", flexbody::GroupNodes{"tip"}, flexbody::Weighting::uniform}};
  return recipe;
}

/// sin^4(pi t / T) = 3/8 - cos(w t) / 2 + cos(2 w t) / 8, w = 2 pi / T.
flexbody::ModalLoads make_pulse(const VectorX& f, double duration) {
  const VectorX zero = VectorX::Zero(f.size());
  const double w = 2.0 * M_PI / duration;
  flexbody::ModalLoads loads;
  loads.steps.times = {0.0, duration};
  loads.steps.values.resize(f.size(), 2);
  loads.steps.values << 0.375 * f, zero;
  loads.sinusoids = {{w, -0.5 * f, zero, 0.0, duration},
                     {2.0 * w, 0.125 * f, zero, 0.0, duration}};
  return loads;
}

struct LoadedBeam {
  explicit LoadedBeam(bool is_clamped) : body(make_recipe(is_clamped), {}) {
    Vector6 wrench = Vector6::Zero();
    wrench[0] = 1e3;
    load = body.interfaces[0].motion.spread(wrench);
    const flexbody::Support& support = body.support;
    force = flexbody::take_rows(load, support.free_nodes);
    const dense::Eigenpairs pairs = dense::find_eigenpairs(
        MatrixX(support.matrices.K), dense_mass(support.matrices.M_s));
    const Eigen::Index elastic = force.size() - support.R.cols();
    all = {pairs.values.tail(elastic), pairs.vectors.rightCols(elastic)};
  }

  flexbody::MeshedBody body;
  MatrixX load;  // on all nodes [N]
  VectorX force;
  ReducedBasis all;
};

const LoadedBeam& find_beam(bool is_clamped) {
  static const LoadedBeam free(false);
  static const LoadedBeam clamped(true);
  return is_clamped ? clamped : free;
}

class SmoothPulse : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] ReducedBasis expand(int terms) const {
    return flexbody::make_departure_model(beam_.body, beam_.load, terms).basis;
  }
  [[nodiscard]] ReducedBasis take_lowest(int count) const {
    return {all_.lambda.head(count), all_.Phi.leftCols(count)};
  }

  /// Deformation of the tip's nodes during the pulse and ten first periods
  /// after it, in time steps of a hundredth of the period. [m]
  [[nodiscard]] MatrixX respond(const ReducedBasis& basis,
                                double periods) const {
    const double first = 2.0 * M_PI / std::sqrt(all_.lambda[0]);
    std::vector<double> times;
    for (int i = 0; i <= 100.0 * (periods + 10.0); ++i)
      times.push_back(0.01 * first * i);
    const flexbody::ModalResponse response(
        basis.lambda, VectorX::Zero(basis.lambda.size()),
        make_pulse(basis.Phi.transpose() * beam_.force, periods * first), {});
    const std::vector<Eigen::Index> rows = find_tip_rows();
    return basis.Phi(rows, Eigen::all) * response.evaluate(times).eta;
  }

  /// Root mean square over nodes and times, relative.
  [[nodiscard]] double find_error(const ReducedBasis& basis, double periods,
                                  const MatrixX& truth) const {
    return (respond(basis, periods) - truth).norm() / truth.norm();
  }

  [[nodiscard]] std::vector<Eigen::Index> find_tip_rows() const {
    std::vector<Eigen::Index> rows;
    const std::vector<int>& nodes = beam_.body.support.free_nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (std::abs(beam_.body.mesh.x(2, nodes[i]) - 5.0) > 1e-9) continue;
      for (Eigen::Index c = 0; c < 3; ++c)
        rows.push_back(3 * static_cast<Eigen::Index>(i) + c);
    }
    return rows;
  }

  const LoadedBeam& beam_ = find_beam(GetParam());
  const ReducedBasis& all_ = beam_.all;
};
INSTANTIATE_TEST_SUITE_P(Support, SmoothPulse, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

TEST_P(SmoothPulse, FourKrylovVectorsBeatFourEigenmodesTenfoldIfItIsSlow) {
  const MatrixX truth = respond(all_, 10.0);
  const double krylov = find_error(expand(4), 10.0, truth);
  EXPECT_LT(krylov, 0.1 * find_error(take_lowest(4), 10.0, truth));
}

TEST_P(SmoothPulse, FourEigenmodesBeatFourKrylovVectorsIfItIsShort) {
  const MatrixX truth = respond(all_, 0.1);
  EXPECT_LT(find_error(take_lowest(4), 0.1, truth),
            find_error(expand(4), 0.1, truth));
}

}  // namespace
}  // namespace limber::departure_pulse_slow
