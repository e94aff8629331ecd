// Commands for tissues given by functions: a new one, and the parts of the chosen one.
#include <type_traits>

#include "app/steps/panorama/panorama_step.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

bool MayAdd(const State& state) { return Idle(state) && HasPicture(state) && ShowsScope(state); }
bool HasSolid(const State& state) { return MayAdd(state) && IsSolidChosen(state); }

// Beside the chosen part, so that both are seen. A plane cuts what stands above it, since it has no
// end of its own.
template <class Part>
void Add(State& state) {
  const Solid* solid = ChosenSolid(state);
  if (solid == nullptr) return;
  Part part;
  const auto chosen = static_cast<std::size_t>(state.steps.tissue->solids->part);
  const SolidPlace& beside = PlaceOf(solid->parts[chosen]);
  part.place.level = beside.level;
  part.place.solid_from_part.translation = beside.solid_from_part.translation;
  if constexpr (std::is_same_v<Part, PlanePart>)
    part.place.join = SolidJoin::kIntersection;
  else
    part.place.solid_from_part.translation.x += 3e-3;
  AddSolidPart(state, part);
}

bool HasPartBefore(const State& state) {
  return HasSolid(state) && state.steps.tissue->solids->part > 0;
}
bool HasPartAfter(const State& state) {
  const SolidEditing& editing = *state.steps.tissue->solids;
  return HasSolid(state) && editing.part + 1 < static_cast<int>(editing.solid.parts.size());
}
bool HasSeveralParts(const State& state) {
  return HasSolid(state) && state.steps.tissue->solids->solid.parts.size() > 1;
}

constexpr Command kSolidCommands[] = {
    {"add-solid",
     "New solid",
     "Add a tissue given by functions: balls, rods, rings and boxes that are joined.",
     "Solid",
     {},
     {},
     MayAdd,
     AddSolid},
    {"add-ellipsoid",
     "Ellipsoid",
     "Add an ellipsoid to the chosen solid.",
     "Solid",
     {},
     {},
     HasSolid,
     Add<EllipsoidPart>,
     "First choose a solid, or add one."},
    {"add-capsule",
     "Capsule",
     "Add a rod with round ends to the chosen solid.",
     "Solid",
     {},
     {},
     HasSolid,
     Add<CapsulePart>,
     "First choose a solid, or add one."},
    {"add-torus",
     "Torus",
     "Add a ring to the chosen solid.",
     "Solid",
     {},
     {},
     HasSolid,
     Add<TorusPart>,
     "First choose a solid, or add one."},
    {"add-box",
     "Box",
     "Add a box to the chosen solid.",
     "Solid",
     {},
     {},
     HasSolid,
     Add<BoxPart>,
     "First choose a solid, or add one."},
    {"add-plane",
     "Plane",
     "Keep only what lies below a plane.",
     "Solid",
     {},
     {},
     HasSolid,
     Add<PlanePart>,
     "First choose a solid, or add one."},
    {"remove-part",
     "Remove",
     "Remove the chosen part of the solid.",
     "Solid",
     {},
     {},
     HasSeveralParts,
     RemoveSolidPart,
     "A solid keeps its last part."},
    {"part-up",
     "Earlier",
     "Join the chosen part one place earlier.",
     "Solid",
     {},
     {},
     HasPartBefore,
     [](State& state) { MoveSolidPart(state, -1); },
     "It is the first part."},
    {"part-down",
     "Later",
     "Join the chosen part one place later.",
     "Solid",
     {},
     {},
     HasPartAfter,
     [](State& state) { MoveSolidPart(state, 1); },
     "It is the last part."},
};

}  // namespace

std::span<const Command> SolidCommands() { return kSolidCommands; }

}  // namespace arthro::app
