// What a Project holds; shared by the files that implement it, not for other folders.
#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "storage/project/detail/database.h"
#include "storage/project/detail/writer_lock.h"
#include "storage/project/project.h"

namespace footwall::project {

struct Project::State {
  std::filesystem::path path;
  FileSystem file_system = FileSystem::kLocal;
  detail::Access access = detail::Access::kRead;
  std::shared_ptr<detail::WriterLock> lock;  // null: read-only; shared by the connections beside one another
  // Held while a transaction writes; shared like the lock. SQLite alone would give up after 5 s.
  std::shared_ptr<std::mutex> turn = std::make_shared<std::mutex>();
  std::unique_ptr<detail::Database> database;
  bool lost = false;  // the lock was taken over
  bool editing = false;
  int version = 0;
  std::vector<Migration> migrations;
  std::vector<std::string> notices;
  Regenerator regenerator;

  ~State();
  void close();
  // Throws kInvalid on a read-only project, kHeld once the lock is lost.
  void require_writer();
  // Throws kHeld, and the project is read-only from then on, if the lock is lost.
  void require_lock();
  // require_writer(), then `change` in one transaction. The lock is looked at again inside: a process that
  // was stopped for a minute may have lost it on the way, and nobody else can write before the transaction
  // ends.
  template <class Change>
  auto write(const Change& change);
};

template <class Change>
auto Project::State::write(const Change& change) {
  require_writer();
  const std::scoped_lock writing(*turn);
  detail::Transaction transaction(*database);
  require_lock();
  if constexpr (std::is_void_v<decltype(change())>) {
    change();
    require_lock();
    transaction.commit();
  } else {
    auto result = change();
    require_lock();
    transaction.commit();
    return result;
  }
}

}  // namespace footwall::project
