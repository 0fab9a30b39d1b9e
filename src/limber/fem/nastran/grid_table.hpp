// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "limber/common/material/solid_material.hpp"
#include "limber/common/types.hpp"
#include "limber/fem/nastran/bulk_card.hpp"

namespace limber::fem {

/// GRID points and coordinate systems (CORD1R, C, S and CORD2R, C, S) of a
/// deck.
class GridTable {
 public:
  explicit GridTable(DeckProblems& problems) : problems_(&problems) {}

  void add_grid(const BulkCard& card);
  void add_default(const BulkCard& card);  ///< GRDSET
  void add_system(const BulkCard& card);

  struct Grid {
    const DeckLine* line = nullptr;
    std::optional<int> system;  ///< none: that of GRDSET
    Vector3 coordinates;        ///< in its system [deck units, degrees]
    std::optional<int> motions = std::nullopt;  ///< CD; none: of GRDSET
  };
  [[nodiscard]] const std::unordered_map<int, Grid>& grids() const {
    return grids_;
  }
  /// In the basic system [deck units]; a problem is added, and zero returned,
  /// if a system is missing, degenerate or depends on itself.
  Vector3 find_position(const Grid& grid);
  /// Axes of its displacements (CD) as columns, in the basic system; as with
  /// find_position.
  Matrix3 find_motion_axes(const Grid& grid);
  /// Axes of a rectangular system (0: the basic one) as columns; none, and a
  /// problem, if it is missing or curvilinear. @param user for messages
  std::optional<Matrix3> find_axes(int system, const DeckLine& user);
  /// Axes of a material: of the basic system (0), or of a rectangular or
  /// cylindrical one [deck units]; empty for any other.
  std::optional<MaterialAxes> find_material_axes(int system,
                                                 const DeckLine& user);

 private:
  enum class Kind { rectangular, cylindrical, spherical };
  /// Origin, a point on the z axis and one in the x z plane, from x on.
  using Triple = std::array<Vector3, 3>;
  struct System {
    const DeckLine* line = nullptr;
    Kind kind = Kind::rectangular;
    std::optional<std::array<int, 3>> grids;  ///< of CORD1
    int reference = 0;                        ///< of CORD2
    Triple points;
    enum class State { unknown, in_progress, known } state = State::unknown;
    Matrix3 R;  ///< axes as columns, in the basic system
    Vector3 origin;
  };

  void add(int id, const System& system);
  bool add_points(const BulkCard& card, System& system);
  Vector3 to_basic(int system, const Vector3& coordinates,
                   const DeckLine& user);
  const System* solve(int id, const DeckLine& user);
  std::optional<Triple> find_points(const System& system);
  static Vector3 to_rectangular(Kind kind, const Vector3& coordinates);

  DeckProblems* problems_;
  std::unordered_map<int, Grid> grids_;
  std::unordered_map<int, System> systems_;
  const DeckLine* default_line_ = nullptr;
  int default_system_ = 0;
  int default_motions_ = 0;
};

}  // namespace limber::fem
