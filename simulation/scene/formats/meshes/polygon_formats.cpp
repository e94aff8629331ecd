// STL, OBJ and OFF. Read here and not through VTK's readers, because those go through 32-bit floats
// and take a face index out of range, or a file cut off in the middle, without a word.
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/formats/meshes/polygon_soup.h"
#include "simulation/scene/formats/meshes/text_scanner.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

constexpr std::size_t kStlHeader = 84, kStlFacet = 50;  // bytes

std::string LowerCase(std::string_view word) {
  std::string lower(word);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(letter & 0xff));
  return lower;
}

PolygonSoup ParseTextStl(std::string_view bytes, const fs::path& file) {
  PolygonSoup soup;
  TextScanner scanner(bytes, file);
  std::string_view line;
  bool ended = false;
  while (scanner.NextLine(&line)) {
    const std::string word = LowerCase(TextScanner::TakeWord(&line));
    if (word == "vertex") {
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = scanner.TakeDouble(&line);
      soup.corners.push_back(static_cast<int>(soup.points.size()));
      soup.points.push_back(p);
    } else if (word == "endloop") {
      const int begin = soup.polygon_ends.empty() ? 0 : soup.polygon_ends.back();
      if (static_cast<int>(soup.corners.size()) - begin < 3)
        scanner.Refuse("a facet has fewer than three vertices");
      soup.ClosePolygon();
    } else if (word == "endsolid") {
      ended = true;
    } else if (word == "solid" || word == "facet" || word == "outer") {
      ended = false;
    } else if (!word.empty() && word != "endfacet") {
      scanner.Refuse(fmt::format("\"{}\" does not belong into an STL file", word.substr(0, 40)));
    }
  }
  if (!ended)
    throw Error(Code::kBadMesh,
                "this STL file is cut off: it has no \"endsolid\" at its end; copy or export it "
                "again",
                file);
  return soup;
}

PolygonSoup ParseBinaryStl(std::string_view bytes, std::uint32_t count) {
  PolygonSoup soup;
  soup.points.reserve(std::size_t{3} * count);
  for (std::size_t i = 0; i < count; ++i) {
    float xyz[9];  // after the facet's normal, which its corners say as well
    std::memcpy(xyz, bytes.data() + kStlHeader + i * kStlFacet + 12, sizeof xyz);
    for (int corner = 0; corner < 3; ++corner) {
      soup.corners.push_back(static_cast<int>(soup.points.size()));
      soup.points.emplace_back(xyz[3 * corner], xyz[3 * corner + 1], xyz[3 * corner + 2]);
    }
    soup.ClosePolygon();
  }
  return soup;
}

// "OFF", "COFF", "NOFF", "STOFF", ...: the letters before OFF say what else a vertex carries.
bool IsOffHeader(std::string_view word) { return word.ends_with("OFF") && word.size() <= 8; }

}  // namespace

PolygonSoup ParseStl(std::string_view bytes, const fs::path& file) {
  // A binary header may begin with "solid", so the size decides.
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHeader) std::memcpy(&count, bytes.data() + 80, 4);
  const bool size_fits = bytes.size() >= kStlHeader + std::size_t{count} * kStlFacet;
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  const bool begins_as_text = begin != bytes.npos && LowerCase(bytes.substr(begin, 5)) == "solid";
  const bool has_binary_bytes = bytes.substr(0, 4096).find('\0') != bytes.npos;
  if (begins_as_text && !has_binary_bytes) return ParseTextStl(bytes, file);
  if (bytes.size() < kStlHeader || !has_binary_bytes)
    throw Error(Code::kBadMesh, "this is not an STL file; export the surface again", file);
  if (!size_fits || count > std::numeric_limits<int>::max() / 3)
    throw Error(Code::kBadMesh,
                fmt::format("this STL file is cut off: its header promises {} triangles but there "
                            "are bytes for {}; copy or export it again",
                            count, (bytes.size() - kStlHeader) / kStlFacet),
                file);
  return ParseBinaryStl(bytes, count);
}

PolygonSoup ParseObj(std::string_view bytes, const fs::path& file) {
  PolygonSoup soup;
  TextScanner scanner(bytes, file);
  std::string_view line;
  std::string joined;  // a line that ends in a backslash goes on in the next one
  while (scanner.NextLine(&line)) {
    if (line.ends_with('\\')) {
      joined.clear();
      do {
        line.remove_suffix(1);
        joined += std::string(line) + " ";
      } while (scanner.NextLine(&line) && line.ends_with('\\'));
      joined += line;
      line = joined;
    }
    const std::string_view word = TextScanner::TakeWord(&line);
    if (word == "v") {
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = scanner.TakeDouble(&line);
      soup.points.push_back(p);
    } else if (word == "f") {
      const std::size_t begin = soup.corners.size();
      for (auto corner = TextScanner::TakeWord(&line); !corner.empty() && corner[0] != '#';
           corner = TextScanner::TakeWord(&line)) {
        // "7", "7/2", "7//3" or "7/2/3"; from 1, or from the last one so far when negative.
        const long long index = scanner.ToInteger(corner.substr(0, corner.find('/')));
        const long long count = static_cast<long long>(soup.points.size());
        if (index == 0 || index < -count || index > std::numeric_limits<int>::max())
          scanner.Refuse(fmt::format("vertex {} does not exist", index));
        soup.corners.push_back(static_cast<int>(index > 0 ? index - 1 : count + index));
      }
      if (soup.corners.size() - begin < 3) scanner.Refuse("a face has fewer than three corners");
      soup.ClosePolygon();
    } else if (word.find('\0') != word.npos) {
      scanner.Refuse("this is not text");
    }
  }
  // Faces may come before their vertices, so only now is it known which ones exist.
  const int count = static_cast<int>(soup.points.size());
  for (const int corner : soup.corners)
    if (corner >= count)
      throw Error(Code::kBadMesh,
                  fmt::format("a face names vertex {} but there are only {}; the file is damaged "
                              "or cut off, export it again",
                              corner + 1, count),
                  file);
  return soup;
}

PolygonSoup ParseOff(std::string_view bytes, const fs::path& file) {
  TextScanner scanner(bytes, file);
  std::string_view line;
  // Next line with something on it, comments cut off.
  const auto next = [&] {
    while (scanner.NextLine(&line)) {
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(" \t\r") != line.npos) return;
    }
    throw Error(Code::kBadMesh, "this OFF file is cut off before its end; copy or export it again",
                file);
  };
  next();
  std::string_view counts = line;
  if (!IsOffHeader(TextScanner::TakeWord(&counts)) || counts.find("BINARY") != counts.npos)
    throw Error(Code::kBadMesh, "this is not a text OFF file; export the surface again", file);
  line = counts;
  if (line.find_first_not_of(" \t\r") == line.npos) next();
  const long long points = scanner.TakeInteger(&line), faces = scanner.TakeInteger(&line);
  // Each takes a line of two characters at least, which bounds what a damaged count can ask for.
  const long long most = static_cast<long long>(bytes.size()) / 2;
  if (points < 0 || faces < 0 || points > most || faces > most)
    scanner.Refuse(
        fmt::format("{} vertices and {} faces cannot be in a file of this size", points, faces));
  PolygonSoup soup;
  soup.points.reserve(static_cast<std::size_t>(points));
  for (long long i = 0; i < points; ++i) {
    next();
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner.TakeDouble(&line);
    soup.points.push_back(p);
  }
  for (long long i = 0; i < faces; ++i) {
    next();
    const long long corners = scanner.TakeInteger(&line);
    if (corners < 3) scanner.Refuse("a face has fewer than three corners");
    for (long long k = 0; k < corners; ++k) {
      const long long index = scanner.TakeInteger(&line);
      if (index < 0 || index >= points)
        scanner.Refuse(
            fmt::format("vertex {} does not exist (there are {}, counted from 0)", index, points));
      soup.corners.push_back(static_cast<int>(index));
    }
    soup.ClosePolygon();
  }
  return soup;
}

}  // namespace arthro
