// A tetrahedral mesh after a solid field was cut, by virtual nodes (Molino, Bao, Fedkiw 2004): the
// elements stay whole and only say what share of them is still there. An element in which the
// solid falls in several pieces is there once for each, and copies have nodes in common with
// copies next to them only where solid touches solid through the shared face, on an area: a hinge
// of an edge or a node comes apart. No element is ever cut into slivers. m, mesh's own frame.
//
// Only what edits took away counts (SolidField::CutDistance): a field that nothing was cut from
// gives back the same mesh, node for node, with shares of exactly 1, though its surface and the
// mesh's facets differ.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/tet_mesh.h"
#include "simulation/tissue/cut/element_point.h"
#include "simulation/tissue/cut/tet_lattice.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct CutOptions {
  double min_share = 1e-3;
  double share_floor = 1e-2;
  double crumb_volume = 1e-10;
  template <class V>
  void Visit(V&& v) {
    v("min_share", min_share, Range{1e-6, 0.5}, "",
      "An element with a smaller part of it left is left out.");
    v("share_floor", share_floor, Range{1e-6, 0.5}, "",
      "A quadrature point of a cut element is counted with no less, so that no node is loose.");
    v("crumb_volume", crumb_volume, Range{0.0, 1e-6}, "m3",
      "A piece smaller than this goes with the cut.");
  }
};

struct CutMesh {
  TetMesh mesh;                     // sets carried along
  std::vector<double> share;        // a quadrature point (1 of T4, 4 of T10), floored: for FemModel
  std::vector<double> solid_share;  // the same, not floored: for volumes
  std::vector<int> parent_element, parent_node;  // in the whole mesh
  std::vector<int> previous_node;    // in the mesh before the last update; −1: was in none
  std::vector<int> piece;            // an element
  std::vector<double> piece_volume;  // m³, one a piece
  double removed_volume = 0;  // m³ of the whole mesh that no piece has; with the pieces: its volume
  int crumbs = 0;             // pieces that were left out, in this state
  double crumb_volume = 0;    // m³, of removed_volume
  int piece_count() const { return static_cast<int>(piece_volume.size()); }
};

// The element of the cut mesh that carries a point of the tissue, and its shape functions there.
struct ElementCopy {
  int element = -1;  // −1: nothing is left near
  std::array<double, 10> weight{};
};

class MeshCutter {
 public:
  // Elements are looked at in parts no longer than `spacing`, or a sixteenth of them: a slot wider
  // than that separates. Throws Error(kBadMesh) for a mesh without elements.
  MeshCutter(TetMesh whole, double spacing, const CutOptions& options = {});

  // After an edit of the field: only elements that meet `changed` are looked at again.
  const CutMesh& Update(const SolidField& field, const Box3& changed);
  // All elements: another field, an undo.
  const CutMesh& Rebuild(const SolidField& field);
  const CutMesh& result() const { return result_; }
  int elements_looked_at() const { return looked_at_; }  // by the last call

  // Which copy carries a point at `rest` that lies in, or nearest to, `element` of the whole mesh:
  // the one whose solid is nearest. Where that element is gone, the nearest one around it.
  ElementCopy FindCopy(int element, const glm::dvec3& rest) const;
  // The same for a point that is asked for again and again; `own` is PointIn of it in `element`.
  ElementCopy FindCopy(int element, const glm::dvec3& rest, const ElementPoint& own) const;

 private:
  struct Part {                         // solid of an element that hangs together
    std::array<double, 4> share{};      // a quadrature point
    double volume = 0;                  // m³
    int seed = 0;                       // one of its points
    int copy = -1, previous_copy = -1;  // element of result_; −1: left out
  };
  static constexpr std::uint8_t kNoPart = 255;
  struct Element {
    std::vector<std::uint8_t> label;  // a lattice point: which part; kNoPart. Empty: whole
    std::vector<Part> parts;
  };
  struct Face {  // between two elements
    int first = -1, second = -1, first_face = 0, second_face = 0;
  };

  struct Draft;

  void LookAt(const SolidField& field, int e);
  void BuildFaces();
  const CutMesh& Assemble(const SolidField& field);
  void MakeCopies(Draft& draft);
  void JoinCopies(Draft& draft);
  void ListElements(const SolidField& field, Draft& draft);
  void NumberNodes(const CutMesh& old, Draft& draft);
  void Touch(const Face& face, std::vector<std::array<int, 2>>& pairs) const;
  const TetLattice& LatticeOf(int e) const {
    return (*lattices_)[level_[static_cast<std::size_t>(e)]];
  }
  std::span<const int> NodesOf(int e) const;
  glm::dvec3 PlaceOf(int e, int point) const;
  void PlacesIn(int e, std::span<glm::dvec3> places) const;
  int PartNear(int e, const glm::dvec4& barycentric) const;

  TetMesh whole_;
  CutOptions options_;
  std::shared_ptr<const std::vector<TetLattice>> lattices_;  // read by all copies of a cutter
  std::vector<std::vector<std::array<double, 10>>> shape_;   // a level, a point
  std::vector<std::uint8_t> level_;                          // an element
  std::vector<Box3> box_;
  std::vector<double> volume_;  // m³ a quadrature point
  std::vector<Face> faces_;
  std::vector<std::vector<std::array<int, 2>>> touching_;  // a face: parts of its two elements
  bool is_assembled_ = false;
  std::vector<std::array<int, 4>> beside_;  // an element: through which face which other; −1
  std::vector<Element> elements_, before_;  // before_: of those looked at, as they were
  std::vector<int> before_of_;              // an element: its place in before_; −1
  std::vector<glm::dvec3> places_;          // scratch: the points of one element,
  std::vector<double> values_;              // the field there,
  std::vector<NodeNear> grid_node_;         // the field's nodes that they belong to,
  std::vector<std::int16_t> front_;         // and those still to be visited
  int looked_at_ = 0;
  CutMesh result_;
};

// All at once. `field.spacing()` is the resolution.
CutMesh CutByField(const TetMesh& whole, const SolidField& field, const CutOptions& options = {});

}  // namespace arthro::simulation
