#include "storage/project/sqlite_features.h"

#include <fmt/format.h>

#include "storage/project/detail/sqlite.h"

namespace footwall::project {

SqliteFeatures sqlite_features() {
  SqliteFeatures features;
  features.running = sqlite3_libversion();
  // Newer libraries read what older ones write, but a program may use what came after an older library.
  if (sqlite3_libversion_number() < SQLITE_VERSION_NUMBER)
    features.missing.push_back(fmt::format("version {}, which this program was built with", SQLITE_VERSION));
  if (sqlite3_threadsafe() == 0) features.missing.emplace_back("safety with threads");
  if (sqlite3_compileoption_used("ENABLE_SESSION") == 0)
    features.missing.emplace_back("the session extension, on which undo is built");
  if (sqlite3_compileoption_used("ENABLE_PREUPDATE_HOOK") == 0)
    features.missing.emplace_back("the preupdate hook");
  if (sqlite3_compileoption_used("OMIT_WAL") != 0) features.missing.emplace_back("write-ahead logs");
  return features;
}

}  // namespace footwall::project
