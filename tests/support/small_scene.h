// A whole scene in a folder, small enough that a test opens it in no time: a knee picture made in
// code, its relief, and one closed surface as a tissue.
#pragma once

#include <filesystem>

#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/knee_picture.h"

namespace arthro::test {

// An octahedron of radius `r`, m.
inline SurfaceMesh Octahedron(double r) {
  return {{{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

// `folder` is made; returns it.
inline std::filesystem::path WriteSmallScene(const std::filesystem::path& folder,
                                             bool with_tissue = true) {
  std::filesystem::create_directories(folder);
  constexpr int kWidth = 400, kHeight = 300;
  WriteColourImage(folder / "panorama.png", KneePicture(kWidth, kHeight));
  DepthMap depth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth.at(x, y) = static_cast<float>(
          0.01 * KneeRelief((2.0 * x + 1.0) / kWidth - 1.0, (2.0 * y + 1.0) / kHeight - 1.0));
  WriteDepthMap(folder / "depth.tiff", depth);
  Scene scene;
  scene.title = "Small knee";
  scene.backdrop.panorama = "panorama.png";
  scene.backdrop.depth = "depth.tiff";
  scene.backdrop.projection.centre_px = {(kWidth - 1) / 2.0, (kHeight - 1) / 2.0};
  scene.backdrop.projection.focal_px = 150;
  if (with_tissue) {
    WriteSurface(folder / "octahedron.ply", Octahedron(0.006));
    Tissue& tissue = scene.tissues.emplace_back();
    tissue.name = "octahedron";
    tissue.surface = "octahedron.ply";
    tissue.pose.position = {0.0, 0.0, 0.03};
  }
  WriteScene(folder / "scene.json", scene);
  return folder;
}

}  // namespace arthro::test
