// Named with _io since VTK's decompressors are used here.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include "simulation/core/error.h"
#include "simulation/scene/formats/meshes/vtk_xml_file.h"
#include "simulation/scene/formats/meshes/xml_tags.h"

namespace arthro {
namespace {

static_assert(std::endian::native == std::endian::little);

// More than any tissue has; a file that says more is damaged, or not a tissue.
constexpr std::size_t kMostItems = 10'000'000;                 // points, and cells
constexpr std::size_t kMostCorners = 4 * kMostItems;           // corners of all cells of a piece
constexpr std::size_t kMostComponents = 1024;                  // values a tuple
constexpr std::size_t kMostUnpacked = std::size_t{512} << 20;  // bytes, all arrays of a file
constexpr std::size_t kMostPieces = 10'000, kMostArrays = 100'000;
constexpr std::size_t kDeepest = 16;  // VTK's own files are 6 deep

// Binary data of one array: bytes as they are, or as base64 text.
class Binary {
 public:
  Binary(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  // No fewer than there are.
  std::size_t left() const {
    return (is_base64_ ? text_.size() / 4 * 3 : text_.size()) + held_.size();
  }

  bool Read(std::size_t size, char* to) {
    if (size > left()) return false;
    if (!is_base64_) {
      std::memcpy(to, text_.data(), size);
      text_.remove_prefix(size);
      return true;
    }
    while (size > 0) {
      if (held_.empty() && !DecodeGroup()) return false;
      const std::size_t taken = std::min(size, held_.size());
      to = std::copy_n(held_.begin(), taken, to);
      held_.erase(0, taken);
      size -= taken;
    }
    return true;
  }

 private:
  // Four letters are up to three bytes. Head and data may each be padded with "=".
  bool DecodeGroup() {
    std::uint32_t bits = 0;
    int letters = 0, padding = 0;
    while (letters < 4 && !text_.empty()) {
      const char c = text_.front();
      text_.remove_prefix(1);
      if (kXmlBlanks.find(c) != kXmlBlanks.npos) continue;
      const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                                               : -1;
      if (c == '=' && letters >= 2)
        ++padding;
      else if (value < 0 || padding > 0)
        return false;
      bits = bits << 6 | static_cast<std::uint32_t>(std::max(value, 0));
      ++letters;
    }
    if (letters < 4) return false;
    for (int i = 0; i < 3 - padding; ++i) held_ += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    return true;
  }

  std::string_view text_;
  bool is_base64_;
  std::string held_;  // decoded, not yet read
};

template <class T>
T Swapped(T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

vtkSmartPointer<vtkDataCompressor> CompressorOf(std::string_view name) {
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  return nullptr;
}

bool IsArrayGroup(std::string_view name) {
  return name == "Points" || name == "Cells" || name == "PointData" || name == "Polys" ||
         name == "Strips";
}

}  // namespace

std::size_t VtkXmlPiece::Count(std::string_view name) const {
  const auto entry = counts.find(name);
  return entry == counts.end() ? 0 : entry->second;
}

const VtkXmlArray* VtkXmlPiece::Find(std::string_view group, std::string_view name) const {
  const auto entry = arrays.find(group);
  if (entry == arrays.end()) return nullptr;
  for (const VtkXmlArray& array : entry->second)
    if (name.empty() || array.name == name) return &array;
  return nullptr;
}

VtkXmlFile::VtkXmlFile(std::string_view bytes, std::string_view kind, std::filesystem::path file)
    : bytes_(bytes), file_(std::move(file)), kind_(kind == "PolyData" ? "VTP" : "VTU") {
  ReadTags(kind);
}

void VtkXmlFile::RefuseDamaged() const {
  throw Error(Code::kBadMesh,
              fmt::format("this is not a whole {} file: it is damaged, cut off or something else; "
                          "copy or export it again",
                          kind_),
              file_);
}

std::size_t VtkXmlFile::CountFrom(const std::string& text, std::string_view name,
                                  std::size_t most) const {
  std::size_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault == std::errc() && end == text.data() + text.size() && value <= most) return value;
  throw Error(Code::kBadMesh,
              fmt::format("{} is \"{}\", and must be a whole number from 0 to {}; this {} file is "
                          "damaged, export it again",
                          name, text, most, kind_),
              file_);
}

VtkXmlArray VtkXmlFile::ArrayFrom(const XmlTag& tag) const {
  VtkXmlArray array;
  if (const std::string* name = tag.Find("Name")) array.name = *name;
  if (const std::string* type = tag.Find("type")) array.type = *type;
  if (const std::string* count = tag.Find("NumberOfComponents"))
    array.components = CountFrom(*count, "NumberOfComponents", kMostComponents);
  const std::string* format = tag.Find("format");
  if (!format || *format == "ascii") return array;
  if (*format == "binary") {
    array.format = VtkXmlArray::Format::kBinary;
    return array;
  }
  const std::string* offset = tag.Find("offset");
  if (*format != "appended" || !offset) RefuseDamaged();
  array.format = VtkXmlArray::Format::kAppended;
  array.offset = CountFrom(*offset, "offset", bytes_.size());
  return array;
}

void VtkXmlFile::ReadTags(std::string_view kind) {
  const auto require = [&](bool is_right) {
    if (!is_right) RefuseDamaged();
  };
  XmlTags tags(bytes_.starts_with("\xef\xbb\xbf") ? bytes_.substr(3) : bytes_);
  std::vector<std::string_view> open;  // names from the root to here
  VtkXmlArray* array = nullptr;        // the one whose text comes next
  std::size_t arrays = 0;
  bool has_root = false;
  XmlTag tag;
  while (tags.Next(tag)) {
    const auto is_blank = [](std::string_view text) {
      return text.find_first_not_of(kXmlBlanks) == text.npos;
    };
    if (array && !is_blank(tag.text_before)) array->text = tag.text_before;
    array = nullptr;
    if (tag.is_end) {
      require(!open.empty() && open.back() == tag.name);
      open.pop_back();
      continue;
    }
    if (open.size() == kDeepest)
      throw Error(Code::kBadMesh,
                  fmt::format("this XML is nested more than {} deep, which no {} file is; export "
                              "it again",
                              kDeepest, kind_),
                  file_);
    const bool is_in_piece = open.size() >= 3 && open[1] == kind && open[2] == "Piece";
    if (open.empty()) {
      require(!has_root && tag.name == "VTKFile" && tag.Find("type") && *tag.Find("type") == kind);
      has_root = true;
      if (const std::string* order = tag.Find("byte_order")) {
        is_big_endian_ = *order == "BigEndian";
        require(is_big_endian_ || *order == "LittleEndian");
      }
      if (const std::string* type = tag.Find("header_type")) {
        header_size_ = *type == "UInt64" ? 8 : 4;
        require(header_size_ == 8 || *type == "UInt32");
      }
      if (const std::string* compressor = tag.Find("compressor")) compressor_ = *compressor;
      require(compressor_.empty() || CompressorOf(compressor_));
    } else if (open.size() == 2 && open[1] == kind && tag.name == "Piece") {
      require(pieces_.size() < kMostPieces);
      VtkXmlPiece& piece = pieces_.emplace_back();
      for (const auto& [key, value] : tag.attributes)
        if (key.starts_with("NumberOf"))
          piece.counts[std::string(key)] = CountFrom(value, key, kMostItems);
    } else if (is_in_piece && open.size() == 4 && IsArrayGroup(open[3]) &&
               tag.name == "DataArray") {
      require(++arrays <= kMostArrays);
      array = &pieces_.back().arrays[std::string(open[3])].emplace_back(ArrayFrom(tag));
    } else if (open.size() == 1 && tag.name == "AppendedData" && !tag.is_empty) {
      is_appended_base64_ = tag.Find("encoding") && *tag.Find("encoding") == "base64";
      const std::string_view all = bytes_.substr(0, bytes_.rfind("</AppendedData"));
      const std::size_t mark = all.find_first_not_of(kXmlBlanks, tags.position());
      require(all.size() < bytes_.size() && mark != all.npos && all[mark] == '_');
      appended_ = all.substr(mark + 1);
      tags.SkipTo(all.size());
    }
    if (!tag.is_empty)
      open.push_back(tag.name);
    else
      array = nullptr;
  }
  require(!tags.is_broken() && has_root && open.empty());
}

// Bytes of the array's values, as the file stores them; size by size and block by block.
void VtkXmlFile::ReadBinary(const VtkXmlArray& array, std::size_t size, char* to) {
  if (size == 0) return;
  const bool is_appended = array.format == VtkXmlArray::Format::kAppended;
  if (is_appended && array.offset > appended_.size()) RefuseDamaged();
  Binary binary(is_appended ? appended_.substr(array.offset) : array.text,
                !is_appended || is_appended_base64_);
  const auto take_count = [&] {
    std::array<char, 8> raw{};
    if (!binary.Read(header_size_, raw.data())) RefuseDamaged();
    if (is_big_endian_) std::reverse(raw.begin(), raw.begin() + header_size_);
    return std::bit_cast<std::uint64_t>(raw);
  };
  if (compressor_.empty()) {
    if (take_count() < size || !binary.Read(size, to)) RefuseDamaged();
    return;
  }
  const std::uint64_t blocks = take_count(), block = take_count(), last = take_count();
  if (blocks == 0 || blocks > binary.left() / header_size_ || block > kMostUnpacked || last > block)
    RefuseDamaged();
  const std::uint64_t last_size = last > 0 ? last : block;
  // The first keeps the product of the second from overflowing.
  if (block > 0 && blocks - 1 > size / block) RefuseDamaged();
  if ((blocks - 1) * block + last_size != size) RefuseDamaged();
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& bytes : packed) bytes = take_count();
  const auto compressor = CompressorOf(compressor_);
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const std::uint64_t unpacked = i + 1 < blocks ? block : last_size;
    if (packed[i] > binary.left()) RefuseDamaged();
    const auto bytes = std::make_unique_for_overwrite<char[]>(packed[i]);
    if (!binary.Read(packed[i], bytes.get())) RefuseDamaged();
    const std::size_t got =
        compressor->Uncompress(reinterpret_cast<const unsigned char*>(bytes.get()), packed[i],
                               reinterpret_cast<unsigned char*>(to), unpacked);
    if (got != unpacked) RefuseDamaged();
    to += unpacked;
  }
}

template <class Stored, class Value>
std::vector<Value> VtkXmlFile::AsciiValues(const VtkXmlArray& array, std::size_t count) {
  // Integers of 8 bits are written as numbers too.
  using Parsed = std::conditional_t<
      std::is_floating_point_v<Stored>, Stored,
      std::conditional_t<std::is_unsigned_v<Stored>, std::uint64_t, std::int64_t>>;
  std::vector<Value> values;
  if (count > array.text.size() / 2 + 1) RefuseDamaged();  // a digit and a blank each
  values.reserve(count);
  const char *at = array.text.data(), *const end = at + array.text.size();
  while (values.size() < count) {
    while (at < end && kXmlBlanks.find(*at) != kXmlBlanks.npos) ++at;
    if (at < end && *at == '+') ++at;
    Parsed value{};
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc() || (next < end && kXmlBlanks.find(*next) == kXmlBlanks.npos))
      RefuseDamaged();
    if constexpr (!std::is_floating_point_v<Stored>)
      if (!std::in_range<Stored>(value)) RefuseDamaged();
    values.push_back(static_cast<Value>(static_cast<Stored>(value)));
    at = next;
  }
  return values;
}

template <class Stored, class Value>
std::vector<Value> VtkXmlFile::ValuesStoredAs(const VtkXmlArray& array, std::size_t count) {
  if (count > kMostUnpacked / sizeof(Stored) ||
      (unpacked_ += count * sizeof(Stored)) > kMostUnpacked)
    throw Error(Code::kBadMesh,
                fmt::format("this file holds more than {} MB of numbers, which no tissue needs; "
                            "export a coarser one",
                            kMostUnpacked >> 20),
                file_);
  if (array.format == VtkXmlArray::Format::kAscii) return AsciiValues<Stored, Value>(array, count);
  const auto raw = std::make_unique_for_overwrite<Stored[]>(count);
  ReadBinary(array, count * sizeof(Stored), reinterpret_cast<char*>(raw.get()));
  std::vector<Value> values(count);
  for (std::size_t i = 0; i < count; ++i)
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): numbers of eight bits, no characters
    values[i] = static_cast<Value>(is_big_endian_ ? Swapped(raw[i]) : raw[i]);
  return values;
}

template <class Value>
std::vector<Value> VtkXmlFile::Values(const VtkXmlArray& array, std::size_t count) {
  const std::string& type = array.type;
  if (type == "Int8") return ValuesStoredAs<std::int8_t, Value>(array, count);
  if (type == "UInt8") return ValuesStoredAs<std::uint8_t, Value>(array, count);
  if (type == "Int16") return ValuesStoredAs<std::int16_t, Value>(array, count);
  if (type == "UInt16") return ValuesStoredAs<std::uint16_t, Value>(array, count);
  if (type == "Int32") return ValuesStoredAs<std::int32_t, Value>(array, count);
  if (type == "UInt32") return ValuesStoredAs<std::uint32_t, Value>(array, count);
  if (type == "Int64") return ValuesStoredAs<std::int64_t, Value>(array, count);
  if (type == "UInt64") return ValuesStoredAs<std::uint64_t, Value>(array, count);
  if constexpr (std::is_same_v<Value, double>) {
    if (type == "Float32") return ValuesStoredAs<float, Value>(array, count);
    if (type == "Float64") return ValuesStoredAs<double, Value>(array, count);
  }
  throw Error(
      Code::kBadMesh,
      fmt::format("its array \"{}\" is of type \"{}\", which is not read here; export it "
                  "with whole numbers of 8 to 64 bits{}",
                  array.name, type, std::is_same_v<Value, double> ? ", Float32 or Float64" : ""),
      file_);
}

std::vector<double> VtkXmlFile::Numbers(const VtkXmlArray& array, std::size_t count) {
  return Values<double>(array, count);
}

std::vector<std::int64_t> VtkXmlFile::Integers(const VtkXmlArray& array, std::size_t count) {
  if (count > kMostCorners) RefuseDamaged();
  return Values<std::int64_t>(array, count);
}

}  // namespace arthro
