// Pictures that name a patient in every place where a file has room for it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace arthro::test {

inline constexpr const char* kPatient = "Jane Doe";

inline std::string BigEndian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

// A TIFF directory with two entries: how the picture is turned, and the patient as its artist.
inline std::string Exif(int orientation) {
  using namespace std::string_literals;
  const std::string name = std::string(kPatient) + "\0"s;
  return "MM\0*\0\0\0\x08"s + "\0\x02"s + "\x01\x12\0\x03\0\0\0\x01"s +
         BigEndian(static_cast<std::uint32_t>(orientation), 2) + "\0\0"s + "\x01\x3b\0\x02"s +
         BigEndian(static_cast<std::uint32_t>(name.size()), 4) + "\0\0\0\x26"s + "\0\0\0\0"s + name;
}

inline std::string JpegSegment(char marker, const std::string& data) {
  return std::string("\xff") + marker + BigEndian(static_cast<std::uint32_t>(data.size() + 2), 2) +
         data;
}

// `jpeg` with EXIF, XMP, an ICC profile, IPTC, a comment and bytes after its end.
inline std::string MarkedJpeg(const std::string& jpeg, int orientation = 1) {
  using namespace std::string_literals;
  const std::string patient = kPatient;
  const std::string marks = JpegSegment('\xe1', "Exif\0\0"s + Exif(orientation)) +
                            JpegSegment('\xe1', "http://ns.adobe.com/xap/1.0/\0<x>"s + patient) +
                            JpegSegment('\xe2', "ICC_PROFILE\0\x01\x01"s + patient) +
                            JpegSegment('\xed', "Photoshop 3.0\0"s + patient) +
                            JpegSegment('\xfe', "Patient: "s + patient);
  return jpeg.substr(0, 2) + marks + jpeg.substr(2) + "after the end: " + patient;
}

inline std::string PngChunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  std::uint32_t crc = 0xffffffffu;
  for (const char letter : checked) {
    crc ^= static_cast<std::uint8_t>(letter);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return BigEndian(static_cast<std::uint32_t>(data.size()), 4) + checked + BigEndian(~crc, 4);
}

// `png` with text, EXIF, a time and bytes after its end.
inline std::string MarkedPng(const std::string& png, int orientation = 1) {
  using namespace std::string_literals;
  constexpr std::size_t kHeader = 8 + 25;  // signature and IHDR
  const std::string patient = kPatient;
  return png.substr(0, kHeader) + PngChunk("tEXt", "Author\0"s + patient) +
         PngChunk("iTXt", "Title\0\0\0\0\0"s + patient) +
         PngChunk("tIME", "\x07\xe7\x01\x02\x03\x04\x05"s) + PngChunk("eXIf", Exif(orientation)) +
         PngChunk("paTi", patient) + png.substr(kHeader) + "after the end: " + patient;
}

}  // namespace arthro::test
