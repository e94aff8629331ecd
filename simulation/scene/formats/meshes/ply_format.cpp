// PLY: text, binary little-endian and binary big-endian, any scalar types, unknown elements and
// properties skipped. Read here and not through VTK's reader for the reasons in
// polygon_formats.cpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/formats/meshes/polygon_soup.h"
#include "simulation/scene/formats/meshes/text_scanner.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

constexpr int SizeOf(Scalar type) {
  constexpr std::array<int, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::optional<Scalar> ScalarFromWord(std::string_view word) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kWords = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t i = 0; i < kWords.size(); ++i)
    if (word == kWords[i][0] || word == kWords[i][1]) return static_cast<Scalar>(i);
  return std::nullopt;
}

struct Property {
  std::string name;
  Scalar type = Scalar::kFloat32;
  std::optional<Scalar> count_type;  // set for a list
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

Header ReadHeader(TextScanner& scanner) {
  Header header;
  std::string_view line;
  bool has_format = false;
  while (scanner.NextLine(&line)) {
    const std::string_view word = TextScanner::TakeWord(&line);
    if (word == "end_header") {
      if (!has_format) scanner.Refuse("the header names no format");
      return header;
    }
    if (word == "format") {
      const std::string_view format = TextScanner::TakeWord(&line);
      has_format = true;
      if (format == "ascii")
        header.encoding = Encoding::kText;
      else if (format == "binary_little_endian")
        header.encoding = Encoding::kLittleEndian;
      else if (format == "binary_big_endian")
        header.encoding = Encoding::kBigEndian;
      else
        scanner.Refuse(fmt::format("\"{}\" is not a PLY format", format.substr(0, 40)));
    } else if (word == "element") {
      Element element;
      element.name = TextScanner::TakeWord(&line);
      element.count = scanner.TakeInteger(&line);
      if (element.count < 0) scanner.Refuse("the number of an element is negative");
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) scanner.Refuse("a property belongs to no element");
      Property property;
      std::string_view type = TextScanner::TakeWord(&line);
      if (type == "list") {
        property.count_type = ScalarFromWord(TextScanner::TakeWord(&line));
        if (!property.count_type) scanner.Refuse("the count of a list has an unknown type");
        type = TextScanner::TakeWord(&line);
      }
      const auto known = ScalarFromWord(type);
      if (!known) scanner.Refuse(fmt::format("\"{}\" is not a PLY type", type.substr(0, 40)));
      property.type = *known;
      property.name = TextScanner::TakeWord(&line);
      header.elements.back().properties.push_back(std::move(property));
    }
  }
  scanner.Refuse("the header has no end");
}

// The numbers of the body, one after the other, whatever their encoding.
class Body {
 public:
  Body(TextScanner& scanner, Encoding encoding, const fs::path& file)
      : scanner_(scanner), encoding_(encoding), bytes_(scanner.rest()), file_(file) {}

  double Take(Scalar type) {
    if (encoding_ == Encoding::kText) {
      while (line_.find_first_not_of(" \t\r") == line_.npos)
        if (!scanner_.NextLine(&line_)) RefuseEnd();
      return scanner_.TakeDouble(&line_);
    }
    const std::size_t size = static_cast<std::size_t>(SizeOf(type));
    if (bytes_.size() < size) RefuseEnd();
    unsigned char raw[8];
    std::memcpy(raw, bytes_.data(), size);
    bytes_.remove_prefix(size);
    if (encoding_ == Encoding::kBigEndian) std::reverse(raw, raw + size);
    switch (type) {
      case Scalar::kInt8:
        return As<std::int8_t>(raw);
      case Scalar::kUint8:
        return As<std::uint8_t>(raw);
      case Scalar::kInt16:
        return As<std::int16_t>(raw);
      case Scalar::kUint16:
        return As<std::uint16_t>(raw);
      case Scalar::kInt32:
        return As<std::int32_t>(raw);
      case Scalar::kUint32:
        return As<std::uint32_t>(raw);
      case Scalar::kFloat32:
        return As<float>(raw);
      case Scalar::kFloat64:
        return As<double>(raw);
    }
    return 0.0;
  }

  // How many numbers can still come at most: bounds what a damaged count can ask for.
  long long MostNumbers() const {
    const bool is_text = encoding_ == Encoding::kText;
    return static_cast<long long>(is_text ? line_.size() + scanner_.rest().size() : bytes_.size());
  }

  [[noreturn]] void RefuseEnd() const {
    throw Error(Code::kBadMesh, "this PLY file is cut off before its end; copy or export it again",
                file_);
  }

 private:
  template <class T>
  static double As(const unsigned char* raw) {
    T value;
    std::memcpy(&value, raw, sizeof value);
    return static_cast<double>(value);
  }

  TextScanner& scanner_;
  Encoding encoding_;
  std::string_view bytes_, line_;
  const fs::path& file_;
};

int AxisOf(const Property& property) {
  if (property.count_type || property.name.size() != 1) return -1;
  return property.name[0] >= 'x' && property.name[0] <= 'z' ? property.name[0] - 'x' : -1;
}

}  // namespace

PolygonSoup ParsePly(std::string_view bytes, const fs::path& file) {
  if (!bytes.starts_with("ply"))
    throw Error(Code::kBadMesh, "this is not a PLY file; export the surface again", file);
  TextScanner scanner(bytes, file);
  const Header header = ReadHeader(scanner);
  Body body(scanner, header.encoding, file);
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    if (!element.properties.empty() && element.count > body.MostNumbers()) body.RefuseEnd();
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    if (is_vertex) {
      int axes = 0;
      for (const Property& property : element.properties) axes += AxisOf(property) >= 0;
      if (axes != 3)
        throw Error(Code::kBadMesh, "the vertices have no x, y and z; export the surface again",
                    file);
    }
    for (long long i = 0; i < element.count && !element.properties.empty(); ++i) {
      glm::dvec3 p(0.0);
      for (const Property& property : element.properties) {
        if (!property.count_type) {
          const double value = body.Take(property.type);
          if (const int axis = AxisOf(property); is_vertex && axis >= 0) p[axis] = value;
          continue;
        }
        const double count = body.Take(*property.count_type);
        const bool is_polygon =
            is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (!(count >= (is_polygon ? 3 : 0) && count <= static_cast<double>(body.MostNumbers())))
          throw Error(Code::kBadMesh,
                      fmt::format("{} {} has {} corners or list entries; the file is damaged or "
                                  "cut off, export it again",
                                  element.name, i, count),
                      file);
        for (long long k = 0; k < static_cast<long long>(count); ++k) {
          const double value = body.Take(property.type);
          if (!is_polygon) continue;
          if (!(value >= 0 && value < 2147483647.0))
            throw Error(Code::kBadMesh, fmt::format("face {} names vertex {}", i, value), file);
          soup.corners.push_back(static_cast<int>(value));
        }
        if (is_polygon) soup.ClosePolygon();
      }
      if (is_vertex) soup.points.push_back(p);
    }
  }
  return soup;
}

}  // namespace arthro
