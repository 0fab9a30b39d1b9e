// SPDX-License-Identifier: BSD-3-Clause
#include "cell.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/reduction/reduce.hpp"

namespace limber::bench {
namespace {

constexpr double kYoung = 70e9;      // [Pa]
constexpr double kPoisson = 0.3;     // [-]
constexpr double kDensity = 2700.0;  // [kg/m^3]
constexpr int kOutputs = 10;         // after the start

// Mostly about the beams' long axis, so that long chains are not torn apart.
const Vector3 kSpinAxis = Vector3(0.1, 0.0, 1.0).normalized();

Shape find_shape(const Cell& cell, int body) {
  const double ratio = body % 2 == 1 ? cell.mass_ratio : 1.0;
  return {cell.length, cell.slenderness, kDensity * ratio};
}

// A bar of unit length along z; the recipe's unit gives it its size.
void write_geometry(double slenderness, const std::filesystem::path& file) {
  const int across = slenderness < 3.0 ? 3 : 1;
  const int along = std::clamp(static_cast<int>(2.0 * slenderness), 3, 20);
  std::ofstream out(file);
  out << fmt::format(R"(w = {:.17g};
Point(1) = {{0, 0, 0}};
Point(2) = {{w, 0, 0}};
Point(3) = {{w, w, 0}};
Point(4) = {{0, w, 0}};
Line(1) = {{1, 2}};
Line(2) = {{2, 3}};
Line(3) = {{3, 4}};
Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
Transfinite Curve {{1, 2, 3, 4}} = {};
Transfinite Surface {{1}};
Recombine Surface {{1}};
swept[] = Extrude {{0, 0, 1}} {{
  Surface{{1}}; Layers{{{}}}; Recombine;
}};
Physical Surface("root") = {{1}};
Physical Surface("tip") = {{swept[0]}};
Physical Volume("body") = {{swept[1]}};
)",
                     1.0 / slenderness, across + 1, along);
}

joints::Bushing make_hinge(const Cell& cell, double mass) {
  const double k = cell.stiffness;
  const double c = 2.0 * cell.damping * std::sqrt(k * mass);
  const double squared = cell.length * cell.length;
  return joints::make_joint_bushing(joints::JointKind::revolute,
                                    Vector3::UnitX(),
                                    {.translational_stiffness = k,
                                     .rotational_stiffness = k * squared,
                                     .translational_damping = c,
                                     .rotational_damping = c * squared});
}

// Bends a beam by some 2 mm a metre of length if it acts on.
Vector3 find_blow(const Cell& cell) {
  const double slenderness = cell.slenderness;
  const double EI_over_length_squared =
      kYoung * cell.length * cell.length / (12.0 * std::pow(slenderness, 4));
  return 5e-3 * EI_over_length_squared * Vector3(0.6, 0.8, 0.3);
}

dynamics::SystemModel make_model(const Cell& cell, const Beams& beams) {
  dynamics::SystemBuilder builder;
  const double mass = beams.find(find_shape(cell, 0))->mass;
  dynamics::AttachmentIndex tip;
  for (int i = 0; i < cell.bodies; ++i) {
    const Beams::Body body = beams.find(find_shape(cell, i));
    const auto b = builder.add_flexible_body(fmt::format("beam{}", i), body,
                                             dynamics::Fidelity::coupled,
                                             {.ratios = {cell.damping}});
    const auto attach = [&](std::size_t end) {
      const flexbody::InterfaceTable& table = body->interfaces[end];
      return builder.attach_interface(fmt::format("{}{}", table.name, i), b,
                                      table, {Matrix3::Identity(), table.p_B});
    };
    const auto root = attach(0);
    if (i > 0) {
      builder.add_coupler(fmt::format("hinge{}", i), make_hinge(cell, mass),
                          tip, root);
    }
    tip = attach(1);
  }
  dynamics::Pulse pulse;
  pulse.shape = dynamics::PulseShape::half_sine;
  pulse.duration = cell.pulse > 0.0 ? cell.pulse : 0.05 * find_time_scale(cell);
  builder.add_load("blow", tip, find_blow(cell), Vector3::Zero(),
                   dynamics::LoadFrame::world, pulse);
  return builder.build();
}

// Of the softest body [rad/s].
double find_critical_speed(const dynamics::SystemModel& model) {
  double lowest = INFINITY;
  for (std::size_t b = 0; b < std::min<std::size_t>(2, model.bodies.size());
       ++b) {
    const dynamics::BodyModel& body = model.bodies[b];
    const double fast = std::sqrt(body.reduced->lambda.maxCoeff());
    const double mu = dynamics::find_softening(body, fast * kSpinAxis);
    lowest = std::min(lowest, fast / std::sqrt(mu));
  }
  return lowest;
}

// In line along z, turning as one about the middle.
dynamics::SystemState make_start(const Cell& cell,
                                 const dynamics::SystemModel& model) {
  dynamics::SystemState state = dynamics::make_state(model);
  const Vector3 w =
      cell.spin == 0.0
          ? Vector3(Vector3::Zero())
          : Vector3(cell.spin * find_critical_speed(model) * kSpinAxis);
  for (int i = 0; i < cell.bodies; ++i) {
    dynamics::BodyState& body = state.bodies[static_cast<std::size_t>(i)];
    body.p_WB = cell.length * (i - 0.5 * (cell.bodies - 1)) * Vector3::UnitZ();
    body.v_WB_W = w.cross(body.p_WB);
    body.w_WB_B = w;
  }
  return state;
}

}  // namespace

double find_time_scale(const Cell& cell) {
  constexpr double kOfOneMetre = 0.02;  // at a slenderness of 10 [s/m]
  return kOfOneMetre * cell.length * cell.slenderness / 10.0;
}

double find_span(const Cell& cell) {
  const double wanted = std::max(find_time_scale(cell), 10.0 * cell.step);
  return std::min(wanted, cell.most_steps * cell.step);
}

std::string describe(const Cell& cell) {
  return fmt::format(
      "{}, step {:g} s, {} bodies of {:g} m, slenderness {:g}, mass ratio "
      "{:g}, hinges of {:g} N/m, damping ratio {:g}, spin {:g} of critical, "
      "pulse {}, {:g} s",
      dynamics::to_string(cell.integrator), cell.step, cell.bodies, cell.length,
      cell.slenderness, cell.mass_ratio, cell.stiffness, cell.damping,
      cell.spin,
      cell.pulse > 0.0 ? fmt::format("{:g} s", cell.pulse) : "as usual",
      find_span(cell));
}

Beams::Beams()
    : folder_(std::filesystem::temp_directory_path() /
              fmt::format("limber-extremes-{}", getpid())) {
  std::filesystem::create_directories(folder_);
}

Beams::~Beams() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Beams::Answer Beams::reduce(const Shape& shape) const {
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file = folder_ / fmt::format("beam{:g}.geo", shape.slenderness);
  recipe.mesh.unit = shape.length;
  recipe.materials = {{"", {kYoung, kPoisson, shape.density}}};
  for (const char* end : {"root", "tip"}) {
    recipe.interfaces.push_back({end, flexbody::GroupNodes{end}});
  }
  recipe.basis.eigenmodes = 4;
  write_geometry(shape.slenderness, recipe.mesh.file);
  try {
    return {
        std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe)),
        ""};
  } catch (const InputError& error) {
    return {nullptr, error.what()};
  } catch (const NumericalError& error) {
    return {nullptr, error.what()};
  }
}

void Beams::prepare(const Cell& cell) {
  for (int i = 0; i < std::min(2, cell.bodies); ++i) {
    const Shape shape = find_shape(cell, i);
    if (!known_.contains(shape)) known_[shape] = reduce(shape);
  }
}

Beams::Body Beams::find(const Shape& shape) const {
  const Answer& answer = known_.at(shape);
  if (!answer.body) throw InputError(answer.refusal);
  return answer.body;
}

Scene make_scene(const Cell& cell, const Beams& beams) {
  Scene scene{make_model(cell, beams), {}, {}};
  scene.state = make_start(cell, scene.model);
  const double end = find_span(cell);
  scene.settings.integrator = cell.integrator;
  scene.settings.step = cell.step;
  scene.settings.end_time = end;
  for (int i = 0; i <= kOutputs; ++i) {
    scene.settings.output_times.push_back(end * i / kOutputs);
  }
  return scene;
}

}  // namespace limber::bench
