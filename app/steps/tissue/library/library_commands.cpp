// Commands of the library: its models, and the usual tears of a meniscus.
#include "app/state/command.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

template <authoring::ModelKind kind>
void AddModelOf(State& state) {
  AddLibraryModel(state, kind);
}

constexpr Command kLibraryCommands[] = {
    {"library",
     "Library",
     "Show ready-made models of the structures of the knee, or hide them.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     [](State& state) {
       // From another step it is opened, whatever it was there.
       bool& is_open = state.steps.tissue->shelf->is_open;
       is_open = state.step != Step::kTissue || !is_open;
       state.step = Step::kTissue;
     }},
    {"add-medial-meniscus",
     "Medial meniscus",
     "Lay a medial meniscus onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kMedialMeniscus>},
    {"add-lateral-meniscus",
     "Lateral meniscus",
     "Lay a lateral meniscus onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kLateralMeniscus>},
    {"add-medial-condyle",
     "Medial condyle",
     "Lay the cartilage of the medial condyle onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kMedialCondyle>},
    {"add-lateral-condyle",
     "Lateral condyle",
     "Lay the cartilage of the lateral condyle onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kLateralCondyle>},
    {"add-medial-plateau",
     "Medial plateau",
     "Lay the cartilage of the medial plateau onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kMedialPlateau>},
    {"add-lateral-plateau",
     "Lateral plateau",
     "Lay the cartilage of the lateral plateau onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kLateralPlateau>},
    {"add-patella",
     "Patella",
     "Lay the cartilage of the patella onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kPatella>},
    {"add-loose-body",
     "Loose body",
     "Lay a loose body onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kLooseBody>},
    {"add-synovial-tuft",
     "Synovial tuft",
     "Lay a tuft of synovial villi onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kSynovialTuft>},
    {"add-ligament-stump",
     "Ligament stump",
     "Lay the stump of a torn ligament onto the relief in the middle of the view.",
     "Library",
     {},
     {},
     HasPictureAndTime,
     AddModelOf<authoring::ModelKind::kLigamentStump>},
    {"make-tear",
     "Make this tear",
     "Cut the chosen kind of tear into the chosen meniscus.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     MakeChosenTear,
     "First choose a tissue."},
};

}  // namespace

std::span<const Command> LibraryCommands() { return kLibraryCommands; }

}  // namespace arthro::app
