// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/default_stiffness.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

using dynamics::CarriedLoad;

/// Estimates the loads of joints from the scene's files, for default stiffness.
///
/// Equation   force  = sum_i m_i (w^2 r_i + g) + sum_l |f_l|,
///            moment = sum_i m_i (w^2 r_i + g) d_i + sum_l (|f_l| d_l + |t_l|),
///            for the bodies i and loads l outboard of the joint, or of the
///            whole connected group if it has loops; d the distance from the
///            joint, r_i the largest distance of body i's centre of mass from a
///            joint between it and the root; w, for the connected group, the
///            largest angular speed of a link at the start or the largest sum
///            of commanded drive speeds along a path from the root
/// Limits     an upper bound if all rotate as one, else an estimate: neglects
///            speeds due to loads or effort drives, shocks such as contacts,
///            inertial loads by drives, and outputs of controllers without
///            limits.
class CarriedLoads {
 public:
  CarriedLoads(const Scene& scene, const BodyPlans& plans,
               const std::vector<LinkMotion>& start);

  /// Load of a joint of the tree.
  [[nodiscard]] CarriedLoad of_joint(int joint) const;
  /// Load of a loop's joint.
  [[nodiscard]] CarriedLoad of_loop(const Loop& loop) const;

 private:
  struct Part {
    int link = 0;
    double force = 0.0;   // [N]
    double moment = 0.0;  // [N m]
    Vector3 at = Vector3::Zero();
  };
  void find_frames();
  void find_parts();
  [[nodiscard]] double find_speed(int tree) const;
  [[nodiscard]] Vector3 place(const Place& where) const;
  [[nodiscard]] bool is_of_tree(int link) const;
  [[nodiscard]] bool is_in(const Loop& loop, int tree) const;
  [[nodiscard]] bool is_beyond(int link, int joint) const;
  [[nodiscard]] bool is_carried(const Part& part, int joint) const;
  [[nodiscard]] Vector3 find_centre(const BodyPlan& plan) const;
  [[nodiscard]] double find_radius(int link, const Vector3& centre) const;
  [[nodiscard]] double find_size(int link) const;
  void add(const Part& part, const Vector3& at, CarriedLoad& sum) const;

  const Scene& scene_;
  const BodyPlans& plans_;
  const std::vector<LinkMotion>& start_;
  std::vector<std::vector<Vector3>> frames_;  // of couplers, one per plan
  std::vector<int> trees_;  // one per link: a link of what it is held with
  std::vector<Part> parts_;
};

}  // namespace limber::scene
