// A surface from the bytes of a fuzz input, by the ending of the name.
#pragma once

#include "simulation/scene/mesh/mesh_io.h"
#include "tests/fuzz/fuzz_input.h"

namespace arthro::test {

inline int ReadSurfaceOf(const char* name, std::string_view bytes) {
  const auto file = InputFile(name, bytes);
  return Refuses([&] {
    const SurfaceMesh surface = ReadSurface(file, 1e-3);
    const int count = static_cast<int>(surface.vertices.size());
    for (const auto& triangle : surface.triangles)
      for (const int corner : triangle)
        Require(corner >= 0 && corner < count, "a corner names a point of the surface");
  });
}

}  // namespace arthro::test
