// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "limber/fem/structural/abaqus_surfaces.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// *RIGID BODY, *COUPLING with *KINEMATIC or *DISTRIBUTING, and *MPC of type
/// BEAM of an input file.
/// Source: Abaqus Keywords Reference Guide; CalculiX 2.20 User's Manual, ch. 7
class AbaqusTies {
 public:
  /// @returns whether the keyword is one of them, or *SURFACE
  /// @throws InputError with file and line for what is not read of them
  bool begin(const DeckPlace& at, const Keyword& keyword);
  void add_data(const DeckPlace& at, std::string_view line);

  /// Adds spiders and means. @param turning nodes of beams and shells
  /// @throws InputError with the tie's place
  void add_to(const AbaqusMesh& mesh, std::set<int> turning,
              Structure& structure) const;
  [[nodiscard]] std::size_t size() const { return ties_.size(); }

 private:
  enum class Of { nodes, elements, surface };
  struct Tie {
    std::string place;
    std::string reference;  ///< a number, or a set of one node
    Of kind = Of::nodes;
    std::string of;         ///< the name of what moves with it
    std::string held = {};  ///< components, as 123456
    bool is_mean = false;   ///< *DISTRIBUTING
    bool is_open = false;   ///< a *COUPLING without its kind
  };

  void begin_rigid(const DeckPlace& at, const Keyword& keyword);
  void begin_coupling(const DeckPlace& at, const Keyword& keyword);
  void begin_kind(const DeckPlace& at, const Keyword& keyword);

  std::string reading_;
  AbaqusSurfaces surfaces_;
  std::vector<Tie> ties_;
};

}  // namespace limber::fem
