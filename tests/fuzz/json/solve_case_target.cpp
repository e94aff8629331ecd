// Fuzz target: cases of the job solve, over a fixed volume.
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/cases/case_io.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/hostile/tet_block.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  static const bool has_volume = [] {
    WriteTetMesh(test::PrivateFolder() / "block.vtu", test::TetBlock(1));
    return true;
  }();
  static_cast<void>(has_volume);
  const auto file = test::InputFile("case.json", test::TextOf(data, size));
  return test::Refuses([&] { simulation::ReadCase(file); });
}
