#include "app/records/people/audit.h"

#include "app/records/store/table.h"

namespace arthro::app {

void WriteAudit(Records& records, const std::string& who, const std::string& action,
                const std::string& subject) {
  Insert(records.database(), "audit",
         std::vector{AuditRow{records.NewId(), records.Now(), who, action, subject}});
}

std::vector<AuditRow> AuditOf(Records& records) {
  return Select<AuditRow>(records.database(), "audit", "ORDER BY made, id");
}

}  // namespace arthro::app
