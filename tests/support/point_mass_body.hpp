// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::testing {

/// A cloud of point masses with made-up mode shapes that obey the rules of a
/// reduced basis. Its shape integrals are plain sums, so that every claim
/// about them can be checked against the masses themselves.
struct PointMassBody {
  VectorX masses;                 ///< n [kg]
  flexbody::ReducedBody reduced;  ///< rows: every mass
};

/// `length` [m] is the body's extent along z (a third of it across), `mass`
/// [kg]; modes get the frequencies `lowest` * (1, 1.5, 2, ...) [rad/s].
PointMassBody make_point_mass_body(int nodes, int modes, double mass,
                                   double length, double lowest, unsigned seed);

/// Least-squares motion of the nodes [first, last) as an interface.
flexbody::InterfaceTable make_interface(const PointMassBody& body, int first,
                                        int last);

std::shared_ptr<const flexbody::ReducedBody> share(const PointMassBody& body);

}  // namespace limber::testing
