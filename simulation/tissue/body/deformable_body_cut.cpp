// Removal of parts of a body: the field at rest, then elements, skin and solver.
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/tissue/body/deformable_body_impl.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

// Distance at which a cutting tool triggers the preparation of the tissue.
constexpr double kPrepareReach = 5e-3;  // m

constexpr double kSkinReach = 2.5;  // spacings outside the tissue that a cut must know

bool Meet(const Box3& a, const Box3& b) {
  return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

// Maps the nodes of the new mesh to the previous one. A new node is mapped like an old node of its
// element.
std::vector<int> PreviousNodes(const CutMesh& cut) {
  std::vector<int> previous = cut.previous_node;
  const int nodes = cut.mesh.NodesPerElement();
  for (int e = 0; e < cut.mesh.ElementCount(); ++e) {
    const int* of_element =
        &cut.mesh.elements[static_cast<std::size_t>(e) * static_cast<std::size_t>(nodes)];
    int known = -1;
    for (int i = 0; i < nodes && known < 0; ++i)
      known = cut.previous_node[static_cast<std::size_t>(of_element[i])];
    for (int i = 0; i < nodes; ++i) {
      int& of_node = previous[static_cast<std::size_t>(of_element[i])];
      if (of_node < 0) of_node = std::max(known, 0);
    }
  }
  return previous;
}

// Returns the smallest barycentric coordinate in the element's corner tetrahedron.
double Inside(const TetMesh& mesh, int element, const glm::dvec3& x) {
  const int* node = &mesh.elements[static_cast<std::size_t>(element) *
                                   static_cast<std::size_t>(mesh.NodesPerElement())];
  const auto at = [&](int i) { return mesh.rest_positions[static_cast<std::size_t>(node[i])]; };
  const glm::dvec4 l = BarycentricIn({at(0), at(1), at(2), at(3)}, x);
  return std::min({l.x, l.y, l.z, l.w});
}

// Finds the element of each grid node. Up to four nodes outside the mesh it is that of a neighbour,
// further out −1. Walks over the elements; a search for each node takes a hundred times as long.
std::vector<int> ElementsOfNodes(const TetMesh& mesh, const FieldGrid& grid) {
  constexpr double kBulge = -0.2;  // barycentric bulge of a curved face beyond the straight one
  constexpr int kOutside = 4;
  std::vector<int> element(grid.NodeCount(), -1);
  std::vector<float> inside(grid.NodeCount(), static_cast<float>(kBulge));
  for (int e = 0; e < mesh.ElementCount(); ++e) {
    Box3 box = kEmptyBox;
    for (int i = 0; i < mesh.NodesPerElement(); ++i) {
      const glm::dvec3& x = mesh.rest_positions[static_cast<std::size_t>(
          mesh.elements[static_cast<std::size_t>(e) *
                            static_cast<std::size_t>(mesh.NodesPerElement()) +
                        static_cast<std::size_t>(i)])];
      box = Union(box, {x, x});
    }
    const glm::dvec3 last(grid.count[0] - 1, grid.count[1] - 1, grid.count[2] - 1);
    const glm::ivec3 low(
        glm::clamp(glm::floor((box.low - grid.origin) / grid.spacing), glm::dvec3(0.0), last));
    const glm::ivec3 high(
        glm::clamp(glm::ceil((box.high - grid.origin) / grid.spacing), glm::dvec3(0.0), last));
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i) {
          const std::size_t node = grid.Index(i, j, k);
          const auto here = static_cast<float>(Inside(mesh, e, grid.Place(i, j, k)));
          if (here > inside[node]) inside[node] = here, element[node] = e;
        }
  }
  const std::array<std::size_t, 3> step{1, grid.Index(0, 1, 0), grid.Index(0, 0, 1)};
  for (int pass = 0; pass < kOutside; ++pass) {
    const std::vector<int> before = element;
    for (std::size_t node = 0; node < element.size(); ++node)
      for (std::size_t axis = 0; axis < 3 && element[node] < 0; ++axis) {
        if (node >= step[axis]) element[node] = before[node - step[axis]];
        if (element[node] < 0 && node + step[axis] < element.size())
          element[node] = before[node + step[axis]];
      }
  }
  return element;
}

// Finds the best containing element among those at the eight nodes around a point; −1: none.
int ElementAround(const glm::dvec3& x, const FieldGrid& grid, const std::vector<int>& of_node,
                  const TetMesh& mesh) {
  const glm::dvec3 last(grid.count[0] - 2, grid.count[1] - 2, grid.count[2] - 2);
  const glm::ivec3 low(glm::clamp(glm::floor((x - grid.origin) / grid.spacing), glm::dvec3(0.0),
                                  glm::max(last, glm::dvec3(0.0))));
  int best = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const int element =
        of_node[grid.Index(low.x + (corner & 1), low.y + (corner >> 1 & 1), low.z + (corner >> 2))];
    if (element < 0 || element == best) continue;
    if (const double inside = Inside(mesh, element, x); inside > most) {
      most = inside;
      best = element;
    }
  }
  return best;
}

// Maps each element of the whole mesh to its only copy in the cut mesh; −1: none, or several.
std::vector<int> OnlyCopies(const CutMesh& cut, int elements) {
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> only(static_cast<std::size_t>(elements), kNone);
  for (std::size_t e = 0; e < cut.parent_element.size(); ++e) {
    int& copy = only[static_cast<std::size_t>(cut.parent_element[e])];
    copy = copy == kNone ? static_cast<int>(e) : kSeveral;
  }
  return only;
}

// Finds each vertex of a carved skin in the skin before; −1: it is new. Vertices of the whole
// surface are known by their index, others by their place.
std::vector<int> SameVertices(const SurfaceMesh& before, std::span<const int> whole_before,
                              const SurfaceMesh& now, std::span<const int> whole_now) {
  std::vector<int> of_whole;
  const auto hash = [](const std::array<double, 3>& x) {
    std::uint64_t sum = 0;
    for (const double coordinate : x)
      sum = (sum ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(sum >> 16);
  };
  std::unordered_map<std::array<double, 3>, int, decltype(hash)> of_place(before.vertices.size(),
                                                                          hash);
  for (std::size_t v = 0; v < whole_before.size(); ++v) {
    const glm::dvec3& x = before.vertices[v];
    if (whole_before[v] < 0) {
      of_place[{x.x, x.y, x.z}] = static_cast<int>(v);
      continue;
    }
    const auto whole = static_cast<std::size_t>(whole_before[v]);
    if (whole >= of_whole.size()) of_whole.resize(whole + 1, -1);
    of_whole[whole] = static_cast<int>(v);
  }
  std::vector<int> same;
  same.reserve(whole_now.size());
  for (std::size_t v = 0; v < whole_now.size(); ++v) {
    const auto whole = static_cast<std::size_t>(whole_now[v]);
    if (whole_now[v] >= 0) {
      same.push_back(whole < of_whole.size() ? of_whole[whole] : -1);
      continue;
    }
    const glm::dvec3& x = now.vertices[v];
    const auto found = of_place.find({x.x, x.y, x.z});
    same.push_back(found == of_place.end() ? -1 : found->second);
  }
  return same;
}

}  // namespace

Box3 DeformableBody::Impl::RestBoxOf(const Capsule& tool) {
  const double reach = tool.radius + 3.0 * field.spacing();
  const Box3 around{glm::min(tool.a, tool.b) - reach, glm::max(tool.a, tool.b) + reach};
  Box3 rest = kEmptyBox;
  std::ranges::fill(cut->is_near, 0);
  const int nodes = shape->mesh.NodesPerElement();
  for (int e = 0; e < shape->mesh.ElementCount(); ++e) {
    Box3 now = kEmptyBox, then = kEmptyBox;
    for (int i = 0; i < nodes; ++i) {
      const auto node = static_cast<std::size_t>(
          shape->mesh.elements[static_cast<std::size_t>(e) * static_cast<std::size_t>(nodes) +
                               static_cast<std::size_t>(i)]);
      now = Union(now, {state.x[node], state.x[node]});
      then = Union(then, {shape->mesh.rest_positions[node], shape->mesh.rest_positions[node]});
    }
    if (!Meet(now, around)) continue;
    rest = Union(rest, then);
    cut->is_near[static_cast<std::size_t>(
        cut->cutter.result().parent_element[static_cast<std::size_t>(e)])] = 1;
  }
  if (rest.empty()) return rest;
  return {rest.low - 2.0 * field.spacing(), rest.high + 2.0 * field.spacing()};
}

bool DeformableBody::Impl::IsAboutToCut(const PlacedTool& tool) const noexcept {
  const bool can_cut = tool.kind == ToolKind::kPunch || tool.kind == ToolKind::kShaver;
  return tool.count > 0 && can_cut && shape->skin_contact.IsNear({&tool.bite, 1}, kPrepareReach);
}

void DeformableBody::Impl::WantPreparation() noexcept {
  if (!spec.is_cuttable || cut != nullptr || could_not_prepare) return;
  if (side_work == SideWork::kPreparation) return;
  wants_preparation = std::any_of(placed.begin(), placed.begin() + tool_count,
                                  [&](const PlacedTool& tool) { return IsAboutToCut(tool); });
}

bool DeformableBody::Impl::AwaitsPreparation(const PlacedTool& tool) const noexcept {
  return cut == nullptr && !could_not_prepare && finish_side_work && IsAboutToCut(tool);
}

bool DeformableBody::Impl::CutWithTools(std::span<const WorldTool> tools, double dt, bool may_cut) {
  bool was_cut = false;
  for (std::size_t i = 0; i < tool_count; ++i) {
    PlacedTool& tool = placed[i];
    if (tool.count == 0 || AwaitsPreparation(tool)) continue;
    double time = 0;
    const ToolCut cut_now = TriggerCut(tools[i].shape.kind, tools[i].now, dt, tool.trigger, time);
    if (cut_now != ToolCut::kNone) {
      tool.due = cut_now;
      tool.due_time += time;
    }
    if (!may_cut || tool.due == ToolCut::kNone) continue;
    const bool is_shaver = std::exchange(tool.due, ToolCut::kNone) == ToolCut::kShave;
    was_cut |= CutWith(tool.bite, is_shaver, std::exchange(tool.due_time, 0.0));
  }
  // The skin takes about as long as the elements, which the next step updates.
  if (was_cut) cut->carved = cut->carver.Carve(field);
  return was_cut;
}

bool DeformableBody::Impl::PlaceOfNode(const glm::dvec3& rest, glm::dvec3& place) {
  const FieldGrid& grid = field.grid();
  const glm::dvec3 at = glm::round((rest - grid.origin) / grid.spacing);
  const std::size_t node =
      grid.Index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z));
  // Points well outside the tissue are not needed.
  if (field.values()[node] > std::min(kSkinReach * grid.spacing, 0.9 * field.band())) return false;
  const int element = cut->element_of_node[node];
  if (element < 0 || cut->is_near[static_cast<std::size_t>(element)] == 0) return false;
  int& point = cut->point_of_node[node];
  if (point < 0) {
    point = static_cast<int>(cut->points.size());
    cut->points.push_back(PointIn(spec.mesh, element, rest));
  }
  const ElementCopy copy =
      cut->cutter.FindCopy(element, rest, cut->points[static_cast<std::size_t>(point)]);
  if (copy.element < 0) return false;
  const int nodes = shape->mesh.NodesPerElement();
  place = glm::dvec3(0.0);
  for (int i = 0; i < nodes; ++i)
    place +=
        copy.weight[static_cast<std::size_t>(i)] *
        state.x[static_cast<std::size_t>(
            shape->mesh
                .elements[static_cast<std::size_t>(copy.element) * static_cast<std::size_t>(nodes) +
                          static_cast<std::size_t>(i)])];
  return true;
}

std::unique_ptr<CutState> DeformableBody::Impl::PreparedCut() const {
  auto made = std::make_unique<CutState>(CutState{.cutter = MeshCutter(spec.mesh, field.spacing()),
                                                  .carver = SkinCarver(spec.surface, field),
                                                  .original = field});
  for (std::size_t v = 0; v < shape->skin.point.size(); ++v) {
    made->element_of_vertex.push_back(shape->skin.point[v].element);
    made->whole_vertex.push_back(static_cast<int>(v));
  }
  made->cutter.Rebuild(field);
  made->element_of_node = ElementsOfNodes(spec.mesh, field.grid());
  made->point_of_node.assign(made->element_of_node.size(), -1);
  made->is_near.assign(static_cast<std::size_t>(spec.mesh.ElementCount()), 0);
  return made;
}

// Makes the author's cuts, which do not count as the trainee's.
void DeformableBody::Impl::MakeAuthorsCuts() {
  cut = PreparedCut();
  const MadeCuts made = MakeCuts(field, spec.cuts, spec.fixed);
  if (made.changed.empty()) return cut.reset();
  cut->carved = cut->carver.Carve(field);
  FollowField(made.changed);
  cut->original = field;
}

void DeformableBody::Impl::CountRegions() {
  if (spec.regions.empty()) return;
  taken.by_region.clear();
  for (const RegionVolume& volume : RemovedByRegion(cut->original, field, spec.regions))
    taken.by_region.push_back(volume.removed);
}

bool DeformableBody::Impl::CutWith(const Capsule& tool, bool is_shaver, double dt) {
  if (!shape->skin_contact.IsNear({&tool, 1}, field.spacing())) return false;
  if (cut == nullptr) cut = PreparedCut();
  const Box3 box = RestBoxOf(tool);
  if (box.empty()) return false;
  const Deformation place_of = [this](const glm::dvec3& rest, glm::dvec3& place) {
    return PlaceOfNode(rest, place);
  };
  const ToolDistance distance = [&tool](const glm::dvec3& place) {
    return DistanceToCapsule(place, tool.a, tool.b, tool.radius);
  };
  FieldEdit edit = is_shaver
                       ? Shave(field, box, place_of, distance, options.shaver, dt, cut->shaver)
                       : SubtractDeformed(field, box, place_of, distance);
  if (edit.changed.empty()) return false;
  // Washes away small fragments that are no longer held.
  const CrumbReport gone = RemoveDebris(field, spec.fixed);
  edit.changed = Union(edit.changed, gone.edit.changed);
  taken.removed += edit.removed + gone.edit.removed;
  taken.debris += gone.crumbs;
  taken.debris_volume += gone.edit.removed;
  ++taken.cuts;
  CountRegions();
  edited = Union(edited, edit.changed);
  return true;
}

void DeformableBody::Impl::FollowField(const Box3& box) {
  const std::vector<int> was_only_copy = OnlyCopies(cut->cutter.result(), spec.mesh.ElementCount());
  const CutMesh& after = cut->cutter.Update(field, box);
  taken.pieces = after.piece_count();

  // Puts the skin of the remaining tissue on the remaining elements.
  CarvedSkin carved = std::exchange(cut->carved, CarvedSkin{});
  EmbeddedSkin skin{std::move(carved.surface), {}};
  const std::vector<int> only_copy = OnlyCopies(after, spec.mesh.ElementCount());
  const std::vector<int> previous =
      SameVertices(shape->skin.rest, cut->whole_vertex, skin.rest, carved.whole_vertex);
  std::vector<int> element_of(skin.rest.vertices.size());
  skin.point.resize(element_of.size());
  for (std::size_t v = 0; v < element_of.size(); ++v) {
    const glm::dvec3& rest = skin.rest.vertices[v];
    const int before = previous[v];
    if (before >= 0) {
      element_of[v] = cut->element_of_vertex[static_cast<std::size_t>(before)];
      const int copy = only_copy[static_cast<std::size_t>(element_of[v])];
      const EmbeddedPoint& point = shape->skin.point[static_cast<std::size_t>(before)];
      if (copy >= 0 && was_only_copy[static_cast<std::size_t>(element_of[v])] >= 0) {
        skin.point[v] = {copy, point.weight};  // unchanged: the vertex did not move at rest
        continue;
      }
    } else {
      element_of[v] = ElementAround(rest, field.grid(), cut->element_of_node, spec.mesh);
      if (element_of[v] < 0) element_of[v] = finder.Find(rest).element;
    }
    const ElementCopy copy = cut->cutter.FindCopy(element_of[v], rest);
    skin.point[v] = {std::max(copy.element, 0), copy.weight};
  }
  cut->element_of_vertex = std::move(element_of);
  cut->whole_vertex = std::move(carved.whole_vertex);

  const std::vector<int> from = PreviousNodes(after);
  shape = std::make_unique<BodyShape>(after.mesh, after.share, spec, std::move(skin),
                                      std::move(carved.is_fresh), field, shape->model.get());
  if (finish_side_work) finish_side_work();
  solver.Replace(shape->model, shape->fixed, from);
  wants_plan = true;
  wants_refresh = false;
  since_refresh = 0;
  BodyState moved;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto k = static_cast<std::size_t>(from[i]);
    moved.x.push_back(state.x[k]);
    moved.v.push_back(state.v[k]);
  }
  state = std::move(moved);
  ResizeBuffers();
}

}  // namespace arthro::simulation
