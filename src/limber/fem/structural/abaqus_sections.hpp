// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/fem/structural/structure.hpp"
#include "limber/fem/text/deck_place.hpp"
#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// A section of an input file with what it needs of others.
struct AbaqusSection {
  std::string place;  ///< "file:line"
  std::string elset;
  bool is_beam = false;
  std::string material;     ///< of a beam or a shell of one material
  std::string orientation;  ///< of a shell; may be empty
  std::string shape;        ///< of a beam: RECT, CIRC, PIPE, BOX, I
  bool is_composite = false;
  std::vector<std::vector<std::string>> lines;  ///< data, in upper case
  Pose pose = {};  ///< of its instance, in which its axes are
};

/// Materials, sections and orientations of an input file.
/// Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords Reference Guide
class AbaqusSections {
 public:
  /// @param pose of the instance that the keyword is in
  /// @returns whether data lines of the keyword are for this
  bool begin(const DeckPlace& at, const Keyword& keyword, const Pose& pose);
  void add_data(const DeckPlace& at, std::string_view line);

  [[nodiscard]] const std::vector<AbaqusSection>& sections() const {
    return sections_;
  }
  /// @throws InputError with the section's place
  [[nodiscard]] BeamProperty make_beam(const AbaqusSection& section) const;
  [[nodiscard]] Laminate make_shell(const AbaqusSection& section) const;
  /// Direction of axis 1 of the section's beams.
  [[nodiscard]] static Vector3 find_beam_axis(const AbaqusSection& section);
  /// Axis 1 of a shell's material before its projection; none without an
  /// orientation, which a shell that has directions needs in an instance that
  /// is turned.
  [[nodiscard]] std::optional<Vector3> find_shell_axis(
      const AbaqusSection& section) const;

 private:
  struct Material {
    std::string place;
    std::string kind;  ///< of *ELASTIC
    std::vector<double> elastic;
    std::optional<double> density;
    Vector6 strengths = Vector6::Zero();  ///< as PlyMaterial
  };

  struct Orientation {
    std::string problem;
    std::optional<Matrix3> axes;     ///< without the further rotation
    Vector3 axis = Vector3::Zero();  ///< axis 1
  };

  void begin_section(const DeckPlace& at, const Keyword& keyword,
                     const Pose& pose);
  void add_strengths(const DeckPlace& at,
                     const std::vector<std::string_view>& fields);
  void add_orientation(const DeckPlace& at, std::string_view line);
  /// @param section whose materials are there
  [[nodiscard]] bool has_directions(const AbaqusSection& section) const;
  [[nodiscard]] PlyMaterial find_material(const AbaqusSection& section,
                                          const std::string& name) const;

  std::string reading_;  // keyword whose data lines come
  std::string name_;     // of the material or orientation
  std::map<std::string, Material> materials_;
  std::map<std::string, Orientation> orientations_;
  std::vector<AbaqusSection> sections_;
};

}  // namespace limber::fem
