// Assembly of one mesh from the parts of all elements.
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "simulation/core/at.h"
#include "simulation/tissue/cut/cut_mesh.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

// Disjoint sets of numbers; the lowest number of a set represents it.
class Sets {
 public:
  explicit Sets(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0); }
  int Find(int i) {
    while (root_[At(i)] != i) i = root_[At(i)] = root_[At(root_[At(i)])];
    return i;
  }
  void Join(int i, int j) {
    const int a = Find(i), b = Find(j);
    root_[At(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> root_;
};

}  // namespace

// Copies of elements before assembly: one per part with enough volume left.
struct MeshCutter::Draft {
  struct Copy {
    int element, part;
  };
  std::vector<Copy> copies;
  Sets pieces{0}, nodes{0};  // pieces: sets of copies; nodes: sets of nodes, copy by copy
  std::vector<int> kept;     // copies in the mesh
};

void MeshCutter::MakeCopies(Draft& draft) {
  const int points = whole_.order == 2 ? 4 : 1;
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
    for (std::size_t p = 0; p < elements_[At(e)].parts.size(); ++p) {
      Part& part = elements_[At(e)].parts[p];
      double whole = 0.0;
      part.volume = 0.0;
      for (int q = 0; q < points; ++q) {
        const double volume = volume_[At(e * points + q)];
        part.volume += part.share[At(q)] * volume;
        whole += volume;
      }
      part.copy =
          part.volume < options_.min_share * whole ? -1 : static_cast<int>(draft.copies.size());
      if (part.copy >= 0) draft.copies.push_back({e, static_cast<int>(p)});
    }
  draft.pieces = Sets(draft.copies.size());
  draft.nodes = Sets(draft.copies.size() * At(whole_.NodesPerElement()));
}

// Joins pieces and nodes where solid touches solid through a face.
void MeshCutter::JoinCopies(Draft& draft) {
  const auto per_element = At(whole_.NodesPerElement());
  const std::size_t face_nodes = whole_.order == 2 ? 6 : 3;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    auto& pairs = touching_[f];
    if (!is_assembled_ || before_of_[At(face.first)] >= 0 || before_of_[At(face.second)] >= 0)
      Touch(face, pairs);
    for (const auto& [p, q] : pairs) {
      const int a = elements_[At(face.first)].parts[At(p)].copy,
                b = elements_[At(face.second)].parts[At(q)].copy;
      if (a < 0 || b < 0) continue;
      draft.pieces.Join(a, b);
      const auto na = NodesOf(face.first), nb = NodesOf(face.second);
      for (std::size_t i = 0; i < face_nodes; ++i)
        for (std::size_t j = 0; j < face_nodes; ++j) {
          const int la = kTetFaces[At(face.first_face)][i], lb = kTetFaces[At(face.second_face)][j];
          if (na[At(la)] == nb[At(lb)])
            draft.nodes.Join(a * static_cast<int>(per_element) + la,
                             b * static_cast<int>(per_element) + lb);
        }
    }
  }
}

// Leaves out crumbs: pieces that edits left too small, and pieces entirely outside the true shape
// (flakes of the facets). Lists the elements of the others in the whole mesh's order.
void MeshCutter::ListElements(const SolidField& field, Draft& draft) {
  const auto& copies = draft.copies;
  auto& pieces = draft.pieces;
  const int points = whole_.order == 2 ? 4 : 1;
  std::vector<double> volume(copies.size(), 0.0);
  std::vector<unsigned char> is_cut(copies.size(), 0), is_real(copies.size(), 0);
  const auto part_of = [&](int c) -> Part& {
    return elements_[At(copies[At(c)].element)].parts[At(copies[At(c)].part)];
  };
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    const int root = pieces.Find(c);
    const Element& element = elements_[At(copies[At(c)].element)];
    volume[At(root)] += part_of(c).volume;
    if (element.label.empty()) {
      is_real[At(root)] = 1;  // an uncut element is not a flake
      continue;
    }
    is_cut[At(root)] = 1;
    for (std::size_t p = 0; p < element.label.size() && is_real[At(root)] == 0; ++p)
      if (element.label[p] == copies[At(c)].part)
        is_real[At(root)] =
            field.Distance(PlaceOf(copies[At(c)].element, static_cast<int>(p))) < 0.0;
  }
  CutMesh& cut = result_;
  std::vector<unsigned char> is_crumb(copies.size(), 0);
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    if (pieces.Find(c) != c || is_cut[At(c)] == 0) continue;
    is_crumb[At(c)] = is_real[At(c)] == 0 || volume[At(c)] < options_.crumb_volume;
    cut.crumbs += is_crumb[At(c)];
    if (is_crumb[At(c)] != 0) cut.crumb_volume += volume[At(c)];
  }
  std::vector<int> piece_of(copies.size(), -1);
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    const int root = pieces.Find(c);
    Part& part = part_of(c);
    if (is_crumb[At(root)] != 0) {
      part.copy = -1;
      continue;
    }
    if (piece_of[At(root)] < 0) {
      piece_of[At(root)] = cut.piece_count();
      cut.piece_volume.push_back(0.0);
    }
    part.copy = static_cast<int>(draft.kept.size());
    draft.kept.push_back(c);
    cut.parent_element.push_back(copies[At(c)].element);
    cut.piece.push_back(piece_of[At(root)]);
    cut.piece_volume[At(piece_of[At(root)])] += part.volume;
    for (int q = 0; q < points; ++q) {
      cut.solid_share.push_back(part.share[At(q)]);
      cut.share.push_back(std::max(part.share[At(q)], options_.share_floor));
    }
  }
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
    for (int q = 0; q < points; ++q) {
      double gone = 1.0;
      for (const Part& part : elements_[At(e)].parts)
        if (part.copy >= 0) gone -= part.share[At(q)];
      cut.removed_volume += gone * volume_[At(e * points + q)];
    }
}

// Numbers the nodes in the whole mesh's order; copies of one node stand in the order of their first
// element.
void MeshCutter::NumberNodes(const CutMesh& old, Draft& draft) {
  const auto& copies = draft.copies;
  const auto& kept = draft.kept;
  auto& nodes = draft.nodes;
  const auto per_element = At(whole_.NodesPerElement());
  CutMesh& cut = result_;
  std::vector<int> copies_of_node(whole_.rest_positions.size() + 1, 0),
      number(copies.size() * per_element, -1);
  for (const int c : kept)
    for (std::size_t i = 0; i < per_element; ++i) {
      const int root = nodes.Find(c * static_cast<int>(per_element) + static_cast<int>(i));
      if (number[At(root)] >= 0) continue;
      const int parent = NodesOf(copies[At(c)].element)[i];
      number[At(root)] = copies_of_node[At(parent) + 1]++;
    }
  std::partial_sum(copies_of_node.begin(), copies_of_node.end(), copies_of_node.begin());
  const auto node_count = At(copies_of_node.back());
  cut.mesh.order = whole_.order;
  cut.mesh.rest_positions.resize(node_count);
  cut.parent_node.resize(node_count);
  cut.previous_node.assign(node_count, -1);
  cut.mesh.elements.reserve(kept.size() * per_element);
  for (const int c : kept) {
    const Element& now = elements_[At(copies[At(c)].element)];
    const int e = copies[At(c)].element, was_at = before_of_[At(e)];
    // Finds the element of the old mesh that contained this part.
    const Element& was = was_at >= 0 ? before_[At(was_at)] : now;
    const Part& part = now.parts[At(copies[At(c)].part)];
    int old_copy = -1;
    if (was.label.empty() && !was.parts.empty())
      old_copy = was.parts[0].previous_copy;
    else if (!was.label.empty() && was.label[At(part.seed)] != kNoPart)
      old_copy = was.parts[was.label[At(part.seed)]].previous_copy;
    for (std::size_t i = 0; i < per_element; ++i) {
      const int root = nodes.Find(c * static_cast<int>(per_element) + static_cast<int>(i));
      const int parent = NodesOf(e)[i];
      const auto node = At(copies_of_node[At(parent)] + number[At(root)]);
      cut.mesh.elements.push_back(static_cast<int>(node));
      cut.mesh.rest_positions[node] = whole_.rest_positions[At(parent)];
      cut.parent_node[node] = parent;
      if (cut.previous_node[node] < 0 && old_copy >= 0)
        cut.previous_node[node] = old.mesh.elements[At(old_copy) * per_element + i];
    }
  }
  // A node of restored tissue is placed where another copy of that node was.
  for (std::size_t i = 0; i < node_count; ++i) {
    if (cut.previous_node[i] >= 0) continue;
    const auto same =
        std::lower_bound(old.parent_node.begin(), old.parent_node.end(), cut.parent_node[i]);
    if (same != old.parent_node.end() && *same == cut.parent_node[i])
      cut.previous_node[i] = static_cast<int>(same - old.parent_node.begin());
  }
  for (const auto& [name, flags] : whole_.sets) {
    auto& set = cut.mesh.sets[name];
    for (const int parent : cut.parent_node) set.push_back(flags[At(parent)]);
  }
}

const CutMesh& MeshCutter::Assemble(const SolidField& field) {
  Draft draft;
  MakeCopies(draft);
  JoinCopies(draft);
  const CutMesh old = std::exchange(result_, {});
  ListElements(field, draft);
  NumberNodes(old, draft);
  for (Element& element : elements_)
    for (Part& part : element.parts) part.previous_copy = part.copy;
  is_assembled_ = true;
  before_.clear();
  std::fill(before_of_.begin(), before_of_.end(), -1);
  return result_;
}

}  // namespace arthro::simulation
