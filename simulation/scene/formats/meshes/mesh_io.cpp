#include "simulation/scene/mesh/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/formats/meshes/polygon_soup.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

std::string Extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(letter & 0xff));
  return extension;
}

PolygonSoup Parse(const std::string& bytes, const fs::path& file) {
  const std::string extension = Extension(file);
  if (extension == ".stl") return ParseStl(bytes, file);
  if (extension == ".obj") return ParseObj(bytes, file);
  if (extension == ".ply") return ParsePly(bytes, file);
  if (extension == ".off") return ParseOff(bytes, file);
  if (extension == ".vtp") return ParseVtp(bytes, file);
  throw Error(Code::kBadMesh,
              fmt::format("\"{}\" is not a surface format that can be read; use .stl, .obj, .ply, "
                          ".off or .vtp",
                          extension),
              file);
}

template <class T>
void Append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

std::string PlyBytes(const SurfaceMesh& surface) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment unit: metre\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      surface.vertices.size(), surface.triangles.size());
  for (const glm::dvec3& p : surface.vertices)
    for (int axis = 0; axis < 3; ++axis) Append(bytes, p[axis]);
  for (const auto& triangle : surface.triangles) {
    Append(bytes, std::uint8_t{3});
    for (const int corner : triangle) Append(bytes, static_cast<std::int32_t>(corner));
  }
  return bytes;
}

// {} prints the shortest text that reads back to the same double.
std::string ObjBytes(const SurfaceMesh& surface) {
  std::string bytes = "# unit: metre\n";
  for (const glm::dvec3& p : surface.vertices) bytes += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : surface.triangles)
    bytes += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return bytes;
}

std::string StlBytes(const SurfaceMesh& surface) {
  std::string bytes = "binary STL, unit: metre";
  bytes.resize(80, ' ');
  Append(bytes, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    const glm::dvec3 &a = surface.vertices[triangle[0]], &b = surface.vertices[triangle[1]],
                     &c = surface.vertices[triangle[2]];
    const glm::dvec3 area = glm::cross(b - a, c - a);
    const double length = glm::length(area);
    const glm::dvec3 normal = length > 0 ? area / length : glm::dvec3(0.0);
    for (const glm::dvec3& v : {normal, a, b, c})
      for (int axis = 0; axis < 3; ++axis) Append(bytes, static_cast<float>(v[axis]));
    Append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace

SurfaceMesh ReadSurface(const fs::path& file, double metres_per_unit, SurfaceReadReport* report) {
  if (IsSolidFile(file)) {
    try {
      return SurfaceOfSolid(Scaled(ReadSolid(file), metres_per_unit));
    } catch (const Error& error) {
      throw Error(Code::kBadMesh, error.sentence(), file);
    }
  }
  std::string bytes;
  try {
    bytes = ReadWholeFile(file);
  } catch (const Error& error) {
    throw Error(Code::kBadMesh, error.sentence(), file);
  }
  if (bytes.empty())
    throw Error(Code::kBadMesh, "this surface is empty (0 bytes); export it again", file);
  return SurfaceFromPolygons(Parse(bytes, file), metres_per_unit, file, report);
}

void WriteSurface(const fs::path& file, const SurfaceMesh& surface, const SurfaceLabels& labels) {
  const std::string extension = Extension(file);
  if (extension == ".ply") return WriteAtomically(file, PlyBytes(surface));
  if (extension == ".obj") return WriteAtomically(file, ObjBytes(surface));
  if (extension == ".stl") return WriteAtomically(file, StlBytes(surface));
  if (extension == ".vtp") return WriteAtomically(file, VtpBytes(surface, labels));
  throw Error(Code::kBadArgument,
              fmt::format("\"{}\" is not a surface format that can be written; use .ply, .obj, "
                          ".stl or .vtp",
                          extension),
              file);
}

}  // namespace arthro
