// SPDX-License-Identifier: BSD-3-Clause
#include "unit/joints/coupler_cases.hpp"

#include <cmath>
#include <utility>

#include "limber/common/rotation.hpp"

namespace limber::testing {
namespace {

using namespace joints;

// Two axes normal to each other, none of them a coordinate axis.
const Vector3 kAxis = Vector3(1.0, -2.0, 0.5).normalized();
const Vector3 kSecond = kAxis.cross(Vector3(0.3, 0.4, -1.0)).normalized();

constexpr JointParameters kStiff{.translational_stiffness = 300.0,
                                 .rotational_stiffness = 40.0,
                                 .translational_damping = 3.0,
                                 .rotational_damping = 0.4,
                                 .free_damping = 0.2};

Matrix3 random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix3 a;
  for (double& x : a.reshaped()) x = uniform(random);
  return a;
}

// Full 6 x 6 matrices of stiffness and damping.
CouplerLaw full_bushing(const Matrix3& Q) {
  std::mt19937 random(7);
  const auto draw = [&](double scale, Matrix3& t, Matrix3& r, Matrix3& c) {
    const Matrix3 a = Q * random_matrix(random);
    const Matrix3 b = Q * random_matrix(random);
    const Matrix3 d = Q * random_matrix(random);
    const Matrix3 e = Q * random_matrix(random);
    t = scale * (a * a.transpose() + b * b.transpose());
    r = scale * (d * d.transpose() + e * e.transpose());
    c = scale * (a * d.transpose() + b * e.transpose());
  };
  Bushing::Parameters p;
  draw(50.0, p.translational_stiffness, p.rotational_stiffness,
       p.coupling_stiffness);
  draw(1.0, p.translational_damping, p.rotational_damping, p.coupling_damping);
  return Bushing(p);
}

CouplerLaw closed_latch(const Matrix3& Q) {
  const auto bushing = std::get<Bushing>(full_bushing(Q)).parameters();
  return Latch({.reach = 0.1, .bushing = bushing});
}

using Make = std::function<CouplerLaw(const Matrix3&)>;

Make spring(const PointSpring::Parameters& parameters) {
  return [law = PointSpring(parameters)](const Matrix3&) { return law; };
}

Make bushing(JointKind kind) {
  return [kind](const Matrix3& Q) {
    return make_joint_bushing(kind, Q * kAxis, kStiff);
  };
}

Joint turned_joint(const Joint& joint, const Joint::Constraint& constraint,
                   const Matrix3& Q) {
  std::vector<AxisCoordinate> coordinates = joint.coordinates();
  for (AxisCoordinate& c : coordinates) c.axis = Q * c.axis;
  return {constraint, coordinates, joint.elements()};
}

// The coordinates turn with Q also where make_joint chooses them.
Make joint(JointKind kind, const std::vector<JointElement>& elements) {
  return [=](const Matrix3& Q) {
    return turned_joint(
        make_joint(kind, kAxis, kSecond, kStiff, elements),
        make_joint(kind, Q * kAxis, Q * kSecond, kStiff).constraint(), Q);
  };
}

// Nothing held: what acts along an angle alone.
Make angle(const std::vector<JointElement>& elements) {
  return [=](const Matrix3& Q) {
    return Joint(Bushing({}), {{AxisCoordinate::Kind::angle, Q * kAxis}},
                 elements);
  };
}

ScalarSpring stiff_spring() {
  return ScalarSpring(
      {.curve = SpringCurve({.stiffness = 30.0, .quadratic = 8.0}),
       .damping = 0.6});
}
Friction friction() {
  return Friction({.coulomb = 4.0, .viscous = 0.5, .speed = 0.3});
}
EndStop stop() {
  return EndStop(
      {.lower = -0.5, .upper = 0.5, .stiffness = 200.0, .damping = 0.4});
}
ScalarSpring line() {
  return ScalarSpring({.curve = SpringCurve({.stiffness = 90.0}),
                       .damping = 4.0,
                       .tension_only = true});
}

// From 1.5 to nothing between 0.2 s and 1.9 s.
Signal command() {
  return {RampSignal{.from = 1.5,
                     .start = 0.2,
                     .duration = 1.4,
                     .shape = RampShape::trapezoid},
          {{0.6, 0.0}, {0.4, 0.3}}};
}
Drive drive(DriveMode mode) {
  return Drive({.mode = mode,
                .signal = command(),
                .stiffness = 60.0,
                .damping = 5.0,
                .max_effort = 70.0,
                .max_speed = 2.5});
}

}  // namespace

std::vector<CouplerCase> coupler_cases() {
  using enum JointKind;
  using enum Ends;
  const auto on = [](int coordinate, const ScalarLaw& law) {
    return JointElement{coordinate, law};
  };
  const JointElement position = on(0, drive(DriveMode::position));
  const JointElement velocity = on(0, drive(DriveMode::velocity));
  const JointElement effort = on(0, drive(DriveMode::effort));
  RelativeMotion apart;
  apart.p_FM_F = Vector3(0.0, 0.42, -0.56);  // 0.7 m
  const std::vector<double> x{-0.3, 0.0, 0.4, 1.1};
  const std::vector<double> f{-40.0, 0.0, 10.0, 90.0};

  return {
      {"full bushing", full_bushing},
      {"fixed bushing", bushing(fixed), fixed, same_at_rest},
      {"ball bushing", bushing(ball), ball, same_at_rest},
      {"planar bushing", bushing(planar), planar},
      {"linear spring",
       spring({.stiffness = 200.0, .damping = 3.0, .free_length = 0.7}),
       floating, same, apart},
      {"quadratic spring", spring({.free_length = 0.7, .quadratic = 150.0}),
       floating, same, apart, Parts::spring},
      {"tabulated spring",
       spring(
           {.damping = 2.0, .free_length = 0.7, .extensions = x, .forces = f}),
       floating, same, apart},
      {"tension-only spring",
       spring({.stiffness = 200.0,
               .damping = 30.0,
               .free_length = 0.7,
               .tension_only = true}),
       floating, same, apart},
      {"spring without length",
       spring({.stiffness = 200.0, .damping = 3.0, .quadratic = 40.0}),
       floating, same_at_rest},
      {"closed latch", closed_latch, floating, differ, apart},
      {"fixed", joint(fixed, {}), fixed, same_at_rest},
      {"revolute", joint(revolute, {}), revolute, same_at_rest},
      {"continuous", joint(continuous, {}), continuous, same_at_rest},
      {"prismatic", joint(prismatic, {}), prismatic},
      {"planar", joint(planar, {}), planar},
      {"universal", joint(universal, {}), universal},
      {"ball", joint(ball, {}), ball, same_at_rest},
      {"floating", joint(floating, {}), floating, differ, {}, Parts::damper},
      {"revolute, spring", joint(revolute, {on(0, stiff_spring())}), revolute,
       same_at_rest},
      {"revolute, friction", joint(revolute, {on(0, friction())}), revolute,
       same_at_rest},
      {"revolute, stop", joint(revolute, {on(0, stop())}), revolute,
       same_at_rest},
      {"revolute, position", joint(revolute, {position}), revolute,
       same_at_rest},
      {"revolute, velocity", joint(revolute, {velocity}), revolute,
       same_at_rest},
      {"revolute, effort", joint(revolute, {effort}), revolute, same_at_rest},
      {"prismatic, line", joint(prismatic, {on(0, line())}), prismatic},
      {"prismatic, stop", joint(prismatic, {on(0, stop())}), prismatic},
      {"prismatic, position", joint(prismatic, {position}), prismatic},
      {"prismatic, all",
       joint(prismatic, {on(0, friction()), on(0, stiff_spring()), velocity}),
       prismatic},
      {"planar, three",
       joint(planar, {on(1, friction()), on(2, stiff_spring()), position}),
       planar},
      {"universal, both",
       joint(universal,
             {on(0, stiff_spring()), on(1, stop()), on(1, friction()), effort}),
       universal},
      {"ball, three",
       joint(ball, {on(0, stop()), on(1, friction()), on(2, stiff_spring())}),
       ball, same_at_rest},
      {"angle, all",
       angle({on(0, friction()), on(0, stop()), on(0, stiff_spring())}),
       revolute, same},
  };
}

Vector3 random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return {uniform(random), uniform(random), uniform(random)};
}

RelativeMotion random_motion(JointKind freedom, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto turn = [&](const Vector3& axis) {
    return exp_rotation(3.0 * uniform(random) * axis);
  };
  RelativeMotion m;
  m.R_FM = exp_rotation(0.115 * random_vector(random));
  m.p_FM_F = 0.1 * random_vector(random);
  m.v_FM_F = 1.5 * random_vector(random);
  m.w_FM_F = 1.5 * random_vector(random);
  const Vector3 step = 2.0 * random_vector(random);
  switch (freedom) {
    case JointKind::revolute:
    case JointKind::continuous:
      m.R_FM *= turn(kAxis);
      break;
    case JointKind::prismatic:
      m.p_FM_F += kAxis * kAxis.dot(step);
      break;
    case JointKind::planar:
      m.R_FM *= turn(kAxis);
      m.p_FM_F += step - kAxis * kAxis.dot(step);
      break;
    case JointKind::floating:
      m.p_FM_F += step;
      m.R_FM *= turn(random_vector(random).normalized());
      break;
    case JointKind::universal:
      m.R_FM *= turn(kAxis);
      m.R_FM *= turn(kSecond);
      break;
    case JointKind::ball:
      m.R_FM *= turn(random_vector(random).normalized());
      break;
    case JointKind::fixed:
      break;
  }
  return m;
}

CouplerMemory random_memory(const CouplerLaw& law, const RelativeMotion& motion,
                            std::mt19937& random) {
  std::uniform_int_distribution<int> turns(-3, 3);
  CouplerMemory memory;
  const auto& coordinates = coordinates_of(law);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    memory.near[i] =
        find_position(coordinates[i], motion, 6.2831853 * turns(random));
  }
  memory.latch = LatchStatus::closed;
  memory.X_FM = {exp_rotation(random_vector(random)) * motion.R_FM,
                 motion.p_FM_F + 0.3 * random_vector(random)};
  return memory;
}

RelativeMotion carried(const RelativeMotion& motion, double by) {
  RelativeMotion m = motion;
  m.p_FM_F += by * motion.v_FM_F;
  m.R_FM = exp_rotation(by * motion.w_FM_F) * motion.R_FM;
  return m;
}

RelativeMotion moved(const RelativeMotion& motion, int direction, double by) {
  RelativeMotion m = motion;
  if (direction < 3) {
    m.p_FM_F[direction] += by;
  } else {
    m.R_FM = exp_rotation(by * Vector3::Unit(direction - 3)) * m.R_FM;
  }
  return m;
}

RelativeMotion hastened(const RelativeMotion& motion, int direction,
                        double by) {
  RelativeMotion m = motion;
  (direction < 3 ? m.v_FM_F[direction] : m.w_FM_F[direction - 3]) += by;
  return m;
}

RelativeMotion stilled(RelativeMotion motion) {
  motion.v_FM_F.setZero();
  motion.w_FM_F.setZero();
  return motion;
}

RelativeMotion turned(const RelativeMotion& motion, const Matrix3& Q) {
  RelativeMotion m;
  m.R_FM = Q * motion.R_FM * Q.transpose();
  m.p_FM_F = Q * motion.p_FM_F;
  m.v_FM_F = Q * motion.v_FM_F;
  m.w_FM_F = Q * motion.w_FM_F;
  return m;
}

RelativeMotion exchanged(const RelativeMotion& motion) {
  const Matrix3 R = motion.R_FM.transpose();
  RelativeMotion m;
  m.R_FM = R;
  m.p_FM_F = -R * motion.p_FM_F;
  m.v_FM_F = -R * (motion.v_FM_F - motion.w_FM_F.cross(motion.p_FM_F));
  m.w_FM_F = -R * motion.w_FM_F;
  return m;
}

Vector6 velocity_of(const RelativeMotion& motion) {
  Vector6 v;
  v << motion.v_FM_F, motion.w_FM_F;
  return v;
}

}  // namespace limber::testing
