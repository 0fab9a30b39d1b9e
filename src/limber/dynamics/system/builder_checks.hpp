// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/modal_damping.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/nodal_load.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Checks of SystemBuilder. Each throws InputError for a value outside its
/// range and ContractError for an invalid index or a wrong size, naming the
/// object.
namespace limber::dynamics {

/// @param what names the object, such as "body 'arm'"
/// @param mass [kg]
/// @param inertia [kg m^2]
void check_inertia(const std::string& what, double mass,
                   const Matrix3& inertia);

/// Mass, inertia, and if `has_modes` the eigenvalues and all sizes.
void check_reduced(const std::string& what,
                   const flexbody::ReducedBody& reduced, bool has_modes);

/// @throws InputError for a level whose inertia its matrices do not determine
void check_level(const std::string& what, const flexbody::ReducedBody& reduced,
                 Fidelity fidelity);

/// Shape integrals: sizes, and every entry finite.
void check_integrals(const std::string& what,
                     const flexbody::ReducedBody& reduced);

/// Number of modes, and damping that is possible with them.
void check_elasticity(const std::string& what,
                      const flexbody::ModalElasticity& elasticity, int modes,
                      const ModalDamping& damping);

/// Second-order tables, for level nonlinear.
void check_manifold(const std::string& what,
                    const flexbody::ReducedBody& reduced, bool has_elasticity);
/// The same of an interface on such a body. @param paired number of modes
void check_second_order(const std::string& what,
                        const flexbody::InterfaceTable& interface,
                        std::size_t paired);

/// Rates of a body's modes [1/s]. @param lambda [rad^2/s^2]
[[nodiscard]] VectorX check_damping(const std::string& what,
                                    const ModalDamping& damping,
                                    const VectorX& lambda);

/// Checks that rows are the nodes of a full body, in the mesh's order.
void check_same_nodes(const std::string& what,
                      const flexbody::ReducedBody& reduced,
                      const flexbody::FullBody& full);

void check_index(const std::string& what, const std::string& kind, int index,
                 std::size_t count);

/// Finite, and a rotation.
void check_pose(const std::string& what, const Pose& pose);

void check_interface(const std::string& what,
                     const flexbody::InterfaceTable& interface,
                     Eigen::Index modes);

void check_nodes(const std::string& what, const flexbody::NodeSet& nodes,
                 Eigen::Index node_count);

void check_joint_sum(const std::string& what, const JointSum& sum,
                     const SystemModel& model);

/// Also that its inputs are in the model, and written by no other controller.
void check_controller(const std::string& what,
                      const ControllerModel& controller,
                      const SystemModel& model);
/// Two different bodies.
void check_pair_bodies(const std::string& what, BodyIndex body_A,
                       BodyIndex body_B);

/// @param modes of the body, with products (count_coordinates)
void check_nodal_load(const std::string& what,
                      const flexbody::NodalLoad& history, Eigen::Index modes);

}  // namespace limber::dynamics
