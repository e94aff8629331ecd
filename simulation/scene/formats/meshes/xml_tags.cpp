#include "simulation/scene/formats/meshes/xml_tags.h"

#include <algorithm>
#include <optional>

namespace arthro {
namespace {

bool IsBlank(char letter) { return kXmlBlanks.find(letter) != kXmlBlanks.npos; }

bool IsOfName(char letter) {
  return !IsBlank(letter) && std::string_view("=<>/\"'&").find(letter) == std::string_view::npos;
}

// With the five entities that XML itself has; nothing for any other.
std::optional<std::string> Unescaped(std::string_view value) {
  static constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string text;
  while (!value.empty()) {
    if (value.front() != '&') {
      text += value.front();
      value.remove_prefix(1);
      continue;
    }
    const auto entity =
        std::find_if(std::begin(kEntities), std::end(kEntities),
                     [&](const auto& pair) { return value.starts_with(pair.first); });
    if (entity == std::end(kEntities)) return std::nullopt;
    text += entity->second;
    value.remove_prefix(entity->first.size());
  }
  return text;
}

}  // namespace

const std::string* XmlTag::Find(std::string_view key) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& pair) { return pair.first == key; });
  return found == attributes.end() ? nullptr : &found->second;
}

bool XmlTags::Next(XmlTag& tag) {
  tag = {};
  while (!is_broken_) {
    const std::size_t open = text_.find('<', at_);
    if (open == text_.npos) {
      is_broken_ = text_.find_first_not_of(kXmlBlanks, at_) != text_.npos;
      return false;
    }
    if (tag.text_before.find_first_not_of(kXmlBlanks) == tag.text_before.npos)
      tag.text_before = text_.substr(at_, open - at_);
    const std::string_view rest = text_.substr(open);
    const bool is_comment = rest.starts_with("<!--");
    if (is_comment || rest.starts_with("<?")) {
      const std::string_view close = is_comment ? "-->" : "?>";
      const std::size_t end = text_.find(close, open + (is_comment ? 4 : 2));
      is_broken_ = end == text_.npos;
      at_ = end + close.size();
      continue;
    }
    at_ = open + 1;
    is_broken_ = !ReadStart(tag);
    return !is_broken_;
  }
  return false;
}

// Behind the "<": a name, attributes and ">" or "/>".
bool XmlTags::ReadStart(XmlTag& tag) {
  const auto is_at = [&](char letter) { return at_ < text_.size() && text_[at_] == letter; };
  const auto name = [&] {
    const std::size_t begin = at_;
    while (at_ < text_.size() && IsOfName(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  };
  tag.is_end = is_at('/');
  if (tag.is_end) ++at_;
  tag.name = name();
  if (tag.name.empty() || tag.name.front() == '!') return false;
  for (;;) {
    SkipBlanks();
    if (is_at('>')) return ++at_, true;
    if (is_at('/')) {
      tag.is_empty = !tag.is_end;
      ++at_;
      return tag.is_empty && is_at('>') && (++at_, true);
    }
    constexpr std::size_t kMostAttributes = 64;
    const std::string_view key = name();
    SkipBlanks();
    if (key.empty() || tag.is_end || !is_at('=') || tag.attributes.size() == kMostAttributes ||
        tag.Find(key))
      return false;
    ++at_;
    SkipBlanks();
    if (!is_at('"') && !is_at('\'')) return false;
    const std::size_t begin = at_ + 1, end = text_.find(text_[at_], begin);
    if (end == text_.npos) return false;
    const std::string_view raw = text_.substr(begin, end - begin);
    const auto value = Unescaped(raw);
    if (!value || raw.find('<') != raw.npos) return false;
    tag.attributes.emplace_back(key, *value);
    at_ = end + 1;
  }
}

void XmlTags::SkipBlanks() {
  while (at_ < text_.size() && IsBlank(text_[at_])) ++at_;
}

}  // namespace arthro
