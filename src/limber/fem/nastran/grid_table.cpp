// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/grid_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace limber::fem {
namespace {

constexpr std::size_t kMotions = 5;  // CD

std::optional<Vector3> read_vector(const BulkCard& card, std::size_t first,
                                   DeckProblems& problems) {
  Vector3 vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> value = card.real(first + i, problems);
    if (!value) return std::nullopt;
    vector[static_cast<Eigen::Index>(i)] = *value;
  }
  return vector;
}

}  // namespace

void GridTable::add_grid(const BulkCard& card) {
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  Grid grid{card.line, std::nullopt, Vector3::Zero()};
  const auto read_system = [&](std::size_t field, std::optional<int>& system) {
    if (!card.field(field).empty())
      system = card.integer(field, std::nullopt, *problems_);
  };
  read_system(1, grid.system);
  read_system(kMotions, grid.motions);
  const std::optional<Vector3> x = read_vector(card, 2, *problems_);
  if (!id) return;
  grid.coordinates = x.value_or(Vector3::Zero());  // a problem is told once
  if (*id < 1) {
    problems_->add(*card.line,
                   fmt::format("GRID {}. Expected a number from 1.", *id));
  } else if (!grids_.emplace(*id, grid).second) {
    problems_->add(*card.line, fmt::format("GRID {} is there twice. Expected a "
                                           "number of its own.",
                                           *id));
  }
}

void GridTable::add_default(const BulkCard& card) {
  const std::optional<int> system = card.integer(1, 0, *problems_);
  const std::optional<int> motions = card.integer(kMotions, 0, *problems_);
  if (default_line_ != nullptr)
    problems_->add(*card.line, "a second GRDSET. Expected one at most.");
  default_line_ = card.line;
  default_system_ = system.value_or(0);
  default_motions_ = motions.value_or(0);
}

void GridTable::add_system(const BulkCard& card) {
  System system;
  system.line = card.line;
  const char kind = card.name.back();
  if (kind == 'C') system.kind = Kind::cylindrical;
  if (kind == 'S') system.kind = Kind::spherical;
  const bool is_by_grids = card.name.starts_with("CORD1");
  // CORD1 cards may define two systems.
  for (std::size_t first = 0; first == 0 || !card.field(first).empty();
       first += 4) {
    const std::optional<int> id = card.integer(first, std::nullopt, *problems_);
    if (!is_by_grids) {
      if (add_points(card, system) && id) add(*id, system);
      return;
    }
    std::array<int, 3> grids{};
    for (std::size_t i = 0; i < 3; ++i)
      grids[i] =
          card.integer(first + 1 + i, std::nullopt, *problems_).value_or(0);
    system.grids = grids;
    if (id) add(*id, system);
  }
}

bool GridTable::add_points(const BulkCard& card, System& system) {
  const std::optional<int> reference = card.integer(1, 0, *problems_);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Vector3> x = read_vector(card, 2 + 3 * i, *problems_);
    if (!x) return false;
    system.points[i] = *x;
  }
  system.reference = reference.value_or(0);
  return reference.has_value();
}

void GridTable::add(int id, const System& system) {
  if (id < 1)
    problems_->add(*system.line,
                   "coordinate system below 1. Expected a "
                   "positive number.");
  else if (!systems_.emplace(id, system).second)
    problems_->add(*system.line, fmt::format("coordinate system {} is there "
                                             "twice. Expected a number of its "
                                             "own.",
                                             id));
}

Vector3 GridTable::find_position(const Grid& grid) {
  return to_basic(grid.system.value_or(default_system_), grid.coordinates,
                  *grid.line);
}

Matrix3 GridTable::find_motion_axes(const Grid& grid) {
  const int id = grid.motions.value_or(default_motions_);
  const System* const system = id == 0 ? nullptr : solve(id, *grid.line);
  if (system == nullptr) return Matrix3::Identity();
  if (system->kind == Kind::rectangular) return system->R;
  // Radial, tangential and along z, or radial and along rising theta and phi.
  const Vector3 x =
      system->R.transpose() * (find_position(grid) - system->origin);
  const double across = std::hypot(x.x(), x.y());
  if (!(across > 1e-9 * x.norm())) return system->R;
  const Vector3 out(x.x() / across, x.y() / across, 0.0);
  const Vector3 around = Vector3::UnitZ().cross(out);
  Matrix3 axes;
  if (system->kind == Kind::cylindrical) {
    axes << out, around, Vector3::UnitZ();
  } else {
    axes << x.normalized(), around.cross(x.normalized()), around;
  }
  return system->R * axes;
}

std::optional<Matrix3> GridTable::find_axes(int system, const DeckLine& user) {
  if (system == 0) return Matrix3(Matrix3::Identity());
  const System* const known = solve(system, user);
  if (known == nullptr) return std::nullopt;
  if (known->kind == Kind::rectangular) return known->R;
  problems_->add(user, fmt::format("coordinate system {} is curvilinear. "
                                   "Expected a rectangular one.",
                                   system));
  return std::nullopt;
}

std::optional<MaterialAxes> GridTable::find_material_axes(
    int system, const DeckLine& user) {
  if (system == 0) return MaterialAxes{};
  const System* const known = system > 0 ? solve(system, user) : nullptr;
  if (known == nullptr || known->kind == Kind::spherical) return std::nullopt;
  return MaterialAxes{known->kind == Kind::cylindrical, known->R,
                      known->origin};
}

Vector3 GridTable::to_rectangular(Kind kind, const Vector3& coordinates) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double r = coordinates[0];
  const double theta = kDegree * coordinates[1];
  switch (kind) {
    case Kind::rectangular:
      break;
    case Kind::cylindrical:
      return {r * std::cos(theta), r * std::sin(theta), coordinates[2]};
    case Kind::spherical: {
      const double phi = kDegree * coordinates[2];
      return {r * std::sin(theta) * std::cos(phi),
              r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
    }
  }
  return coordinates;
}

Vector3 GridTable::to_basic(int system, const Vector3& coordinates,
                            const DeckLine& user) {
  if (system == 0) return coordinates;
  const System* const known = solve(system, user);
  if (known == nullptr) return Vector3::Zero();
  return known->origin + known->R * to_rectangular(known->kind, coordinates);
}

std::optional<GridTable::Triple> GridTable::find_points(const System& system) {
  Triple points;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!system.grids) {
      points[i] = to_basic(system.reference, system.points[i], *system.line);
      continue;
    }
    const auto grid = grids_.find((*system.grids)[i]);
    if (grid == grids_.end()) {
      problems_->add(*system.line, fmt::format("GRID {} is missing. Expected "
                                               "the three points of the "
                                               "coordinate system.",
                                               (*system.grids)[i]));
      return std::nullopt;
    }
    points[i] = find_position(grid->second);
  }
  return points;
}

const GridTable::System* GridTable::solve(int id, const DeckLine& user) {
  const auto found = systems_.find(id);
  if (found == systems_.end()) {
    problems_->add(user, fmt::format("coordinate system {} is missing. "
                                     "Expected its CORD1 or CORD2 card.",
                                     id));
    return nullptr;
  }
  System& system = found->second;
  if (system.state == System::State::known) return &system;
  if (system.state == System::State::in_progress) {
    problems_->add(*system.line, fmt::format("coordinate system {} depends on "
                                             "itself. Expected one that leads "
                                             "to the basic system.",
                                             id));
    return nullptr;
  }
  system.state = System::State::in_progress;
  const std::optional<Triple> points = find_points(system);
  system.state = System::State::known;  // in spite of a problem: told once
  system.R.setIdentity();
  system.origin.setZero();
  if (!points) return &system;
  const auto& [a, b, c] = *points;
  const Vector3 z = (b - a).normalized();
  const Vector3 x = (c - a) - z.dot(c - a) * z;
  constexpr double kParallel = 1e-9;
  if (!((b - a).norm() > 0.0) || !(x.norm() > kParallel * (c - a).norm())) {
    problems_->add(*system.line, fmt::format("coordinate system {}: its three "
                                             "points lie on a line. Expected a "
                                             "triangle.",
                                             id));
    return &system;
  }
  system.origin = a;
  system.R.col(2) = z;
  system.R.col(0) = x.normalized();
  system.R.col(1) = z.cross(system.R.col(0));
  return &system;
}

}  // namespace limber::fem
