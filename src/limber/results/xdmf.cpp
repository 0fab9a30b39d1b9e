// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/xdmf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/results/offset.hpp"
#include "limber/results/stress_field.hpp"
#include "limber/results/xdmf_file.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using dynamics::SystemState;

// All surfaces as one mesh: the bodies' rows concatenated.
class Surfaces {
 public:
  explicit Surfaces(const SystemModel& model) : model_(model) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const auto& reduced = model.bodies[b].reduced;
      if (!reduced) continue;
      if (reduced->triangles.empty()) {
        bare_.push_back(model.bodies[b].name);
        continue;
      }
      bodies_.push_back(b);
      full_.push_back(make_full(b));
      has_stress_ = has_stress_ || has_modal_stress(model.bodies[b]) ||
                    full_.back() != nullptr;
    }
  }

  [[nodiscard]] bool is_empty() const { return bodies_.empty(); }
  [[nodiscard]] const std::vector<std::string>& bare() const { return bare_; }

  MovingSurface gather(const History& history) const {
    MovingSurface all;
    all.times = history.times;
    all.has_stress = has_stress_;
    for (const std::size_t b : bodies_) {
      for (const auto& triangle : model_.bodies[b].reduced->triangles) {
        for (const std::size_t corner : triangle) {
          all.corners.push_back(all.nodes + static_cast<std::int64_t>(corner));
        }
      }
      all.nodes += count_rows(b);
    }
    return all;
  }

  SurfaceFrame find_frame(const SystemState& start, const SystemState& state,
                          Eigen::Index nodes) const {
    SurfaceFrame frame{
        Matrix3X(3, nodes), Matrix3X(3, nodes), Matrix3X(3, nodes), {}};
    if (has_stress_) frame.stress.resize(6, nodes);
    Eigen::Index first = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const std::size_t b = bodies_[i];
      const Eigen::Index n = count_rows(b);
      const Matrix3X now = find_positions(b, state);
      frame.points.middleCols(first, n) = now;
      frame.displacement.middleCols(first, n) = now - find_positions(b, start);
      const Matrix3 R_WB = state.bodies[b].quat_WB.toRotationMatrix();
      MatrixX u_B(3 * n, 1);
      calc_node_deformations(model_, static_cast<dynamics::BodyIndex>(b),
                             {&state, 1}, u_B);
      frame.deformation.middleCols(first, n) = R_WB * u_B.reshaped(3, n);
      if (has_stress_) {
        frame.stress.middleCols(first, n) = full_[i]
                                                ? full_[i]->calc_in_world(state)
                                                : find_stress(b, state, R_WB);
      }
      first += n;
    }
    return frame;
  }

 private:
  [[nodiscard]] Eigen::Index count_rows(std::size_t b) const {
    return model_.bodies[b].reduced->rows.x_B.cols();
  }

  [[nodiscard]] Matrix3X find_positions(std::size_t b,
                                        const SystemState& state) const {
    MatrixX nodes(3 * count_rows(b), 1);
    calc_node_positions(model_, static_cast<dynamics::BodyIndex>(b),
                        {&state, 1}, nodes);
    return nodes.reshaped(3, count_rows(b));
  }

  // Null below level `full`.
  [[nodiscard]] std::unique_ptr<FullStressField> make_full(
      std::size_t b) const {
    std::vector<int> all(index(count_rows(b)));
    std::iota(all.begin(), all.end(), 0);
    return FullStressField::make(model_, static_cast<dynamics::BodyIndex>(b),
                                 all);
  }

  // In world axes; at a border of materials that of the first.
  [[nodiscard]] Matrix6X find_stress(std::size_t b, const SystemState& state,
                                     const Matrix3& R_WB) const {
    const BodyModel& body = model_.bodies[b];
    Matrix6X stress_B = Matrix6X::Constant(
        6, count_rows(b), std::numeric_limits<double>::quiet_NaN());
    if (!has_modal_stress(body)) return stress_B;
    const flexbody::StressModes& modes = *body.reduced->stress;
    VectorX coordinates;
    calc_stress_coordinates(body, state, coordinates);
    const VectorX at_points =
        modes.Sigma_B.leftCols(coordinates.size()) * coordinates;
    for (std::size_t i = modes.rows.size(); i-- > 0;) {
      stress_B.col(static_cast<Eigen::Index>(modes.rows[i])) =
          at_points.segment<6>(6 * static_cast<Eigen::Index>(i));
    }
    return rotate_to_world(stress_B, R_WB);
  }

  const SystemModel& model_;
  std::vector<std::size_t> bodies_;                     // with a surface
  std::vector<std::unique_ptr<FullStressField>> full_;  // one for each
  std::vector<std::string> bare_;  // names of those whose was not kept
  bool has_stress_ = false;        // any of them
};

}  // namespace

std::vector<std::string> write_xdmf(const std::filesystem::path& file,
                                    const SystemModel& model,
                                    const History& history) {
  const Surfaces surfaces(model);
  std::vector<std::string> missing;
  const std::string name = file.filename().string();
  if (!surfaces.bare().empty()) {
    missing.push_back(fmt::format(
        "{} is without '{}': the nodes on its surface were not kept; take "
        "rows=\"boundary\" (the default) in <flexible><basis> of the robot, or "
        "`limber reduce --rows boundary` for a saved body",
        name, fmt::join(surfaces.bare(), "', '")));
  }
  if (surfaces.is_empty()) {
    missing.push_back(
        fmt::format("no {}: no body has a mesh whose surface was kept", name));
    return missing;
  }
  MovingSurface all = surfaces.gather(history);
  all.offset = find_home(model, history.states).offset;
  const auto at = [&](std::size_t i) {
    return shift_bodies(history.states[i], all.offset);
  };
  const SystemState start = history.states.empty() ? SystemState() : at(0);
  all.find_frame = [&](std::size_t i) {
    return surfaces.find_frame(start, at(i), all.nodes);
  };
  write_xdmf_file(file, all);
  return missing;
}

}  // namespace limber::results
