// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/model_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <unordered_map>

#include "limber/common/index.hpp"

namespace limber::fem {
namespace {

using Shape = ModelElement::Shape;
using PictureFace = std::array<int, 4>;  // the last is -1 for a triangle

// Abaqus Analysis User's Guide, "Solid element library": corners of faces.
constexpr std::array<PictureFace, 4> kTetraFaces = {
    {{0, 1, 2, -1}, {0, 3, 1, -1}, {1, 3, 2, -1}, {2, 3, 0, -1}}};
constexpr std::array<PictureFace, 5> kPyramidFaces = {
    {{0, 1, 2, 3}, {0, 4, 1, -1}, {1, 4, 2, -1}, {2, 4, 3, -1}, {3, 4, 0, -1}}};
constexpr std::array<PictureFace, 5> kWedgeFaces = {
    {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
constexpr std::array<PictureFace, 6> kHexaFaces = {{{0, 1, 2, 3},
                                                    {4, 7, 6, 5},
                                                    {0, 4, 5, 1},
                                                    {1, 5, 6, 2},
                                                    {2, 6, 7, 3},
                                                    {3, 7, 4, 0}}};

std::span<const PictureFace> faces_of(Shape shape) {
  switch (shape) {
    case Shape::tetra:
      return kTetraFaces;
    case Shape::pyramid:
      return kPyramidFaces;
    case Shape::wedge:
      return kWedgeFaces;
    case Shape::hexa:
      return kHexaFaces;
    case Shape::line:
    case Shape::triangle:
    case Shape::quad:
      break;
  }
  return {};
}

void add_face(const PictureFace& face, MatrixModel& model) {
  model.triangles.push_back({face[0], face[1], face[2]});
  if (face[3] >= 0) model.triangles.push_back({face[0], face[2], face[3]});
}

}  // namespace

std::size_t count_corners(Shape shape) {
  switch (shape) {
    case Shape::line:
      return 2;
    case Shape::triangle:
      return 3;
    case Shape::quad:
    case Shape::tetra:
      return 4;
    case Shape::pyramid:
      return 5;
    case Shape::wedge:
      return 6;
    case Shape::hexa:
      return 8;
  }
  return 0;
}

void add_pictures(const std::vector<ModelElement>& elements,
                  MatrixModel& model) {
  std::unordered_map<long, int> places;
  for (std::size_t i = 0; i < model.tags.size(); ++i)
    places[static_cast<long>(model.tags[i])] = static_cast<int>(i);
  // Faces of solids by their sorted corners: those of two elements are inside.
  std::map<PictureFace, std::pair<PictureFace, int>> faces;
  for (const ModelElement& element : elements) {
    std::vector<int> nodes;
    for (const long corner : element.corners) {
      const auto found = places.find(corner);
      if (found != places.end()) nodes.push_back(found->second);
    }
    if (nodes.size() != count_corners(element.shape)) continue;
    if (element.shape == Shape::line) {
      model.edges.push_back({nodes[0], nodes[1]});
    } else if (element.shape == Shape::triangle ||
               element.shape == Shape::quad) {
      add_face({nodes[0], nodes[1], nodes[2],
                element.shape == Shape::quad ? nodes[3] : -1},
               model);
    }
    for (const PictureFace& corners : faces_of(element.shape)) {
      PictureFace face{};
      for (std::size_t i = 0; i < face.size(); ++i)
        face[i] = corners[i] < 0 ? -1 : nodes[index(corners[i])];
      PictureFace key = face;
      std::sort(key.begin(), key.end());
      const auto entry = faces.try_emplace(key, face, 0).first;
      ++entry->second.second;
    }
  }
  for (const auto& [key, face] : faces)
    if (face.second == 1) add_face(face.first, model);
}

}  // namespace limber::fem
