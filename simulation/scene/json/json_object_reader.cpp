#include "simulation/scene/json/json_object_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "simulation/core/units.h"

namespace arthro {
namespace {

// A value as it stands in the file, cut so that a fault stays one readable line.
std::string Shown(const nlohmann::json& json) {
  constexpr std::size_t kMost = 60;
  std::string text = json.dump(-1, ' ', true);  // ASCII, so that a cut never splits a letter
  return text.size() > kMost ? text.substr(0, kMost) + "…" : text;
}

std::string Wanted(const JsonLimits& limits) {
  const std::string unit = *limits.unit ? fmt::format(" {}", limits.unit) : "";
  if (limits.max == std::numeric_limits<double>::max()) return "a finite number" + unit;
  if (limits.above_min)
    return fmt::format("more than {} and at most {}{}", limits.min, limits.max, unit);
  return fmt::format("between {} and {}{}", limits.min, limits.max, unit);
}

bool IsWithin(double value, const JsonLimits& limits) {
  return std::isfinite(value) && value <= limits.max &&
         (limits.above_min ? value > limits.min : value >= limits.min);
}

// Levenshtein's distance: letters changed, added or left out.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row[b.size()];
}

// "" where nothing is near: a third of the letters may differ.
std::string NearestOf(const std::set<std::string>& known, const std::string& name) {
  constexpr std::size_t kLongestName = 64;
  if (name.size() > kLongestName) return "";
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const bool is_part =
        name.size() > 3 && (candidate.starts_with(name + "_") || name.starts_with(candidate + "_"));
    const std::size_t distance = is_part ? 1 : EditDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace

JsonObjectReader::JsonObjectReader(const nlohmann::json& json, std::string key,
                                   std::vector<JsonFault>& faults)
    : json_(json), key_(std::move(key)), faults_(faults) {}

std::string JsonObjectReader::KeyOf(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

void JsonObjectReader::Fault(const std::string& name, const std::string& sentence) {
  const std::string key = KeyOf(name);
  faults_.push_back({key, key + " " + sentence});
}

const nlohmann::json* JsonObjectReader::Find(const char* name, Need need, const char* wanted) {
  known_.insert(name);
  const auto entry = json_.find(name);
  if (entry != json_.end()) return &*entry;
  if (need == kRequired) Fault(name, fmt::format("is missing; give {}", wanted));
  return nullptr;
}

void JsonObjectReader::Number(const char* name, double& field, const JsonLimits& limits,
                              Need need) {
  const nlohmann::json* entry = Find(name, need, "a number");
  if (!entry) return;
  if (!entry->is_number() || !IsWithin(entry->get<double>(), limits))
    return Fault(name, fmt::format("is {}; it must be {}", Shown(*entry), Wanted(limits)));
  field = entry->get<double>();
}

void JsonObjectReader::Whole(const char* name, int& field, const JsonLimits& limits, Need need) {
  double number = field;
  Number(name, number, limits, need);
  if (number != std::floor(number))
    return Fault(
        name, fmt::format("must be a whole number{}{}", *limits.unit ? " of " : "", limits.unit));
  field = static_cast<int>(number);
}

void JsonObjectReader::Angle(const char* name_deg, double& radians, const JsonLimits& limits_deg) {
  double degrees = std::numeric_limits<double>::quiet_NaN();
  Number(name_deg, degrees, limits_deg);
  if (!std::isnan(degrees)) radians = RadiansFromDegrees(degrees);
}

void JsonObjectReader::Flag(const char* name, bool& field) {
  const nlohmann::json* entry = Find(name, kOptional, "");
  if (!entry) return;
  if (!entry->is_boolean())
    return Fault(name, fmt::format("is {}; it must be true or false", Shown(*entry)));
  field = entry->get<bool>();
}

void JsonObjectReader::Text(const char* name, std::string& field, Need need) {
  const nlohmann::json* entry = Find(name, need, "a text");
  if (!entry) return;
  if (!entry->is_string()) return Fault(name, fmt::format("is {}; it must be text", Shown(*entry)));
  if (need == kRequired && entry->get_ref<const std::string&>().empty())
    return Fault(name, "is empty; give a text");
  field = entry->get<std::string>();
}

void JsonObjectReader::Path(const char* name, std::filesystem::path& field, Need need) {
  const nlohmann::json* entry = Find(name, need, "the name of a file in the scene's folder");
  if (!entry) return;
  if (!entry->is_string())
    return Fault(name, fmt::format("is {}; it must be the name of a file", Shown(*entry)));
  const auto& text = entry->get_ref<const std::string&>();
  if (text.empty()) {
    if (need == kRequired) Fault(name, "is empty; give the name of a file in the scene's folder");
    return;
  }
  const std::filesystem::path path(text);
  const bool has_drive = text.size() > 1 && text[1] == ':';
  const bool climbs =
      std::any_of(path.begin(), path.end(), [](const auto& p) { return p == ".."; });
  const bool has_odd_letter = std::any_of(text.begin(), text.end(), [](unsigned char letter) {
    return letter < 0x20 || letter == 0x7f || letter == '\\';
  });
  if (path.is_absolute() || has_drive || climbs || has_odd_letter || !path.has_filename() ||
      path.filename() == ".")
    return Fault(name, fmt::format("is {}; it must name a file inside the scene's folder, with "
                                   "\"/\" between folders and no \"..\"; copy the file there",
                                   Shown(*entry)));
  field = path;
}

bool JsonObjectReader::Numbers(const char* name, int count, double* fields,
                               const JsonLimits& limits, Need need) {
  const nlohmann::json* entry = Find(name, need, count == 2 ? "[x, y]" : "[x, y, z]");
  if (!entry) return false;
  bool good = entry->is_array() && static_cast<int>(entry->size()) == count;
  for (int i = 0; good && i < count; ++i)
    good = (*entry)[i].is_number() && IsWithin((*entry)[i].get<double>(), limits);
  if (!good) {
    Fault(name, fmt::format("is {}; it must be {} numbers, each {}", Shown(*entry), count,
                            Wanted(limits)));
    return false;
  }
  for (int i = 0; i < count; ++i) fields[i] = (*entry)[i].get<double>();
  return true;
}

void JsonObjectReader::Point(const char* name, glm::dvec2& field, const JsonLimits& limits,
                             Need need) {
  Numbers(name, 2, &field.x, limits, need);
}

void JsonObjectReader::Point(const char* name, glm::dvec3& field, const JsonLimits& limits,
                             Need need) {
  Numbers(name, 3, &field.x, limits, need);
}

void JsonObjectReader::Points(const char* name, std::vector<glm::dvec3>& field, int least, int most,
                              const JsonLimits& limits) {
  const nlohmann::json* entry = Find(name, kRequired, "a list [[x, y, z], …]");
  if (!entry) return;
  const auto is_point = [&](const nlohmann::json& point) {
    return point.is_array() && point.size() == 3 &&
           std::all_of(point.begin(), point.end(), [&](const nlohmann::json& value) {
             return value.is_number() && IsWithin(value.get<double>(), limits);
           });
  };
  const auto size = static_cast<int>(entry->is_array() ? entry->size() : 0);
  if (!entry->is_array() || size < least || size > most ||
      !std::all_of(entry->begin(), entry->end(), is_point))
    return Fault(name, fmt::format("is {}; it must be {} to {} points [x, y, z], each number {}",
                                   Shown(*entry), least, most, Wanted(limits)));
  field.clear();
  for (const nlohmann::json& point : *entry)
    field.emplace_back(point[0].get<double>(), point[1].get<double>(), point[2].get<double>());
}

void JsonObjectReader::Quaternion(const char* name, glm::dquat& field) {
  constexpr double kShortest = 1e-6;   // below this a direction is noise
  constexpr double kRounding = 1e-12;  // a unit quaternion stays bit for bit what was saved
  std::array<double, 4> wxyz{};
  if (!Numbers(name, 4, wxyz.data(), {-1e3, 1e3}, kOptional)) return;
  const glm::dquat q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const double length = glm::length(q);
  if (!(length > kShortest))
    return Fault(name, fmt::format("is {}; a rotation [w, x, y, z] cannot be all zeros; no "
                                   "rotation is [1, 0, 0, 0]",
                                   Shown(json_.at(name))));
  field = std::abs(length - 1.0) < kRounding ? q : q / length;
}

bool JsonObjectReader::List(const char* name, std::vector<double>& numbers) {
  const nlohmann::json* entry = Find(name, kOptional, "");
  if (!entry) return false;
  if (!entry->is_array() || !std::all_of(entry->begin(), entry->end(), [](const auto& value) {
        return value.is_number() && std::isfinite(value.template get<double>());
      })) {
    Fault(name, fmt::format("is {}; it must be a list of numbers", Shown(*entry)));
    return false;
  }
  numbers = entry->get<std::vector<double>>();
  return true;
}

void JsonObjectReader::Texts(const char* name, std::vector<std::string>& texts) {
  const nlohmann::json* entry = Find(name, kOptional, "");
  if (!entry) return;
  if (!entry->is_array() || !std::all_of(entry->begin(), entry->end(), [](const auto& value) {
        return value.is_string() && !value.template get_ref<const std::string&>().empty();
      }))
    return Fault(name, fmt::format("is {}; it must be a list of texts", Shown(*entry)));
  texts = entry->get<std::vector<std::string>>();
}

bool JsonObjectReader::Object(const char* name, Need need,
                              const std::function<void(JsonObjectReader&)>& read) {
  const nlohmann::json* entry = Find(name, need, "an object {…}");
  if (!entry) return false;
  if (!entry->is_object()) {
    Fault(name, fmt::format("is {}; it must be an object {{…}}", Shown(*entry)));
    return false;
  }
  JsonObjectReader reader(*entry, KeyOf(name), faults_);
  read(reader);
  reader.RefuseOtherKeys();
  return true;
}

void JsonObjectReader::Array(const char* name,
                             const std::function<void(JsonObjectReader&, int)>& read) {
  const nlohmann::json* entry = Find(name, kOptional, "");
  if (!entry) return;
  if (!entry->is_array())
    return Fault(name, fmt::format("is {}; it must be a list […]", Shown(*entry)));
  for (int i = 0; i < static_cast<int>(entry->size()); ++i) {
    const std::string element = fmt::format("{}[{}]", name, i);
    if (!(*entry)[i].is_object()) {
      Fault(element, fmt::format("is {}; it must be an object {{…}}", Shown((*entry)[i])));
      continue;
    }
    JsonObjectReader reader((*entry)[i], KeyOf(element), faults_);
    read(reader, i);
    reader.RefuseOtherKeys();
  }
}

void JsonObjectReader::RefuseOtherKeys(bool extensions) {
  for (const auto& [name, value] : json_.items()) {
    if (known_.contains(name) || (extensions && name.starts_with("x-"))) continue;
    const std::string nearest = NearestOf(known_, name);
    const std::string quoted = Shown(name);
    Fault(quoted.substr(1, quoted.rfind('"') == 0 ? quoted.npos : quoted.rfind('"') - 1),
          nearest.empty() ? "is not known; remove it, or keep your own data at the top under a key "
                            "that begins with \"x-\""
                          : fmt::format("is not known; did you mean \"{}\"?", nearest));
  }
}

}  // namespace arthro
