#include "authoring/phantom/shape/disc_layer.h"

#include <algorithm>
#include <numbers>

namespace arthro::authoring {
namespace {

int FirstOfRing(int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); }
int OfRing(int ring, int i) { return ring == 0 ? 0 : FirstOfRing(ring) + i % (6 * ring); }

}  // namespace

SurfaceMesh DiscLayer(int rings, double rim, const DiscPlace& place) {
  SurfaceMesh layer;
  for (const bool is_top : {true, false})
    for (int ring = 0; ring <= rings; ++ring)
      for (int i = 0; i < std::max(6 * ring, 1); ++i) {
        const double angle = ring == 0 ? 0.0 : 2.0 * std::numbers::pi * i / (6.0 * ring);
        layer.vertices.push_back(place(rim * ring / rings, angle, is_top));
      }
  const int side = FirstOfRing(rings + 1);
  const auto face = [&](int a, int b, int c) {  // given as on the top, mirrored below
    layer.triangles.push_back({a, b, c});
    layer.triangles.push_back({side + a, side + c, side + b});
  };
  for (int ring = 1; ring <= rings; ++ring)
    for (int sextant = 0; sextant < 6; ++sextant)
      for (int i = 0; i < ring; ++i) {
        const int outer = sextant * ring + i, inner = sextant * (ring - 1) + i;
        face(OfRing(ring - 1, inner), OfRing(ring, outer), OfRing(ring, outer + 1));
        if (i + 1 < ring)
          face(OfRing(ring - 1, inner), OfRing(ring, outer + 1), OfRing(ring - 1, inner + 1));
      }
  for (int i = 0; i < 6 * rings; ++i) {
    const int a = OfRing(rings, i), b = OfRing(rings, i + 1);
    layer.triangles.push_back({a, side + a, side + b});
    layer.triangles.push_back({a, side + b, b});
  }
  return layer;
}

}  // namespace arthro::authoring
