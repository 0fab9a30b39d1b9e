// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/pads_on_plane.hpp"

#include "limber/common/errors.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Of the surface's own flexibility, which keeps the law definite where the
// basis leaves nothing out [-].
constexpr double kShare = 1e-3;

const flexbody::ContactPads* pads_of(const Shape& shape) {
  const auto* skin = std::get_if<std::shared_ptr<const Skin>>(&shape.kind);
  if (skin == nullptr || (*skin)->pad_count() == 0) return nullptr;
  return &(*skin)->surface().pads;
}

bool is_plane(const Shape& shape) {
  return std::holds_alternative<HalfSpace>(shape.kind);
}

MatrixX calc_compliance(const flexbody::ContactPads& pads,
                        const SurfaceMaterial& material) {
  const double nu = material.poisson_ratio;
  return calc_half_space_compliance(pads.x_B, pads.area,
                                    material.youngs_modulus / (1.0 - nu * nu));
}

}  // namespace

const flexbody::ContactPads* find_pads(const Shape& A, const Shape& B) {
  if (is_plane(A)) return pads_of(B);
  return is_plane(B) ? pads_of(A) : nullptr;
}

std::optional<PadLaw> make_pad_law(const SurfaceSide& A, const SurfaceSide& B,
                                   const ContactParameters& parameters) {
  const flexbody::ContactPads* pads = find_pads(A.shape, B.shape);
  if (pads == nullptr) return std::nullopt;
  if (parameters.radius || parameters.stiffness) {
    throw InputError(
        "contact: a flat surface on a plane has neither a radius nor a "
        "stiffness of Hertz's law; leave out 'radius' and 'stiffness'");
  }
  const auto& plane = is_plane(A.shape) ? A.material : B.material;
  const auto& own = is_plane(A.shape) ? B.material : A.material;
  MatrixX C = pads->flexibility;
  VectorX rest = C.diagonal();
  if (own) rest = calc_compliance(*pads, *own).diagonal();
  C.diagonal() += kShare * rest;
  if (plane) C += calc_compliance(*pads, *plane);
  return PadLaw(C);
}

PadLaw::Vector list_depths(std::span<const Meeting> meetings) {
  PadLaw::Vector depths(static_cast<Eigen::Index>(meetings.size()));
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    depths[static_cast<Eigen::Index>(i)] = meetings[i].depth;
  }
  return depths;
}

}  // namespace limber::contact
