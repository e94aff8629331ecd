// A digital phantom: makes from a seed a knee cavity with exactly known truth, as a scene, with
// deformable models and the hand motions of a short session. Portal frame, m.
#pragma once

#include <string>
#include <vector>

#include "authoring/phantom/look/appearance.h"
#include "authoring/phantom/look/panorama_renderer.h"
#include "authoring/phantom/phantom_trace.h"
#include "authoring/phantom/shape/cavity.h"
#include "authoring/phantom/shape/phantom_tissue.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

enum class PhantomSize { kSmall, kMedium, kLarge };
enum class PictureFormat { kPng, kJpg };

struct PhantomOptions {
  int seed = 1;
  PhantomSize size = PhantomSize::kMedium;
  Difficulty difficulty = Difficulty::kEasy;
  ProjectionType projection = ProjectionType::kEquirectangular;
  PictureFormat picture = PictureFormat::kPng;
  int threads = 0;
  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Range{0, 2147483647}, "",
      "Seed of the knee: sizes, folds, vessels and colours follow from it.");
    v("size", size,
      Choices<PhantomSize>{
          {{PhantomSize::kSmall, "S"}, {PhantomSize::kMedium, "M"}, {PhantomSize::kLarge, "L"}}},
      "", "Panorama of 1024 x 768, 2048 x 1536 or 4096 x 3072 pixels.");
    v("difficulty", difficulty,
      Choices<Difficulty>{{{Difficulty::kEasy, "easy"},
                           {Difficulty::kMedium, "medium"},
                           {Difficulty::kHard, "hard"}}},
      "",
      "Harder pictures have fainter texture (60 %, 32 %) and vessels (70 %, 42 %), haze (10 %, 22 "
      "% at 50 mm) "
      "and less light (85 %, 65 %).");
    v("projection", projection,
      Choices<ProjectionType>{{{ProjectionType::kEquirectangular, "equirectangular"},
                               {ProjectionType::kGnomonic, "gnomonic"}}},
      "",
      "Panorama of 200 by 150 degrees of latitude and longitude, or a flat mosaic of 120 by 105 "
      "degrees.");
    v("picture", picture,
      Choices<PictureFormat>{{{PictureFormat::kPng, "png"}, {PictureFormat::kJpg, "jpg"}}}, "",
      "Panoramas as lossless PNG, or as JPEG of a tenth of the size.");
    v("threads", threads, Range{0, 256}, "",
      "Drawing threads; 0 takes one per processor. The result does not depend on it.");
  }
};

struct Phantom {
  PhantomOptions options;
  Cavity cavity;
  Projection projection;
  PhantomPicture without_tissues, with_tissues;
  PhantomTissue meniscus, cartilage;
  std::vector<Landmark> landmarks;  // on the bones and on both tissues
  // m. The instrument comes from the scope's medial side, as through an anteromedial portal beside
  // the patellar tendon: so near that its shaft passes behind the anterior horn, over the plateau's
  // dish. From 25 mm on it would lie on the anterior rim before a hook is under the free edge.
  double incision_spacing = 0.018;
  std::vector<TraceRow> trace;
};

// Width and height of the panorama, and its projection from the portal.
struct PhantomFrame {
  int width = 0, height = 0;
  Projection projection;
};
PhantomFrame FrameOf(const PhantomOptions& options);

// Makes the same phantom, bit for bit, from the same options, whatever `threads` is.
Phantom MakePhantom(const PhantomOptions& options, const Progress& progress = {});

}  // namespace arthro::authoring
