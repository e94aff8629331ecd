// Layers of cartilage of the femoral condyles, the tibial plateaus and the patella, from their
// published sizes: a curved plate that thins towards its border. The curvatures are chosen.
#pragma once

#include "authoring/models/library_model.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

enum class CartilageSite {
  kMedialCondyle,
  kLateralCondyle,
  kMedialPlateau,
  kLateralPlateau,
  kPatella
};

const CartilageSizes& PublishedSizesOf(CartilageSite site);

struct CartilageOptions {
  explicit CartilageOptions(CartilageSite its_site = CartilageSite::kMedialCondyle);

  CartilageSite site;
  double length, width, thickness;
  template <class V>
  void Visit(V&& v) {
    const CartilageSizes& sizes = PublishedSizesOf(site);
    v("length", length, sizes.length.InRange(), "m",
      "Length from front to back; of the patella, from top to bottom.");
    v("width", width, sizes.width.InRange(), "m", "Width from side to side.");
    v("thickness", thickness, sizes.thickness.InRange(), "m", "Mean thickness of the layer.");
  }
};

LibraryModel MakeCartilageModel(const CartilageOptions& options, KneeSide side);

}  // namespace arthro::authoring
