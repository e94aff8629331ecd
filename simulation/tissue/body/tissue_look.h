// How a tissue is drawn: colours as factors of the tissue's own colour in a scene, and its
// structure at rest. Part of a preset; an author may edit it. Linear RGB; m.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro::simulation {

enum class TissueStructure {
  kPlain,   // no structure of its own
  kFibres,  // crescent of circumferential fibres, free edge to vascular rim: a meniscus
  kHyaline  // smooth plate that thins towards its border: cartilage
};

struct TissueLook {
  TissueStructure structure = TissueStructure::kPlain;
  glm::dvec3 tint{1.0}, edge_tint{1.0}, rim_tint{1.0, 0.55, 0.48}, root_tint{1.0};
  glm::dvec3 cut_tint{1.08, 1.06, 0.98};
  glm::dvec3 vessel_colour{0.42, 0.05, 0.04};
  double vessels = 0, fibres = 0, fibrillation = 0;
  double fraying = 0, villi = 0;
  double fibre_width = 0.2e-3;
  double gloss = 1;
  friend bool operator==(const TissueLook&, const TissueLook&) = default;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kTint{0, 2}, kShare{0, 1};
    v("structure", structure,
      Choices<TissueStructure>{{{TissueStructure::kPlain, "plain"},
                                {TissueStructure::kFibres, "fibres"},
                                {TissueStructure::kHyaline, "hyaline"}}},
      "", "Structure of the surface at rest.");
    v("tint", tint, kTint, "", "Factor of the tissue's colour.");
    v("edge_tint", edge_tint, kTint, "", "Factor at the free edge of a crescent or at a border.");
    v("rim_tint", rim_tint, kTint, "", "Factor at the rim of a crescent, where vessels enter.");
    v("root_tint", root_tint, kTint, "", "Factor at the ends of a crescent.");
    v("cut_tint", cut_tint, kTint, "", "Factor on the faces of cuts.");
    v("vessel_colour", vessel_colour, kShare, "", "Linear red, green, blue of capillaries.");
    v("vessels", vessels, kShare, "", "Strength of the vascular rim and its capillaries.");
    v("fibres", fibres, kShare, "", "Strength of the fibre bundles.");
    v("fibrillation", fibrillation, kShare, "", "Strength of the fraying of a worn surface.");
    v("fraying", fraying, kShare, "", "Number of fibre bundles that stand out of a cut face.");
    v("villi", villi, kShare, "", "Number of villi on the surface, which sway in the fluid.");
    v("fibre_width", fibre_width, Range{2e-5, 2e-3}, "m", "Width of a fibre bundle.");
    v("gloss", gloss, Range{0, 3}, "", "Factor of the sheen of the film of fluid.");
  }
};

}  // namespace arthro::simulation
