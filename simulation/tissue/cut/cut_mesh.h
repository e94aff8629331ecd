// Tetrahedral mesh of a cut solid field, by virtual nodes (Molino, Bao, Fedkiw 2004). Elements stay
// whole and only store the share of their volume that is left. An element whose solid falls into
// several pieces is copied once per piece. Neighbouring copies share nodes only where solid touches
// solid on an area of the common face: a hinge at an edge or a node comes apart. No element is cut
// into slivers. m, mesh's own frame.
//
// Only the removed volume counts (SolidField::CutDistance). An uncut field therefore gives the same
// mesh, node for node, with shares of exactly 1, although its surface differs from the mesh's
// facets.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/cut/tet_lattice.h"
#include "simulation/tissue/fem/tet_shape.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct CutOptions {
  double min_share = 1e-3;
  double share_floor = 1e-2;
  double crumb_volume = 1e-10;
  template <class V>
  void Visit(V&& v) {
    v("min_share", min_share, Range{1e-6, 0.5}, "",
      "Minimum share of an element that is left; smaller ones are dropped.");
    v("share_floor", share_floor, Range{1e-6, 0.5}, "",
      "Minimum share of a quadrature point in a cut element, so that no node is loose.");
    v("crumb_volume", crumb_volume, Range{0.0, 1e-6}, "m3",
      "Minimum volume of a piece; smaller ones are removed with the cut.");
  }
};

struct CutMesh {
  TetMesh mesh;                     // with its sets
  std::vector<double> share;        // per quadrature point (1 of T4, 4 of T10), with a lower bound
  std::vector<double> solid_share;  // the same without the bound: for volumes
  std::vector<int> parent_element, parent_node;  // in the whole mesh
  std::vector<int> previous_node;    // in the mesh before the last update; −1: new node
  std::vector<int> piece;            // per element
  std::vector<double> piece_volume;  // m³ per piece
  double removed_volume = 0;         // m³ of the whole mesh outside all pieces
  int crumbs = 0;                    // pieces left out in this state
  double crumb_volume = 0;           // m³, part of removed_volume
  int piece_count() const { return static_cast<int>(piece_volume.size()); }
};

// Element of the cut mesh that carries a point of the tissue, with its shape functions there.
struct ElementCopy {
  int element = -1;  // −1: nothing is left nearby
  std::array<double, 10> weight{};
};

class MeshCutter {
 public:
  // Elements are sampled in parts no longer than `spacing`, or a sixteenth of the element. A slot
  // wider than that separates. Throws Error(kBadMesh) for a mesh without elements.
  MeshCutter(TetMesh whole, double spacing, const CutOptions& options = {});

  // Updates the mesh after an edit of the field; tests only elements that meet `changed`.
  const CutMesh& Update(const SolidField& field, const Box3& changed);
  // Tests all elements: for another field or an undo.
  const CutMesh& Rebuild(const SolidField& field);
  const CutMesh& result() const { return result_; }
  int elements_tested() const { return elements_tested_; }  // in the last call

  // Finds the copy that carries a point at `rest` in, or nearest to, `element` of the whole mesh:
  // the copy whose solid is nearest. If that element is gone, searches the elements around it.
  ElementCopy FindCopy(int element, const glm::dvec3& rest) const;
  // The same for a point that is queried repeatedly; `own` is its PointIn in `element`.
  ElementCopy FindCopy(int element, const glm::dvec3& rest, const ElementPoint& own) const;

 private:
  struct Part {                         // connected solid of an element
    std::array<double, 4> share{};      // per quadrature point
    double volume = 0;                  // m³
    int seed = 0;                       // one of its lattice points
    int copy = -1, previous_copy = -1;  // element of result_; −1: left out
  };
  static constexpr std::uint8_t kNoPart = 255;
  struct Element {
    std::vector<std::uint8_t> label;  // part of each lattice point, or kNoPart; empty: whole
    std::vector<Part> parts;
  };
  struct Face {  // between two elements
    int first = -1, second = -1, first_face = 0, second_face = 0;
  };

  struct Draft;

  void UpdateElement(const SolidField& field, int e);
  void BuildFaces();
  const CutMesh& Assemble(const SolidField& field);
  void MakeCopies(Draft& draft);
  void JoinCopies(Draft& draft);
  void ListElements(const SolidField& field, Draft& draft);
  void NumberNodes(const CutMesh& old, Draft& draft);
  void Touch(const Face& face, std::vector<std::array<int, 2>>& pairs) const;
  const TetLattice& Lattice(int e) const {
    return (*lattices_)[level_[static_cast<std::size_t>(e)]];
  }
  std::span<const int> NodesOf(int e) const;
  glm::dvec3 PlaceOf(int e, int point) const;
  void PlacesIn(int e, std::span<glm::dvec3> places) const;
  int PartNear(int e, const glm::dvec4& barycentric) const;

  TetMesh whole_;
  CutOptions options_;
  std::shared_ptr<const std::vector<TetLattice>> lattices_;  // shared by all copies of a cutter
  std::vector<std::vector<std::array<double, 10>>> shape_;   // per level and lattice point
  std::vector<std::uint8_t> level_;                          // per element
  std::vector<Box3> box_;
  std::vector<double> volume_;  // m³ per quadrature point
  std::vector<Face> faces_;
  std::vector<std::vector<std::array<int, 2>>>
      touching_;  // per face: touching parts of its two elements
  bool is_assembled_ = false;
  std::vector<std::array<int, 4>> beside_;  // per element and face: the neighbour; −1: none
  std::vector<Element> elements_, before_;  // before_: former state of the tested elements
  std::vector<int> before_of_;              // per element: its index in before_, or −1
  std::vector<glm::dvec3> places_;          // scratch: points of one element
  std::vector<double> values_;              // field values at these points
  std::vector<NodeNear> grid_node_;         // grid nodes to which these points belong
  std::vector<std::int16_t> front_;         // points still to be visited
  int elements_tested_ = 0;
  CutMesh result_;
};

// Cuts the whole mesh at once, with field.spacing() as the resolution.
CutMesh CutByField(const TetMesh& whole, const SolidField& field, const CutOptions& options = {});

}  // namespace arthro::simulation
