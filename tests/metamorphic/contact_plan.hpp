// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/patches/contact_side.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "metamorphic/random_draw.hpp"

/// Random bodies that strike each other, of all pairs of shapes, as data.
namespace limber::metamorphic {

struct StrikingBody {
  std::string name;
  contact::Shape shape;  ///< a half space: the world
  std::optional<contact::SurfaceMaterial> material = {};
  double mass = 0.0;                    ///< [kg]
  Vector3 inertia_B = Vector3::Zero();  ///< principal moments [kg m^2]
  Pose X_WB = {};                       ///< at the start
  Vector3 v_WB_W = Vector3::Zero();     ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();     ///< [rad/s]
  [[nodiscard]] bool is_world() const;
};

struct ContactPlan {
  std::vector<StrikingBody> bodies;  ///< two
  contact::ContactParameters parameters;
  Vector3 gravity_W = Vector3::Zero();  ///< [m/s^2]
  dynamics::SimulationSettings settings;
  bool is_swapped = false;   ///< the second body is side A of the contact
  bool is_reversed = false;  ///< the second body is added first
  bool has_twin = false;     ///< the same again, far away and later
  std::string description;
};

/// A scene of a seed, which strikes. Every third has a half space, every
/// second friction; sizes of 2 to 50 cm, speeds of 0.05 to 5 m/s. Every fifth
/// is without materials, as many have a stiffness, or a damping, of their own.
[[nodiscard]] ContactPlan draw_contact(unsigned seed);

/// What became of it at the end.
struct Strike {
  struct Body {
    Pose X_WB;
    Vector3 v_WB_W = Vector3::Zero();  ///< [m/s]
    Vector3 w_WB_B = Vector3::Zero();  ///< [rad/s]
  };
  std::vector<Body> bodies;  ///< in the order of the plan
  dynamics::RunRecord record;
  long steps = 0;  ///< count
  std::size_t events = 0;
  bool has_halved_steps = false;
  std::string refusal;  ///< the message, if the run did not finish
};

[[nodiscard]] Strike run(const ContactPlan& plan);

/// Linear and angular momentum about the world's origin.
struct Momenta {
  Vector3 linear = Vector3::Zero();   ///< [N s]
  Vector3 angular = Vector3::Zero();  ///< [N m s]
};
[[nodiscard]] Momenta find_momenta(const ContactPlan& plan,
                                   const std::vector<Strike::Body>& bodies);
/// As at the end, of the start.
[[nodiscard]] std::vector<Strike::Body> find_start(const ContactPlan& plan);

}  // namespace limber::metamorphic
