// A main that answers as TetGen's worker too: a job of a test that starts one starts this program.
#include <cstdlib>
#include <string_view>

#include <gtest/gtest.h>

#include "authoring/tissue/tetrahedra/tetgen_worker.h"

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "tetgen-worker")
    std::_Exit(arthro::authoring::RunTetgenWorker(argv[2]));
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
