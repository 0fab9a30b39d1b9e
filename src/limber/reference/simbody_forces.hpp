// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reference/mechanism.hpp"
#include "limber/reference/simbody_types.hpp"

/// Force elements that Simbody does not have. Not installed.
namespace limber::reference {

/// A frame on a mobilized body.
struct SimbodyFrame {
  SimTK::MobilizedBody body;
  SimTK::Transform X_LF;
};

/// Bushing of docs/reference/joints.md, from its energy and dissipation.
///
/// Equation   with the principal axes d_i and values D_i of D = tr(Kr) I/2 - Kr
///            V = p' Kt p / 2 + sum D_i (1 - d_i . R_FM d_i),
///            so the moment on M is sum D_i (R_FM d_i) x d_i: a spring between
///            each axis and its image. Dissipation v' Ct v + w' Cr w.
class ChordalBushing : public SimTK::Force::Custom::Implementation {
 public:
  ChordalBushing(const SimbodyFrame& F, const SimbodyFrame& M,
                 const joints::Bushing::Parameters& law);

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  [[nodiscard]] SimTK::Real calcPotentialEnergy(
      const SimTK::State& state) const override;

 private:
  SimbodyFrame F_;
  SimbodyFrame M_;
  SimTK::Mat33 Kt_, Ct_, Cr_;
  SimTK::Vec3 axes_[3];   ///< d_i
  SimTK::Vec3 strength_;  ///< D_i [N m]
};

/// Constraint springs of a universal joint of docs/reference/joints.md.
///
/// Equation   V = kt p' p / 2 + kr h^2 / 2, h = a . b with a on F, b on M;
///            dh/dt = w . (b x a), so the moment on M is
///            -(kr h + cr dh/dt) b x a. Dissipation ct v' v + cr (dh/dt)^2.
class CrossBushing : public SimTK::Force::Custom::Implementation {
 public:
  CrossBushing(const SimbodyFrame& F, const SimbodyFrame& M,
               const joints::UniversalConstraint::Parameters& law);

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  [[nodiscard]] SimTK::Real calcPotentialEnergy(
      const SimTK::State& state) const override;

 private:
  SimbodyFrame F_;
  SimbodyFrame M_;
  joints::UniversalConstraint::Parameters law_;
};

/// Linear spring and damper along a coordinate of M in F.
///
/// Equation   distance: z = e . p. Angle: z = 2 atan2(s, c), s = e . q_v,
///            c = q_0 of the quaternion of R_FM, and
///            dz/dt = w . (c (c e + q_v x e) + s q_v) / (c^2 + s^2)
/// Limits     an angle is taken within half a turn of the spring's rest.
///            @throws NumericalError if a spring is wound by nearly half a
///            turn, beyond which the angle would jump.
class CoordinateSpring : public SimTK::Force::Custom::Implementation {
 public:
  CoordinateSpring(const SimbodyFrame& F, const SimbodyFrame& M,
                   CoordinateElement element);

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  [[nodiscard]] SimTK::Real calcPotentialEnergy(
      const SimTK::State& state) const override;

 private:
  [[nodiscard]] double find_extension(const SimTK::State& state) const;
  [[nodiscard]] bool is_angle() const;

  SimbodyFrame F_;
  SimbodyFrame M_;
  CoordinateElement element_;
};

/// The interval between two jumps that is being integrated. Loads take the
/// right limit at its begin and the left one at its end.
struct Interval {
  double begin = 0.0;  ///< [s]
  double end = 0.0;    ///< [s]

  [[nodiscard]] Side side(double t) const {
    return t >= end ? Side::left : Side::right;
  }
};

/// A load at a fixed point of its body. `interval` must outlive the element.
class TimedLoad : public SimTK::Force::Custom::Implementation {
 public:
  TimedLoad(const SimTK::MobilizedBody& body, const LoadElement& load,
            const Interval& interval);

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  [[nodiscard]] SimTK::Real calcPotentialEnergy(
      const SimTK::State& /*state*/) const override {
    return 0.0;
  }

 private:
  SimTK::MobilizedBody body_;
  LoadElement load_;
  const Interval& interval_;
};

/// A piecewise constant force and moment, expressed in frame B.
class SteppedLoad : public SimTK::Force::Custom::Implementation {
 public:
  SteppedLoad(const SimbodyFrame& B, flexbody::NodalLoad history,
              const Interval& interval);

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  [[nodiscard]] SimTK::Real calcPotentialEnergy(
      const SimTK::State& /*state*/) const override {
    return 0.0;
  }

 private:
  SimbodyFrame B_;
  flexbody::NodalLoad history_;
  const Interval& interval_;
};

}  // namespace limber::reference
