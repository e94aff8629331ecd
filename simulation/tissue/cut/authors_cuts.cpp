#include "simulation/tissue/cut/authors_cuts.h"

#include "simulation/core/error.h"
#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {

CrumbReport RemoveDebris(SolidField& field, std::span<const Ball> fixed) {
  if (fixed.empty()) return {};
  const FieldPieces pieces = PiecesWithoutVolumes(field);
  std::vector<unsigned char> is_debris = HeldPieces(field, pieces, fixed);
  for (std::size_t i = 0; i < is_debris.size(); ++i)
    is_debris[i] =
        is_debris[i] == 0 && VolumeOfPiece(field, pieces, static_cast<int>(i)) < kDebrisVolume;
  return RemovePieces(field, pieces, is_debris);
}

MadeCuts MakeCuts(SolidField& field, std::span<const Cut> cuts, std::span<const Ball> fixed) {
  MadeCuts made;
  for (const Cut& cut : cuts) {
    const FieldEdit edit = Apply(field, cut);
    made.removed.push_back(edit.removed);
    made.changed = Union(made.changed, edit.changed);
  }
  if (made.changed.empty()) return made;
  made.washed = RemoveDebris(field, fixed);
  made.changed = Union(made.changed, made.washed.edit.changed);
  if (!(field.Volume() > 0.0))
    throw Error(Code::kBadScene,
                "its cuts leave nothing of it; remove one of \"cuts\" or make it smaller");
  return made;
}

}  // namespace arthro::simulation
