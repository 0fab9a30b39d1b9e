// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/text/deck_place.hpp"
#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// *MATERIAL with *ELASTIC (isotropic, ORTHOTROPIC, ENGINEERING CONSTANTS,
/// ANISOTROPIC) and *DENSITY, *ORIENTATION (rectangular, cylindrical) and
/// sections of solids of an input file.
/// Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords Reference Guide
class DeckMaterials {
 public:
  struct Section {
    std::string elset;  ///< in upper case, as all names here
    std::string material;
    std::string orientation;  ///< empty: none
    std::string place;        ///< "file:line"
    Pose pose = {};           ///< of the instance in which its axes are
  };

  /// A keyword of a material, an orientation or a section; others end a
  /// material's data. @param pose of the instance that it is in
  void begin(const DeckPlace& at, const Keyword& keyword, const Pose& pose);
  /// @returns false if the line is not of *ELASTIC, *DENSITY or *ORIENTATION
  /// @throws InputError with file and line for what is no number
  bool add_data(const DeckPlace& at, const Keyword& keyword,
                std::string_view line);

  [[nodiscard]] const std::vector<Section>& sections() const {
    return sections_;
  }
  /// In the deck's units, by the names as they are spelled.
  [[nodiscard]] RegionMaterial find(
      const Section& section,
      const std::map<std::string, std::string>& spelling) const;

 private:
  struct Material {
    std::string place;
    std::string type;  // of *ELASTIC
    std::optional<std::vector<double>> elastic;
    std::vector<double> density;
    std::string other;  // a law in place of *ELASTIC
  };
  struct Orientation {
    std::string place;
    std::string problem;
    bool is_cylindrical = false;
    std::vector<std::vector<double>> lines;
  };

  [[nodiscard]] static Matrix6 find_constants(const Material& material);
  [[nodiscard]] SolidMaterial convert(const Material& material,
                                      const Section& section) const;

  std::vector<Section> sections_;
  std::map<std::string, Material> materials_;
  std::map<std::string, Orientation> orientations_;
  std::string material_;  // that keywords belong to
};

}  // namespace limber::fem
