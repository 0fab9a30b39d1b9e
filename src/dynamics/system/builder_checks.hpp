// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "dynamics/system_builder.hpp"

/// What SystemBuilder checks. Each throws InputError for a value outside its
/// range and ContractError for a foreign index or a wrong size, naming the
/// thing.
namespace limber::dynamics {

/// @param what names the thing, as "body 'arm'"
void check_inertia(const std::string& what, double mass,
                   const Matrix3& inertia);

/// Mass, inertia, and where `has_modes` the eigenvalues and all sizes.
void check_reduced(const std::string& what,
                   const flexbody::ReducedBody& reduced, bool has_modes);

/// Shape integrals: sizes, and every entry finite.
void check_integrals(const std::string& what,
                     const flexbody::ReducedBody& reduced);

/// Rates of a body's modes [1/s]. @param lambda [rad^2/s^2]
[[nodiscard]] VectorX check_damping(const std::string& what,
                                    const ModalDamping& damping,
                                    const VectorX& lambda);

/// Rows of a full body are its nodes, in the mesh's order.
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

/// @param modes of the body
void check_nodal_load(const std::string& what,
                      const flexbody::NodalLoad& history, Eigen::Index modes);

}  // namespace limber::dynamics
