// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/fem/structural/structure.hpp"
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
};

/// Materials, sections and orientations of an input file.
/// Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords Reference Guide
class AbaqusSections {
 public:
  /// @returns whether data lines of the keyword are for this
  bool begin(const TextScanner& at, const Keyword& keyword);
  void add_data(const TextScanner& at, std::string_view line);

  [[nodiscard]] const std::vector<AbaqusSection>& sections() const {
    return sections_;
  }
  /// @throws InputError with the section's place
  [[nodiscard]] BeamProperty make_beam(const AbaqusSection& section) const;
  [[nodiscard]] Laminate make_shell(const AbaqusSection& section) const;
  /// Direction of axis 1 of the section's beams.
  [[nodiscard]] static Vector3 find_beam_axis(const AbaqusSection& section);
  /// Axis 1 of a shell's material before its projection; none without an
  /// orientation.
  [[nodiscard]] std::optional<Vector3> find_shell_axis(
      const AbaqusSection& section) const;

 private:
  struct Material {
    std::string place;
    std::string kind;  ///< of *ELASTIC
    std::vector<double> elastic;
    std::optional<double> density;
  };

  void begin_section(const TextScanner& at, const Keyword& keyword);
  void add_orientation(const TextScanner& at, std::string_view line);
  [[nodiscard]] PlyMaterial find_material(const AbaqusSection& section,
                                          const std::string& name) const;

  std::string reading_;  // keyword whose data lines come
  std::string name_;     // of the material or orientation
  std::map<std::string, Material> materials_;
  std::map<std::string, Vector3> orientations_;
  std::map<std::string, Matrix3> axes_;  // of orientations
  std::vector<AbaqusSection> sections_;
};

}  // namespace limber::fem
