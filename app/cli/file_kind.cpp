#include "app/cli/file_kind.h"

#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kHead = 4096;               // bytes that tell all kinds but JSON
constexpr std::uintmax_t kLargestJson = 1 << 28;  // bytes; no report is that large

std::string HeadOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(kHead, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

bool IsTiff(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv);
}

bool IsPicture(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("\x89PNG\r\n\x1a\n"sv) || head.starts_with("\xff\xd8\xff"sv) ||
         IsTiff(head) || (head.starts_with("BM"sv) && head.substr(6, 4) == "\0\0\0\0"sv) ||
         (head.starts_with("RIFF"sv) && head.substr(8, 4) == "WEBP"sv);
}

// The first directory of a TIFF, as much of it as tells samples apart [TIFF 6.0, section 2].
class TiffDirectory {
 public:
  explicit TiffDirectory(const fs::path& file) : stream_(file, std::ios::binary) {
    char order = 0;
    is_big_ = stream_.get(order) && order == 'M';
    at_ = Number(4, 4);
    if (at_) count_ = Number(*at_, 2);
  }
  // The value of a tag that holds one 16-bit number; none where it is absent.
  std::optional<std::uint32_t> Short(std::uint32_t tag) {
    for (std::uint32_t i = 0; count_ && i < *count_; ++i) {
      const std::uint32_t entry = *at_ + 2 + 12 * i;
      const auto found = Number(entry, 2);
      if (!found) return std::nullopt;
      if (*found == tag) return Number(entry + 8, 2);
    }
    return std::nullopt;
  }

 private:
  std::optional<std::uint32_t> Number(std::uint32_t at, int size) {
    unsigned char bytes[4] = {};
    stream_.clear();
    stream_.seekg(at);
    if (!stream_.read(reinterpret_cast<char*>(bytes), size)) return std::nullopt;
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i) value = value << 8 | bytes[is_big_ ? i : size - 1 - i];
    return value;
  }
  std::ifstream stream_;
  bool is_big_ = false;
  std::optional<std::uint32_t> at_, count_;
};

bool IsDepthMap(const fs::path& file) {
  constexpr std::uint32_t kBitsPerSample = 258, kSampleFormat = 339, kFloat = 3;
  TiffDirectory directory(file);
  return directory.Short(kBitsPerSample) == 32u && directory.Short(kSampleFormat) == kFloat;
}

// The text of "schema" in the outermost object. The parser calls it event by event, so that no
// depth of nesting and no length costs memory.
struct SchemaFinder : nlohmann::json_sax<Json> {
  std::string schema;
  int depth = 0;
  bool is_next = false;

  bool Value() {
    is_next = false;
    return true;
  }
  bool null() override { return Value(); }
  bool boolean(bool) override { return Value(); }
  bool number_integer(number_integer_t) override { return Value(); }
  bool number_unsigned(number_unsigned_t) override { return Value(); }
  bool number_float(number_float_t, const string_t&) override { return Value(); }
  bool binary(binary_t&) override { return Value(); }
  bool string(string_t& text) override {
    if (is_next) schema = text;
    return !is_next;  // found: no more is read
  }
  bool start_object(std::size_t) override {
    ++depth;
    return Value();
  }
  bool start_array(std::size_t) override {
    ++depth;
    return Value();
  }
  bool end_object() override {
    --depth;
    return true;
  }
  bool end_array() override {
    --depth;
    return true;
  }
  bool key(string_t& text) override {
    is_next = depth == 1 && text == "schema";
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }
};

std::string SchemaOf(const fs::path& file) {
  std::error_code fault;
  if (fs::file_size(file, fault) > kLargestJson || fault) return "";
  std::ifstream stream(file, std::ios::binary);
  SchemaFinder finder;
  Json::sax_parse(stream, &finder);
  return finder.schema;
}

}  // namespace

bool IsOfKind(const fs::path& file, const FileKind& kind) {
  if (kind.form == FileForm::kUnique) return false;
  std::error_code fault;
  if (fs::file_size(file, fault) == 0 && !fault) return true;
  const std::string head = HeadOf(file);
  switch (kind.form) {
    case FileForm::kPicture:
      return IsPicture(head);
    case FileForm::kDepthMap:
      return IsTiff(head) && IsDepthMap(file);
    case FileForm::kTable:
      return head.starts_with(kind.mark);
    case FileForm::kJson:
      return SchemaOf(file).starts_with(kind.mark);
    case FileForm::kVolume:
      return head.find("<VTKFile") != std::string::npos &&
             head.find("UnstructuredGrid") != std::string::npos;
    case FileForm::kPlot:
      return head.find("<svg") != std::string::npos;
    case FileForm::kUnique:
      break;
  }
  return false;
}

}  // namespace arthro::app
