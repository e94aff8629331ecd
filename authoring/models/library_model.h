// Ready-made model of a structure of the knee: a closed surface with what a scene needs beside it.
// Own frame, m: x to the patient's left, y posterior, z from the bone into the joint; its base
// rests at z = 0 around the origin. The patella's y points upwards in the knee instead.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "authoring/models/published_size.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

enum class KneeSide { kLeft, kRight };

// Size of a model, measured on its surface, m.
struct MeasuredSize {
  double value = 0;
  const PublishedSize* published = nullptr;
  bool IsInRange() const {
    // The surface is drawn with finite triangles, whose chords fall short of the curve.
    constexpr double kChord = 0.02 * kMetrePerMillimetre;
    return value >= published->least - kChord && value <= published->most + kChord;
  }
};

// Division of a model by names, such as the zones of a meniscus.
struct ModelParts {
  std::vector<std::string> names;
  std::vector<std::uint8_t> of_vertex;  // index in names; empty: the model is not divided so
};

struct LibraryModel {
  std::string name;
  SurfaceMesh surface;
  ModelParts thirds;  // anterior horn, body, posterior horn
  ModelParts zones;   // red-red, red-white, white-white, by the distance from the outer rim
  std::vector<Region> regions;
  std::vector<Ball> fixed;
  std::string material;    // name of a tissue preset
  glm::dvec3 colour{1.0};  // linear RGB
  bool is_solid = false;   // touched as a function; it does not give way
  std::vector<MeasuredSize> sizes;
};

// Mirrors a model in x: the same structure of the other knee.
void Mirror(LibraryModel& model);

// Returns the tissue of a scene, whose surface is not yet in a file.
Tissue TissueOf(const LibraryModel& model);

}  // namespace arthro::authoring
