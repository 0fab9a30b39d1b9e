// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/fem/matrices/matrix_model.hpp"
#include "limber/fem/structural/beam_element.hpp"
#include "limber/fem/structural/laminate.hpp"

/// A model of beams and shells, before its matrices. Nodes are indices into
/// Structure::tags; places are "file:line", for messages; units are those of
/// the file.
namespace limber::fem {

struct BeamProperty {
  BeamSection section;
  BeamMaterial material;
};

struct StructureBeam {
  std::array<int, 2> nodes = {-1, -1};
  int property = 0;              ///< index into Structure::beam_properties
  Vector3 up = Vector3::Zero();  ///< as BeamShape
  std::array<Vector3, 2> offsets = {Vector3::Zero(), Vector3::Zero()};
  std::string place;
  std::size_t tag = 0;  ///< its number in the deck
};

struct StructureShell {
  std::vector<int> nodes;          ///< three or four
  int laminate = 0;                ///< index into Structure::laminates
  Vector3 axis = Vector3::Zero();  ///< as ShellShape; zero: the first side
  double angle = 0.0;   ///< from `axis` to axis 1, about the normal [rad]
  double offset = 0.0;  ///< of the laminate along the normal
  std::string place;
};

/// A rigid body on a node.
struct StructureMass {
  int node = -1;
  double mass = 0.0;                  ///< >= 0
  Vector3 offset = Vector3::Zero();   ///< of its centre of mass from the node
  Matrix3 inertia = Matrix3::Zero();  ///< about its centre of mass
  std::string place;
};

/// Nodes that move with a reference node as a rigid body.
struct StructureSpider {
  int reference = -1;
  std::vector<int> nodes;
  std::string place;
};

/// A node that moves with the mean of others' displacements, by weights, and
/// turns with them, and does not stiffen them.
struct StructureMean {
  int node = -1;
  std::vector<int> nodes;
  std::vector<double> weights;  ///< beside nodes; their sum > 0
  std::string place;
};

struct Structure {
  std::string source;                        ///< file, for messages
  std::vector<std::filesystem::path> files;  ///< with those that it includes
  std::vector<std::size_t> tags;
  Matrix3X x;  ///< 3 x nodes
  std::vector<BeamProperty> beam_properties;
  std::vector<Laminate> laminates;
  std::vector<StructureBeam> beams;
  std::vector<StructureShell> shells;
  std::vector<StructureMass> masses;
  std::vector<StructureSpider> spiders;
  std::vector<StructureMean> means;
  bool has_solids = false;  ///< which read_structure_solids reads
  std::vector<std::string> beside_solids;  ///< kinds of cards of all others
  std::vector<MatrixNodeSet> sets;
  double mass_factor = 1.0;  ///< of all masses
  std::vector<std::string> found;
  std::vector<std::string> notices;
};

}  // namespace limber::fem
