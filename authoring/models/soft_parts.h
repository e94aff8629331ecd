// Models of soft parts that float in a joint or hang into it: a loose body, a tuft of synovial
// villi, and the stump of a torn ligament. Their shapes are irregular and follow a seed.
#pragma once

#include "authoring/models/library_model.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

inline constexpr Range kSeeds{0, 1000000};

struct LooseBodyOptions {
  double length = kLooseBodyLength.mean;
  double flatness = 0.6;
  int seed = 1;
  template <class V>
  void Visit(V&& v) {
    v("length", length, kLooseBodyLength.InRange(), "m", "Longest diameter.");
    v("flatness", flatness, Range{0.3, 1.0}, "", "Least diameter over the longest.");
    v("seed", seed, kSeeds, "", "Seed of the bumps.");
  }
};

struct SynovialTuftOptions {
  double length = kTuftLength.mean;
  int villi = 7;
  int seed = 1;
  template <class V>
  void Visit(V&& v) {
    v("length", length, kTuftLength.InRange(), "m", "Length of the longest villus.");
    v("villi", villi, Range{1, 12}, "", "Number of villi.");
    v("seed", seed, kSeeds, "", "Seed of their directions.");
  }
};

struct LigamentStumpOptions {
  double length = kStumpLength.mean;
  double width = kStumpWidth.mean;
  double thickness = kStumpThickness.mean;
  int seed = 1;
  template <class V>
  void Visit(V&& v) {
    v("length", length, kStumpLength.InRange(), "m", "Length from the bone to the frayed end.");
    v("width", width, kStumpWidth.InRange(), "m", "Width in the middle.");
    v("thickness", thickness, kStumpThickness.InRange(), "m", "Thickness in the middle.");
    v("seed", seed, kSeeds, "", "Seed of the frayed end.");
  }
};

LibraryModel MakeLooseBody(const LooseBodyOptions& options, KneeSide side);
LibraryModel MakeSynovialTuft(const SynovialTuftOptions& options, KneeSide side);
LibraryModel MakeLigamentStump(const LigamentStumpOptions& options, KneeSide side);

}  // namespace arthro::authoring
