// Fuzz target: volumes, VTU. Elements name nodes that are there.
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("volume.vtu", test::TextOf(data, size));
  return test::Refuses([&] {
    const TetMesh mesh = ReadTetMesh(file);
    const int count = static_cast<int>(mesh.rest_positions.size());
    for (const int node : mesh.elements)
      test::Require(node >= 0 && node < count, "an element names nodes of the volume");
  });
}
