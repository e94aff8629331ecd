#include "app/steps/solids/solid_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "app/state/chosen_tissue.h"
#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/models/model_in_scene.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/file_name.h"
#include "simulation/scene/solids/solid_io.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {
namespace fs = std::filesystem;

namespace {

// Cells of the surface while a slider is held: an eighth of the work.
constexpr int kPreviewCells = kSolidCells / 2;
constexpr double kNewRadius = 3e-3;  // m, of the ball that a solid begins with

SolidEditing& SolidsOf(EditorState& state) { return *state.steps.tissue->solids; }

// Writes `solid` into a new file, and makes it that of a tissue of `document`.
void PutSolid(authoring::Document& document, std::size_t tissue, const fs::path& file,
              const std::shared_ptr<const SurfaceMesh>& surface) {
  const std::string name = "tissues/" + file.filename().string();
  document.scene.tissues[tissue].surface = name;
  document.surfaces[tissue] = surface;
  document.files[name] = {file, surface, {}};
}

// Makes `next` the chosen solid; says why not where it is unfit.
void ChangeSolid(EditorState& state, const Solid& next, const std::string& what) {
  SolidEditing& editing = SolidsOf(state);
  if (next == editing.solid && !editing.is_coarse) return;
  const auto at = static_cast<std::size_t>(state.tissue);
  const Tissue tissue = *ChosenTissue(state);
  try {
    const auto surface = Share(SurfaceOfSolid(next, state.dragging ? kPreviewCells : kSolidCells));
    const fs::path file = state.scratch.NewFile(FileNameFrom(tissue.name, "solid") + ".solid");
    WriteSolid(file, next);
    Edit(state, what + " " + tissue.name, fmt::format("solid {}.{}", state.tissue, what),
         [&](authoring::Document& document) {
           PutSolid(document, at, file, surface);
           // Its tetrahedra fill the shape that it had.
           if (!document.scene.tissues[at].mesh.empty()) {
             document.scene.tissues[at].mesh.clear();
             document.scene.tissues[at].is_implicit = true;
           }
         });
    editing.solid = next;
    editing.read_of = surface;
    editing.is_coarse = state.dragging;
    editing.fault.clear();
  } catch (const Error& error) {
    editing.fault = error.sentence();
    state.message = "Not changed: " + editing.fault;
    if (!state.dragging && editing.is_coarse && next != editing.solid) {
      const std::string fault = editing.fault;
      ChangeSolid(state, Solid(editing.solid), what);  // the last fit one, with a fine surface
      editing.fault = fault;
    }
  }
  if (!state.dragging) EndDrag(state);
}

// A plane has no end; it is shown as a disc.
SharedSurface SurfaceOfPart(const SolidPart& part) {
  if (!std::holds_alternative<PlanePart>(part))
    return Share(SurfaceOfSolid(Solid{{part}}, kPreviewCells));
  constexpr double kDisc = 6e-3;  // m
  constexpr int kCorners = 32;
  SurfaceMesh disc{{{0, 0, 0}}, {}};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    disc.vertices.emplace_back(kDisc * std::cos(angle), kDisc * std::sin(angle), 0);
    disc.triangles.push_back({0, 1 + i, 1 + (i + 1) % kCorners});
  }
  return Share(std::move(disc));
}

}  // namespace

bool IsSolidChosen(const EditorState& state) {
  const Tissue* tissue = ChosenTissue(state);
  return tissue != nullptr && IsSolidFile(tissue->surface);
}

const Solid* ChosenSolid(EditorState& state) {
  if (!IsSolidChosen(state)) return nullptr;
  SolidEditing& editing = SolidsOf(state);
  const auto& surface = state.document().surfaces[static_cast<std::size_t>(state.tissue)];
  if (editing.read_of.lock() != surface || !surface) {
    editing.part = 0;
    try {
      editing.solid = ReadSolid(FileOf(state.document(), ChosenTissue(state)->surface));
      editing.read_of = surface;
      editing.is_coarse = false;
      editing.fault.clear();
    } catch (const Error& error) {
      editing.fault = error.sentence();
      return nullptr;
    }
  }
  editing.part = std::clamp(editing.part, 0, static_cast<int>(editing.solid.parts.size()) - 1);
  return &editing.solid;
}

void AddSolid(EditorState& state) {
  EllipsoidPart ball;
  ball.radii = glm::dvec3(kNewRadius);
  ball.place.solid_from_part.translation.z = kNewRadius;  // its base at the origin
  const Solid solid{{ball}};
  authoring::LibraryModel model;
  model.name = "solid";
  model.surface = SurfaceOfSolid(solid);
  model.material = "meniscus-probe";
  model.colour = Tissue().colour;
  model.is_solid = true;
  const auto view = simulation::ViewFromPose(state.scope, state.document().scene.scope.view_angle);
  const Pose pose = authoring::PoseOnRelief(model, state.document(), view.tip, view.view);
  const fs::path file = state.scratch.NewFile("solid.solid");
  WriteSolid(file, solid);
  Edit(state, "Add a solid", "", [&](authoring::Document& next) {
    authoring::AddModel(next, model, pose, {}, {});
    next.scene.tissues.back().rights = {};
    PutSolid(next, next.scene.tissues.size() - 1, file, next.surfaces.back());
  });
  state.tissue = static_cast<int>(state.document().scene.tissues.size()) - 1;
  state.step = Step::kTissue;
  state.steps.tissue->page = TissuePage::kSolid;
  SolidsOf(state).part = 0;
  state.message = "A ball lies on the relief; its Solid page has its parts.";
}

void AddSolidPart(EditorState& state, SolidPart part) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  SolidEditing& editing = SolidsOf(state);
  Solid next = *solid;
  const int at = editing.part + 1;
  next.parts.insert(next.parts.begin() + at, part);
  ChangeSolid(state, next, "Add a part to");
  if (editing.fault.empty()) editing.part = at;
}

void RemoveSolidPart(EditorState& state) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  Solid next = *solid;
  next.parts.erase(next.parts.begin() + SolidsOf(state).part);
  ChangeSolid(state, next, "Remove a part of");
  ChosenSolid(state);
}

void MoveSolidPart(EditorState& state, int by) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  SolidEditing& editing = SolidsOf(state);
  const int to = editing.part + by;
  if (to < 0 || to >= static_cast<int>(solid->parts.size())) return;
  Solid next = *solid;
  std::swap(next.parts[static_cast<std::size_t>(editing.part)],
            next.parts[static_cast<std::size_t>(to)]);
  ChangeSolid(state, next, "Reorder");
  if (editing.fault.empty()) editing.part = to;
}

void SetSolidPart(EditorState& state, const SolidPart& changed, const std::string& what) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  Solid next = *solid;
  next.parts[static_cast<std::size_t>(SolidsOf(state).part)] = changed;
  ChangeSolid(state, next, what);
}

PartInPortal ChosenPart(EditorState& state) {
  if (state.step != Step::kTissue || state.steps.tissue->page != TissuePage::kSolid ||
      state.practice)
    return {};
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return {};
  SolidEditing& editing = SolidsOf(state);
  const SolidPart& part = solid->parts[static_cast<std::size_t>(editing.part)];
  const Rigid3& place = PlaceOf(part).solid_from_part;
  SolidPart alone = part;
  PlaceOf(alone) = {};
  if (editing.part_of != alone) {
    editing.part_of = alone;
    editing.part_surface = SurfaceOfPart(alone);
  }
  const Pose& tissue = ChosenTissue(state)->pose;
  return {editing.part_surface,
          {tissue * place.translation, glm::normalize(tissue.quaternion * place.rotation),
           tissue.scale}};
}

void PlacePart(EditorState& state, const Pose& portal_from_part, bool is_finished) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  SolidEditing& editing = SolidsOf(state);
  if (!editing.dragged) editing.dragged = solid->parts[static_cast<std::size_t>(editing.part)];
  const Pose tissue = ChosenTissue(state)->pose;
  const glm::dquat turn = glm::conjugate(tissue.quaternion);
  // Its size first: that moves its centre as well.
  SolidPart part =
      Scaled(Solid{{*editing.dragged}}, portal_from_part.scale / tissue.scale).parts[0];
  PlaceOf(part).solid_from_part = {
      glm::normalize(turn * portal_from_part.quaternion),
      turn * (portal_from_part.position - tissue.position) / tissue.scale};
  PlaceOf(part).blend = PlaceOf(*editing.dragged).blend;
  state.dragging = !is_finished;
  SetSolidPart(state, part, "Place a part of");
  if (!is_finished) return;
  editing.dragged.reset();
  EndDrag(state);
}

}  // namespace arthro::app
