#include "app/steps/tissue/cut/tissue_cut.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::app {
namespace {

const Tissue* TissueAt(const EditorState& state, int tissue) {
  const auto& tissues = state.document().scene.tissues;
  return tissue >= 0 && tissue < static_cast<int>(tissues.size())
             ? &tissues[static_cast<std::size_t>(tissue)]
             : nullptr;
}

// Into the tissue, as the triangle nearest to the place faces.
glm::dvec3 InwardAt(const SurfaceMesh& surface, const glm::dvec3& x) {
  glm::dvec3 inward(0, 0, -1);
  double least = std::numeric_limits<double>::max();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const TriangleCorners corner = CornersOf(surface, t);
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double distance = Distance2(corner, x);
    if (distance >= least || !(glm::length(normal) > 0.0)) continue;
    least = distance;
    inward = -glm::normalize(normal);
  }
  return inward;
}

glm::dvec3 InwardAlong(const SurfaceMesh& surface, const std::vector<glm::dvec3>& path) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& x : path) sum += InwardAt(surface, x);
  return glm::length(sum) > 1e-3 ? glm::normalize(sum) : InwardAt(surface, path.front());
}

void SetInOneStep(EditorState& state, int tissue, const Tissue& changed, const std::string& what) {
  SetTissue(state, tissue, changed, what);
  EndDrag(state);
}

void AddTearPoint(EditorState& state, int tissue, const glm::dvec3& x) {
  CutBrush& brush = state.steps.tissue->cut_brush;
  Tissue changed = *TissueAt(state, tissue);
  const SurfaceMesh& surface = *state.document().surfaces.at(static_cast<std::size_t>(tissue));
  const bool goes_on = brush.goes_on && tissue == state.tissue && ChosenCut(state) != nullptr &&
                       std::holds_alternative<TearCut>(*ChosenCut(state));
  if (goes_on) {
    auto& tear = std::get<TearCut>(changed.cuts[static_cast<std::size_t>(state.steps.tissue->cut)]);
    tear.path.push_back(x);
    tear.into = InwardAlong(surface, tear.path);
    SetInOneStep(state, tissue, changed, "Lengthen a tear of");
    return;
  }
  brush.goes_on = false;
  if (!brush.start || brush.start_tissue != tissue) {
    brush.start = x;
    brush.start_tissue = tissue;
    state.tissue = tissue;
    ChooseCut(state, -1);
    state.message = "Now click where the tear goes on.";
    return;
  }
  const double scale = changed.pose.scale;
  const std::vector<glm::dvec3> path{*brush.start, x};
  changed.cuts.push_back(TearCut{path, InwardAlong(surface, path), brush.depth / scale,
                                 brush.width / scale, CutBrush::kLead / scale});
  SetInOneStep(state, tissue, changed, "Tear");
  brush.start.reset();
  ChooseCut(state, static_cast<int>(changed.cuts.size()) - 1);
  brush.goes_on = true;
}

void AddBite(EditorState& state, int tissue, const glm::dvec3& x) {
  Tissue changed = *TissueAt(state, tissue);
  changed.cuts.push_back(
      CapsuleCut{x, x, state.steps.tissue->cut_brush.radius / changed.pose.scale});
  SetInOneStep(state, tissue, changed, "Bite");
  state.tissue = tissue;
  ChooseCut(state, static_cast<int>(changed.cuts.size()) - 1);
}

bool HasRegion(const Tissue& tissue, const std::string& name) {
  return std::ranges::any_of(tissue.regions, [&](const Region& r) { return r.name == name; });
}

void AddRegion(EditorState& state, int tissue, const glm::dvec3& x) {
  Tissue changed = *TissueAt(state, tissue);
  std::string name;
  for (int number = 1; name.empty() || HasRegion(changed, name); ++number)
    name = fmt::format("region {}", number);
  changed.regions.push_back(
      {name, {x, state.steps.tissue->cut_brush.region_radius / changed.pose.scale}});
  SetInOneStep(state, tissue, changed, "Name a region of");
  state.tissue = tissue;
  ChooseRegion(state, static_cast<int>(changed.regions.size()) - 1);
}

// Changes the chosen cut where it is of this kind.
template <class CutKind>
void ChangeCut(EditorState& state, const std::string& what, double CutKind::*field, double value) {
  const Cut* chosen = ChosenCut(state);
  if (chosen == nullptr || !std::holds_alternative<CutKind>(*chosen)) return;
  Tissue changed = *TissueAt(state, state.tissue);
  std::get<CutKind>(changed.cuts[static_cast<std::size_t>(state.steps.tissue->cut)]).*field =
      value / changed.pose.scale;
  SetTissue(state, state.tissue, changed, what);
}

}  // namespace

void LeaveBrush(EditorState& state) {
  CutBrush& brush = state.steps.tissue->cut_brush;
  if (!state.steps.tissue->brush && brush.kind == CutBrush::Kind::kNone) return;
  state.steps.tissue->brush.reset();
  brush.kind = CutBrush::Kind::kNone;
  brush.start.reset();
  brush.goes_on = false;
  state.message = "The overview turns and moves again.";
}

void ToggleCutBrush(EditorState& state, CutBrush::Kind kind) {
  CutBrush& brush = state.steps.tissue->cut_brush;
  brush.kind = brush.kind == kind ? CutBrush::Kind::kNone : kind;
  brush.start.reset();
  ChooseCut(state, -1);
  switch (brush.kind) {
    case CutBrush::Kind::kNone:
      state.message = "The overview turns and moves again.";
      break;
    case CutBrush::Kind::kTear:
      state.message = "Click along the tear on the tissue in either view; two points or more.";
      break;
    case CutBrush::Kind::kBite:
      state.message = "Click on the tissue in either view to take a round bite there.";
      break;
    case CutBrush::Kind::kRegion:
      state.message = "Click in the middle of the region on the tissue in either view.";
      break;
  }
}

void UseCutBrush(EditorState& state, int tissue, const glm::dvec3& x_in_tissue) {
  const Tissue* clicked = TissueAt(state, tissue);
  if (clicked == nullptr || !state.document().surfaces.at(static_cast<std::size_t>(tissue))) return;
  if (clicked->mesh.empty() && !clicked->is_implicit) {
    state.message = clicked->name + " has no tetrahedra yet; make them on its Mesh page first.";
    return;
  }
  switch (state.steps.tissue->cut_brush.kind) {
    case CutBrush::Kind::kTear:
      return AddTearPoint(state, tissue, x_in_tissue);
    case CutBrush::Kind::kBite:
      return AddBite(state, tissue, x_in_tissue);
    case CutBrush::Kind::kRegion:
      return AddRegion(state, tissue, x_in_tissue);
    case CutBrush::Kind::kNone:
      return;
  }
}

void ChooseCut(EditorState& state, int cut) {
  state.steps.tissue->cut = cut;
  state.steps.tissue->region = -1;
  state.steps.tissue->cut_brush.goes_on = false;
}

void ChooseRegion(EditorState& state, int region) {
  state.steps.tissue->cut = -1;
  state.steps.tissue->region = region;
  state.steps.tissue->cut_brush.goes_on = false;
}

const Cut* ChosenCut(const EditorState& state) {
  const Tissue* tissue = TissueAt(state, state.tissue);
  return tissue != nullptr && state.steps.tissue->cut >= 0 &&
                 state.steps.tissue->cut < static_cast<int>(tissue->cuts.size())
             ? &tissue->cuts[static_cast<std::size_t>(state.steps.tissue->cut)]
             : nullptr;
}

const Region* ChosenRegion(const EditorState& state) {
  const Tissue* tissue = TissueAt(state, state.tissue);
  return tissue != nullptr && state.steps.tissue->region >= 0 &&
                 state.steps.tissue->region < static_cast<int>(tissue->regions.size())
             ? &tissue->regions[static_cast<std::size_t>(state.steps.tissue->region)]
             : nullptr;
}

void SetTearDepth(EditorState& state, double depth) {
  state.steps.tissue->cut_brush.depth = depth;
  ChangeCut(state, "Change the depth of a tear of", &TearCut::depth, depth);
}

void SetTearWidth(EditorState& state, double width) {
  state.steps.tissue->cut_brush.width = width;
  ChangeCut(state, "Change the width of a tear of", &TearCut::width, width);
}

void SetBiteRadius(EditorState& state, double radius) {
  state.steps.tissue->cut_brush.radius = radius;
  ChangeCut(state, "Change a bite of", &CapsuleCut::radius, radius);
}

void SetRegionRadius(EditorState& state, double radius) {
  state.steps.tissue->cut_brush.region_radius = radius;
  if (ChosenRegion(state) == nullptr) return;
  Tissue changed = *TissueAt(state, state.tissue);
  changed.regions[static_cast<std::size_t>(state.steps.tissue->region)].ball.radius =
      radius / changed.pose.scale;
  SetTissue(state, state.tissue, changed, "Change a region of");
}

void RenameRegion(EditorState& state, const std::string& name) {
  if (ChosenRegion(state) == nullptr || name.empty() || name == kElsewhere) return;
  Tissue changed = *TissueAt(state, state.tissue);
  if (HasRegion(changed, name)) return;
  changed.regions[static_cast<std::size_t>(state.steps.tissue->region)].name = name;
  SetTissue(state, state.tissue, changed, "Rename a region of");
}

void RemoveChosenCut(EditorState& state) {
  if (ChosenCut(state) == nullptr) return;
  Tissue changed = *TissueAt(state, state.tissue);
  changed.cuts.erase(changed.cuts.begin() + state.steps.tissue->cut);
  state.steps.tissue->cut_brush.goes_on = false;
  SetInOneStep(state, state.tissue, changed, "Remove a cut of");
  if (state.steps.tissue->cut >= static_cast<int>(changed.cuts.size())) --state.steps.tissue->cut;
}

void RemoveAllCuts(EditorState& state) {
  const Tissue* tissue = TissueAt(state, state.tissue);
  if (tissue == nullptr || tissue->cuts.empty()) return;
  Tissue changed = *tissue;
  changed.cuts.clear();
  state.steps.tissue->cut_brush.goes_on = false;
  SetInOneStep(state, state.tissue, changed, "Remove all cuts of");
  state.steps.tissue->cut = -1;
}

void RemoveChosenRegion(EditorState& state) {
  if (ChosenRegion(state) == nullptr) return;
  Tissue changed = *TissueAt(state, state.tissue);
  changed.regions.erase(changed.regions.begin() + state.steps.tissue->region);
  SetInOneStep(state, state.tissue, changed, "Remove a region of");
  if (state.steps.tissue->region >= static_cast<int>(changed.regions.size()))
    --state.steps.tissue->region;
}

std::string CutName(const Tissue& tissue, int cut) {
  const Cut& named = tissue.cuts.at(static_cast<std::size_t>(cut));
  return fmt::format("{} {}", std::holds_alternative<TearCut>(named) ? "Tear" : "Bite", cut + 1);
}

std::string CutWords(const Tissue& tissue, int cut) {
  const Cut& described = tissue.cuts.at(static_cast<std::size_t>(cut));
  const auto mm = [&](double own) { return MmFromMetres(own * tissue.pose.scale); };
  if (const auto* tear = std::get_if<TearCut>(&described)) {
    double length = 0;
    for (std::size_t i = 1; i < tear->path.size(); ++i)
      length += glm::distance(tear->path[i - 1], tear->path[i]);
    return fmt::format("{} points, {:.1f} mm long", tear->path.size(), mm(length));
  }
  if (const auto* capsule = std::get_if<CapsuleCut>(&described))
    return fmt::format("round, radius {:.1f} mm", mm(capsule->radius));
  const glm::dvec3 size = 2.0 * std::get<BoxCut>(described).half;
  return fmt::format("square, {:.1f} x {:.1f} x {:.1f} mm", mm(size.x), mm(size.y), mm(size.z));
}

}  // namespace arthro::app
