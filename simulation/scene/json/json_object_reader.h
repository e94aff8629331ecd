// Reads one JSON object key by key and collects every fault instead of stopping at the first. A
// fault names its key from the root ("tissues[2].pose.scale"), what stands there and what may.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace arthro {

struct JsonFault {
  std::string key, sentence;  // the sentence begins with the key
};

// Closed range in the unit of the file; `above_min` leaves the lower end out. `unit` is said in the
// fault.
struct JsonLimits {
  double min, max;
  const char* unit = "";
  bool above_min = false;
};

class JsonObjectReader {
 public:
  enum Need { kOptional, kRequired };

  // `json` and `faults` must outlive the reader. An empty key is the root.
  JsonObjectReader(const nlohmann::json& json, std::string key, std::vector<JsonFault>& faults);

  // An optional key that is absent leaves the field as it is; so does a fault.
  void Number(const char* name, double& field, const JsonLimits& limits, Need need = kOptional);
  void Whole(const char* name, int& field, const JsonLimits& limits, Need need = kOptional);
  void Angle(const char* name_deg, double& radians, const JsonLimits& limits_deg);
  void Flag(const char* name, bool& field);
  void Text(const char* name, std::string& field, Need need = kOptional);
  // A file inside the scene's folder: relative, with no "..", no drive and no backslash.
  void Path(const char* name, std::filesystem::path& field, Need need = kOptional);
  void Point(const char* name, glm::dvec2& field, const JsonLimits& limits, Need need = kOptional);
  void Point(const char* name, glm::dvec3& field, const JsonLimits& limits, Need need = kOptional);
  // A list of so many points; required.
  void Points(const char* name, std::vector<glm::dvec3>& field, int least, int most,
              const JsonLimits& limits);
  void Quaternion(const char* name, glm::dquat& field);  // [w, x, y, z]; made unit
  // A list of finite numbers, however many. False where it is absent or at fault.
  bool List(const char* name, std::vector<double>& numbers);
  // A list of texts that are not empty, however many.
  void Texts(const char* name, std::vector<std::string>& texts);
  // True when the object is there; a required one that is missing is a fault.
  bool Object(const char* name, Need need, const std::function<void(JsonObjectReader&)>& read);
  void Array(const char* name, const std::function<void(JsonObjectReader&, int index)>& read);

  // Faults for the keys that nobody asked for, with the nearest known one. Keys that begin with
  // "x-" belong to others and are let pass when `extensions` says so.
  void RefuseOtherKeys(bool extensions = false);

  // A key that someone else reads.
  void Know(const std::string& name) { known_.insert(name); }

  // A fault of `name` in this object; the sentence follows the key.
  void Fault(const std::string& name, const std::string& sentence);
  bool Has(const char* name) const { return json_.contains(name); }
  bool IsText(const char* name) const { return Has(name) && json_.at(name).is_string(); }
  std::string KeyOf(const std::string& name) const;

 private:
  const nlohmann::json* Find(const char* name, Need need, const char* wanted);
  bool Numbers(const char* name, int count, double* fields, const JsonLimits& limits, Need need);

  const nlohmann::json& json_;
  std::string key_;
  std::vector<JsonFault>& faults_;
  std::set<std::string> known_;
};

}  // namespace arthro
