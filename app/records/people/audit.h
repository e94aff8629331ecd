// Acts of instructors and administrators that change what counts: a gate that is opened, a trainee
// who is erased.
#pragma once

#include <string>
#include <vector>

#include "app/records/store/records.h"
#include "simulation/core/options.h"

namespace arthro::app {

struct AuditRow {
  std::string id, made, who, action, subject;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("made", made, Required{Any{}}, "", "Time in UTC.");
    v("who", who, Any{}, "", "Who did it.");
    v("action", action, Any{}, "", "What was done.");
    v("subject", subject, Any{}, "",
      "Code of the trainee, or a hash after the trainee was erased.");
  }
};

// Inside a transaction.
void WriteAudit(Records& records, const std::string& who, const std::string& action,
                const std::string& subject);
std::vector<AuditRow> AuditOf(Records& records);

}  // namespace arthro::app
