// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/pad_contact.hpp"

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Share of the surface's own flexibility that keeps the law definite without
// residual flexibility [-].
constexpr double kShare = 1e-3;
// Depth of a pad that does not touch [m].
constexpr double kFar = -1.0;

MatrixX calc_compliance(const flexbody::ContactPads& pads,
                        const SurfaceMaterial& material) {
  const double nu = material.poisson_ratio;
  return calc_half_space_compliance(pads.x_B, pads.area,
                                    material.youngs_modulus / (1.0 - nu * nu));
}

// Weights of the pads at a place between them, by the inverse square of the
// distance; their sum is 1.
PadLaw::Vector weigh(const Matrix3X& pads_x_B, const Vector3& x_B) {
  PadLaw::Vector weights(pads_x_B.cols());
  for (Eigen::Index i = 0; i < pads_x_B.cols(); ++i) {
    const double square = (pads_x_B.col(i) - x_B).squaredNorm();
    if (!(square > 0.0)) {
      weights.setZero();
      weights[i] = 1.0;
      return weights;
    }
    weights[i] = 1.0 / square;
  }
  return weights / weights.sum();
}

}  // namespace

PadContact::PadContact(PadLaw law, const flexbody::ContactPads& pads,
                       VectorX own)
    : law_(std::move(law)), area_(pads.area), own_(std::move(own)) {}

std::optional<PadContact> PadContact::make(
    const ShapePair& shapes, const SurfaceSide& A, const SurfaceSide& B,
    const ContactParameters& parameters) {
  if (shapes.pad_count() == 0) return std::nullopt;
  if (parameters.radius || parameters.stiffness) {
    throw InputError(
        "contact: a flat surface on a plane has neither a radius nor a "
        "stiffness of Hertz's law; leave out 'radius' and 'stiffness'");
  }
  const SurfaceSide& own = shapes.has_pads_on_A() ? A : B;
  const SurfaceSide& other = shapes.has_pads_on_A() ? B : A;
  const flexbody::ContactPads& pads = find_flat(own.shape)->surface().pads;
  const Skin* opposite = find_flat(other.shape);
  MatrixX C = pads.flexibility;
  VectorX D = C.diagonal();
  if (own.material) D = calc_compliance(pads, *own.material).diagonal();
  C.diagonal() += kShare * D;
  double common = 0.0;
  if (opposite != nullptr) {
    common = opposite->surface().pads.flexibility.mean();
  } else if (other.material) {
    C += calc_compliance(pads, *other.material);
  }
  PadContact contact(PadLaw(C, common), pads, D);
  contact.is_on_A_ = shapes.has_pads_on_A();
  if (opposite != nullptr) {
    contact.opposite_x_B_ = opposite->surface().pads.x_B;
    contact.opposite_ = opposite->surface().pads.flexibility;
  }
  return contact;
}

PadLaw::Matrix PadContact::find_opposite_compliance(
    std::span<const Meeting> pads) const {
  const auto k = static_cast<Eigen::Index>(pads.size());
  PadLaw::Matrix added = PadLaw::Matrix::Zero(k, k);
  if (opposite_.size() == 0) return added;
  PadLaw::Matrix N = PadLaw::Matrix::Zero(opposite_.rows(), k);
  for (std::size_t i = 0; i < pads.size(); ++i) {
    if (!std::isfinite(pads[i].depth)) continue;
    const SurfacePlace& place = is_on_A_ ? pads[i].on_B : pads[i].on_A;
    N.col(static_cast<Eigen::Index>(i)) = weigh(opposite_x_B_, place.x_B);
  }
  const PadLaw::Matrix moved = opposite_ * N;
  added.noalias() = N.transpose() * moved;
  return added;
}

void PadContact::evaluate(std::span<const Meeting> meetings,
                          PadLaw::Response& out) const {
  const auto pads = meetings.first(count());
  PadLaw::Matrix added = find_opposite_compliance(pads);
  PadLaw::Vector depths(law_.count());
  for (std::size_t i = 0; i < pads.size(); ++i) {
    const auto pad = static_cast<Eigen::Index>(i);
    const Meeting& meeting = pads[i];
    const bool is_far = meeting.depth == Meeting{}.depth;
    depths[pad] = is_far ? kFar : meeting.depth;
    if (!is_far) added(pad, pad) += own_[pad] * (1.0 / meeting.share - 1.0);
  }
  law_.evaluate(depths, added, out);
}

}  // namespace limber::contact
