// Medial and lateral meniscus from their published sizes: a crescent wedge on a level base. The
// angle about its middle is 0 in the body and grows towards the posterior horn.
#pragma once

#include "authoring/models/library_model.h"
#include "authoring/phantom/shape/crescent.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

enum class Compartment { kMedial, kLateral };

constexpr const MeniscusSizes& PublishedSizesOf(Compartment compartment) {
  return compartment == Compartment::kMedial ? kMedialMeniscusSizes : kLateralMeniscusSizes;
}

struct MeniscusOptions {
  explicit MeniscusOptions(Compartment its_compartment = Compartment::kMedial);

  Compartment compartment;
  double length, width, horn_distance;
  double anterior_width, body_width, posterior_width;
  double anterior_height, body_height, posterior_height;
  template <class V>
  void Visit(V&& v) {
    const MeniscusSizes& sizes = PublishedSizesOf(compartment);
    v("length", length, sizes.length.InRange(), "m", "Length from front to back.");
    v("width", width, sizes.width.InRange(), "m", "Width from side to side.");
    v("horn_distance", horn_distance, sizes.horn_distance.InRange(), "m",
      "Distance between the ends of the anterior and the posterior horn.");
    v("anterior_width", anterior_width, sizes.anterior_width.InRange(), "m",
      "Width of the anterior horn, from the free edge to the outer rim.");
    v("body_width", body_width, sizes.body_width.InRange(), "m", "Width of the body.");
    v("posterior_width", posterior_width, sizes.posterior_width.InRange(), "m",
      "Width of the posterior horn.");
    v("anterior_height", anterior_height, sizes.anterior_height.InRange(), "m",
      "Thickness of the anterior horn at the outer rim.");
    v("body_height", body_height, sizes.body_height.InRange(), "m",
      "Thickness of the body at the outer rim.");
    v("posterior_height", posterior_height, sizes.posterior_height.InRange(), "m",
      "Thickness of the posterior horn at the outer rim.");
  }
};

// Returns the crescent whose surface has these sizes.
Crescent CrescentOf(const MeniscusOptions& options);

LibraryModel MakeMeniscusModel(const MeniscusOptions& options, KneeSide side);

}  // namespace arthro::authoring
