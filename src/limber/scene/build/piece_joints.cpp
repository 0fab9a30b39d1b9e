// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/piece_joints.hpp"

#include <fmt/format.h>

#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/flexbody/modal/piece_assembly.hpp"
#include "limber/flexbody/model/piece.hpp"

namespace limber::scene {
namespace {

using flexbody::InterfaceTable;

/// A cut's frame on one of its pieces.
AttachmentSite find_cut_site(const AttachmentSites& sites, int link, int piece,
                             const InterfaceTable& table) {
  Anchor anchor;
  anchor.piece = piece;
  anchor.table = table;
  const Pose X_BL = sites.X_BL(link, piece);
  // The axes of the mesh, in which flexibilities are expressed.
  const Pose X_LF = X_BL.inverse() * Pose{Matrix3::Identity(), table.p_B};
  return sites.find_site(link, X_LF, anchor);
}

const InterfaceTable* find_cut(const BodyPlan& plan, const std::string& name) {
  for (const InterfaceTable& table : plan.reduced->interfaces) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

/// "arm.1/arm.2", with the number of a further cut between the two.
std::string name_joint(const BodyPlan& first, const BodyPlan& second,
                       const std::string& cut) {
  const std::size_t dot = cut.find('.');
  const std::string number = dot == std::string::npos ? "" : cut.substr(dot);
  return fmt::format("{}/{}{}", first.name, second.name, number);
}

}  // namespace

joints::Bushing make_cut_bushing(const Matrix6& F, const Matrix6& M,
                                 const dynamics::ModalDamping& damping) {
  const Matrix6 K = flexbody::calc_cut_stiffness(F, M);
  joints::Bushing::Parameters parameters;
  parameters.translational_stiffness = K.topLeftCorner<3, 3>();
  parameters.rotational_stiffness = K.bottomRightCorner<3, 3>();
  parameters.coupling_stiffness = K.topRightCorner<3, 3>();
  const double fraction = damping.rayleigh_stiffness;
  parameters.translational_damping =
      fraction * parameters.translational_stiffness;
  parameters.rotational_damping = fraction * parameters.rotational_stiffness;
  parameters.coupling_damping = fraction * parameters.coupling_stiffness;
  return joints::Bushing(parameters);
}

void add_piece_joints(const Scene& scene, const BodyPlans& plans,
                      const AttachmentSites& sites,
                      dynamics::SystemBuilder& builder) {
  for (std::size_t b = 0; b < plans.bodies.size(); ++b) {
    const BodyPlan& second = plans.bodies[b];
    if (second.piece == 0) continue;
    const int link = second.links.front();
    const Link& source = scene.robot.links[index(link)];
    for (const BodyPlan& first :
         sites.pieces_of(link).first(index(second.piece))) {
      for (const InterfaceTable& table : second.reduced->interfaces) {
        const InterfaceTable* other = find_cut(first, table.name);
        if (!flexbody::is_cut(table.name) || other == nullptr) continue;
        const std::string name = name_joint(first, second, table.name);
        const AttachmentSite F =
            find_cut_site(sites, link, first.piece, *other);
        const AttachmentSite M =
            find_cut_site(sites, link, second.piece, table);
        builder.add_coupler(
            name,
            make_cut_bushing(other->flexibility, table.flexibility,
                             source.flexible->damping),
            attach(name + ".F", F, builder), attach(name + ".M", M, builder));
      }
    }
  }
}

}  // namespace limber::scene
