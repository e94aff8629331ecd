// What of a solid hangs together: solid nodes that are neighbours along grid edges, as the skin
// (polygonise.h) has it. Which pieces nothing holds, and which are too small to be kept. m, m³.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct FieldPieces {
  std::vector<std::int32_t> piece;  // a node of the grid; −1: not solid
  // Of each piece. A cell that several have a corner in is shared by the number of corners, so the
  // sum is the field's volume.
  std::vector<double> volume;
  int count() const { return static_cast<int>(volume.size()); }
};

// Numbered in the order of their first nodes.
FieldPieces PiecesOf(const SolidField& field);

// 1 a piece that has a node in any of the balls (the field's own frame), 0 one that is loose.
std::vector<unsigned char> HeldPieces(const SolidField& field, const FieldPieces& pieces,
                                      std::span<const Ball> anchors);

struct CrumbReport {
  int crumbs = 0;
  FieldEdit edit;
};

// Takes away the pieces whose flag is set.
CrumbReport RemovePieces(SolidField& field, const FieldPieces& pieces,
                         std::span<const unsigned char> is_removed);
// Takes away the pieces smaller than `volume`.
CrumbReport RemoveCrumbs(SolidField& field, double volume);

}  // namespace arthro::simulation
