// Outside of a tetrahedral mesh in the text format 4.1 of Gmsh, as a closed surface in the file's
// own unit.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::test {

// Vertices in the file's own unit, all of them; the triangles are those of one tetrahedron only.
inline SurfaceMesh OutsideOfGmsh(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string word;
  SurfaceMesh surface;
  std::map<long, int> index;
  while (stream >> word && word != "$Nodes") {
  }
  long blocks = 0, skip = 0;
  stream >> blocks >> skip >> skip >> skip;
  for (long block = 0; block < blocks; ++block) {
    long count = 0;
    stream >> skip >> skip >> skip >> count;
    std::vector<long> tags(count);
    for (long& tag : tags) stream >> tag;
    for (const long tag : tags) {
      glm::dvec3 x;
      stream >> x.x >> x.y >> x.z;
      index[tag] = static_cast<int>(surface.vertices.size());
      surface.vertices.push_back(x);
    }
  }
  while (stream >> word && word != "$Elements") {
  }
  stream >> blocks >> skip >> skip >> skip;
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> faces;
  for (long block = 0; block < blocks; ++block) {
    long dimension = 0, type = 0, count = 0;
    stream >> dimension >> skip >> type >> count;
    std::string line;
    std::getline(stream, line);
    for (long i = 0; i < count; ++i) {
      std::getline(stream, line);
      if (type != 4) continue;
      std::istringstream numbers(line);
      std::array<long, 4> tags{};
      numbers >> skip >> tags[0] >> tags[1] >> tags[2] >> tags[3];
      for (const auto& [a, b, c] :
           {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}}) {
        const std::array face = {index[tags[a]], index[tags[b]], index[tags[c]]};
        auto key = face;
        std::sort(key.begin(), key.end());
        auto& entry = faces[key];
        ++entry.first;
        entry.second = face;
      }
    }
  }
  for (const auto& [key, entry] : faces)
    if (entry.first == 1) surface.triangles.push_back(entry.second);
  return surface;
}

}  // namespace arthro::test
