// What a Project holds; shared by the files that implement it, not for other folders.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "storage/project/detail/database.h"
#include "storage/project/detail/writer_lock.h"
#include "storage/project/project.h"

namespace footwall::project {

struct Project::State {
  std::filesystem::path path;
  FileSystem file_system = FileSystem::kLocal;
  std::unique_ptr<detail::WriterLock> lock;  // null: read-only
  std::unique_ptr<detail::Database> database;
  bool lost = false;  // the lock was taken over
  bool editing = false;
  int version = 0;
  std::vector<std::string> notices;
  Regenerator regenerator;

  ~State();
  void close();
  // Throws kInvalid on a read-only project, kHeld once the lock is lost.
  void require_writer();
  // The same, then `change` in one transaction.
  template <class Change>
  auto write(const Change& change);
};

template <class Change>
auto Project::State::write(const Change& change) {
  require_writer();
  detail::Transaction transaction(*database);
  if constexpr (std::is_void_v<decltype(change())>) {
    change();
    transaction.commit();
  } else {
    auto result = change();
    transaction.commit();
    return result;
  }
}

}  // namespace footwall::project
