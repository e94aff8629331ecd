// File of landmark pairs for `arthroscene align`: arthroscene.pairs/1. A pair names a point of the
// model, in the tissue's own frame, and its partner in the scene: a pixel of the panorama or of the
// scope's picture, whose range is that of the relief, or a place. m, px; angles in degrees in the
// file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "authoring/alignment/landmark_alignment.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro::authoring {

inline constexpr Range kPixelRange{-0.5, 65535};

struct PanoramaClick {
  glm::dvec2 pixel{0.0};
  template <class V>
  void Visit(V&& v) {
    v("pixel", pixel, Required{kPixelRange}, "px", "Pixel of the panorama.");
  }
};

// The view angle, the field of view and the lens are those of the scene; the camera head turns with
// the scope.
struct ScopeClick {
  glm::dvec2 pixel{0.0};
  int size = 512;
  double latitude = 0, longitude = 0, roll = 0, insertion = 0.01;
  template <class V>
  void Visit(V&& v) {
    v("pixel", pixel, Required{kPixelRange}, "px", "Pixel of the scope's picture.");
    v("size", size, Range{16, 8192}, "px", "Width and height of that picture.");
    v("latitude", latitude, Range{-kRightAngle, kRightAngle}, "rad", "Latitude of the rod.");
    v("longitude", longitude, Range{-kRightAngle, kRightAngle}, "rad", "Longitude of the rod.");
    v("roll", roll, Range{-8 * kRightAngle, 8 * kRightAngle}, "rad", "Roll of the scope.");
    v("insertion", insertion, kCoordinate, "m", "From the portal to the tip.");
  }
  static constexpr double kRightAngle = std::numbers::pi / 2;
};

struct PlaceInScene {
  glm::dvec3 position{0.0};
  double sigma = 5e-4;
  template <class V>
  void Visit(V&& v) {
    v("position", position, Required{kCoordinate}, "m", "Place in the portal frame.");
    v("sigma", sigma, kLength, "m", "Standard error of the place.");
  }
};

struct PairInFile {
  std::string name;
  glm::dvec3 model{0.0};
  std::optional<PanoramaClick> panorama;
  std::optional<ScopeClick> scope;
  std::optional<PlaceInScene> place;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Any{}, "", "Name of the landmark.");
    v("model", model, Required{kCoordinate}, "m", "Point of the model in the tissue's own frame.");
    v("panorama", panorama, Any{}, "", "Partner in the panorama.");
    v("scope", scope, Any{}, "", "Partner in a picture of the scope.");
    v("place", place, Any{}, "", "Partner by its coordinates.");
  }
};

struct PairsFile {
  std::vector<PairInFile> pairs;
  template <class V>
  void Visit(V&& v) {
    v("pairs", pairs, Required{Any{}}, "", "Pairs of landmarks; a pair has one partner.");
  }
};

// Throws Error(kBadData) with the key and what is wrong.
PairsFile ParsePairs(const std::string& text, const std::filesystem::path& file = {});
PairsFile ReadPairs(const std::filesystem::path& file);
std::string PairsSchemaText();

// The pairs with the places of their partners. Throws Error(kBadData) for a partner where nothing
// was imaged, or outside its picture. `unstated`: as for PointOnRelief.
std::vector<LandmarkPair> PairsInScene(const PairsFile& pairs, const LoadedScene& scene,
                                       ReliefOrigin unstated,
                                       const std::filesystem::path& file = {});

}  // namespace arthro::authoring
