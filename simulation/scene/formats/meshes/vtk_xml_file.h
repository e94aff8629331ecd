// VTK's XML files (.vtu, .vtp) as named arrays. A reader of our own, since VTK's believes what a
// file says of its sizes: a negative or huge count, a false offset or block size, or deep nesting
// makes it crash, hang or take all memory. Here every size is held against the bytes that are
// there before memory is taken. [VTK File Formats, "XML File Formats", docs.vtk.org]
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace arthro {

struct VtkXmlArray {
  std::string name, type;  // type: "Float64", "UInt8" …
  std::size_t components = 1;
  enum class Format { kAscii, kBinary, kAppended } format = Format::kAscii;
  std::string_view text;   // inline
  std::size_t offset = 0;  // into the appended data
};

struct VtkXmlPiece {
  std::map<std::string, std::size_t, std::less<>> counts;               // "NumberOfPoints" …
  std::map<std::string, std::vector<VtkXmlArray>, std::less<>> arrays;  // "Points", "Cells" …

  std::size_t Count(std::string_view name) const;
  const VtkXmlArray* Find(std::string_view group, std::string_view name) const;
};

class VtkXmlFile {
 public:
  // `kind`: "UnstructuredGrid" or "PolyData"; `bytes` must outlive this. Throws Error(kBadMesh).
  VtkXmlFile(std::string_view bytes, std::string_view kind, std::filesystem::path file);

  const std::vector<VtkXmlPiece>& pieces() const { return pieces_; }
  [[noreturn]] void RefuseDamaged() const;

  // Exactly `count` values. Throws Error(kBadMesh) where the array has fewer, or other numbers.
  std::vector<double> Numbers(const VtkXmlArray& array, std::size_t count);
  std::vector<std::int64_t> Integers(const VtkXmlArray& array, std::size_t count);

 private:
  void ReadTags(std::string_view kind);
  std::size_t CountFrom(const std::string& text, std::string_view name, std::size_t most) const;
  VtkXmlArray ArrayFrom(const struct XmlTag& tag) const;
  template <class Value>
  std::vector<Value> Values(const VtkXmlArray& array, std::size_t count);
  template <class Stored, class Value>
  std::vector<Value> ValuesStoredAs(const VtkXmlArray& array, std::size_t count);
  template <class Stored, class Value>
  std::vector<Value> AsciiValues(const VtkXmlArray& array, std::size_t count);
  void ReadBinary(const VtkXmlArray& array, std::size_t size, char* to);

  std::string_view bytes_, appended_;
  std::filesystem::path file_;
  std::string kind_;  // "VTU" or "VTP", for sentences
  std::vector<VtkXmlPiece> pieces_;
  std::string compressor_;
  bool is_appended_base64_ = false, is_big_endian_ = false;
  std::size_t header_size_ = 4;
  std::size_t unpacked_ = 0;  // bytes of all arrays that were read
};

}  // namespace arthro
