// Tags of an XML text in their order, without a tree: neither memory nor stack grows with nesting.
// Only what VTK's files need: no document type, no CDATA, no entities of the file's own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arthro {

inline constexpr std::string_view kXmlBlanks = " \t\r\n";

struct XmlTag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string>> attributes;
  bool is_end = false;    // </name>
  bool is_empty = false;  // <name/>
  std::string_view text_before;

  // Null where there is no such attribute.
  const std::string* Find(std::string_view key) const;
};

class XmlTags {
 public:
  explicit XmlTags(std::string_view text) : text_(text) {}
  // False at the end and at a fault.
  bool Next(XmlTag& tag);
  bool is_broken() const { return is_broken_; }
  std::size_t position() const { return at_; }  // just behind the last tag
  void SkipTo(std::size_t position) { at_ = position; }

 private:
  bool ReadStart(XmlTag& tag);
  void SkipBlanks();

  std::string_view text_;
  std::size_t at_ = 0;
  bool is_broken_ = false;
};

}  // namespace arthro
