// SPDX-License-Identifier: BSD-3-Clause
#include "pulse.hpp"

#include <cmath>
#include <numbers>

#include "beam.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "limber/reduction/modal/krylov.hpp"

namespace limber::bench::departure {
namespace {

constexpr double kPush = 1e3;  // [N]; errors are relative
constexpr double kDropTolerance = 1e-8;
constexpr double kPeriodsAfter = 10.0;
constexpr int kOutputsAPeriod = 100;

flexbody::Recipe make_pushed_recipe(bool is_clamped) {
  flexbody::Recipe recipe = make_recipe();
  if (is_clamped) recipe.clamped_groups = {"root"};
  recipe.interfaces = {
      {"tip", flexbody::GroupNodes{"tip"}, flexbody::Weighting::uniform}};
  return recipe;
}

/// sin^4(pi t / T) = 3/8 - cos(w t) / 2 + cos(2 w t) / 8, w = 2 pi / T.
flexbody::ModalLoads make_pulse(const VectorX& f, double duration) {
  const VectorX zero = VectorX::Zero(f.size());
  const double w = 2.0 * std::numbers::pi / duration;
  flexbody::ModalLoads loads;
  loads.steps.times = {0.0, duration};
  loads.steps.values.resize(f.size(), 2);
  loads.steps.values << 0.375 * f, zero;
  loads.sinusoids = {{w, -0.5 * f, zero, 0.0, duration},
                     {2.0 * w, 0.125 * f, zero, 0.0, duration}};
  return loads;
}

MatrixX join(const MatrixX& left, const MatrixX& right) {
  MatrixX both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace

std::string to_string(Source source) {
  switch (source) {
    case Source::krylov:
      return "Krylov";
    case Source::eigenmodes:
      return "eigenmodes";
    case Source::mixed:
      break;
  }
  return "mixed";
}

PushedBeam::PushedBeam(bool is_clamped)
    : full_(find_full_modes(is_clamped)),
      body_(make_pushed_recipe(is_clamped), {}) {
  Vector6 wrench = Vector6::Zero();
  wrench[0] = kPush;
  load_ = flexbody::take_rows(body_.interfaces[0].motion.spread(wrench),
                              body_.support.free_nodes);
  for (Eigen::Index n = 0; n < full_.x.cols(); ++n) {
    if (!is_at(full_.x(2, n), kLength)) continue;
    for (Eigen::Index c = 0; c < 3; ++c) tip_.push_back(3 * n + c);
  }
  for (const Source source : kSources) {
    bases_.emplace_back();
    for (int count = 1; count <= kMostVectors; ++count)
      bases_.back().push_back(make_basis(source, count));
  }
}

double PushedBeam::first_period() const {
  return 2.0 * std::numbers::pi / std::sqrt(full_.lambda[0]);
}

flexbody::ReducedBasis PushedBeam::make_basis(Source source, int count) const {
  const int eigenmodes = source == Source::krylov       ? 0
                         : source == Source::eigenmodes ? count
                                                        : count / 2;
  MatrixX vectors = full_.Phi.leftCols(eigenmodes);
  if (eigenmodes < count)
    vectors =
        join(flexbody::find_krylov_vectors(body_, body_.inverse.solve(load_),
                                           count - eigenmodes, kDropTolerance),
             vectors);
  return flexbody::make_reduced_basis(vectors, body_.support, kDropTolerance);
}

MatrixX PushedBeam::respond(const flexbody::ReducedBasis& basis,
                            double duration) const {
  const double end = duration + kPeriodsAfter * first_period();
  const int outputs =
      static_cast<int>(kOutputsAPeriod * std::ceil(end / first_period()));
  const flexbody::ModalResponse response(
      basis.lambda, VectorX::Zero(basis.lambda.size()),
      make_pulse(basis.Phi.transpose() * load_, duration), {});
  return basis.Phi(tip_, Eigen::all) *
         response.evaluate(spread_times(end, outputs)).eta;
}

Errors PushedBeam::find_errors(double duration) const {
  const MatrixX truth = respond({full_.lambda, full_.Phi}, duration);
  Errors errors;
  for (std::size_t s = 0; s < kSources.size(); ++s) {
    for (int n = 0; n < kMostVectors; ++n)
      errors(static_cast<Eigen::Index>(s), n) =
          (respond(bases_[s][static_cast<std::size_t>(n)], duration) - truth)
              .norm() /
          truth.norm();
  }
  return errors;
}

}  // namespace limber::bench::departure
