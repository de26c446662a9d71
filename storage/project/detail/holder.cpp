#include <unistd.h>

#include <fmt/format.h>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/project/detail/clock.h"
#include "storage/project/detail/writer_lock.h"

namespace footwall::project::detail {
namespace {

std::string host_name() {
  char name[256] = {};
  if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

// The kernel as it was started and the name space that process numbers belong to; empty where it cannot be
// told.
std::string machine_name() {
  std::string boot;
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::error_code trouble;
  const auto processes = std::filesystem::read_symlink("/proc/self/ns/pid", trouble);
  if (!std::getline(file, boot) || trouble) return {};
  return boot + " " + processes.string();
}

// Field 22 of /proc/PID/stat; 0 when there is no such process. The second field, in brackets, may hold
// blanks.
std::int64_t start_of(std::int64_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  if (!std::getline(file, line)) return 0;
  const std::size_t bracket = line.rfind(')');
  if (bracket == std::string::npos) return 0;
  std::istringstream rest(line.substr(bracket + 1));
  std::string word;
  for (int field = 3; field <= 22; ++field) rest >> word;
  return std::strtoll(word.c_str(), nullptr, 10);
}

// What another program left in the file goes to a terminal: one short line of plain text.
std::string plain(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  std::string text = found->get<std::string>();
  if (text.size() > 200) text.resize(200);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  }
  return text;
}

std::int64_t whole(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

}  // namespace

Holder Holder::myself(const std::string& edit_socket) {
  static std::atomic<int> count{0};
  Holder me;
  me.host = host_name();
  me.pid = ::getpid();
  me.process_start = start_of(me.pid);
  me.since = now_text();
  me.edit_socket = edit_socket;
  me.machine = machine_name();
  const std::string kind = me.machine + me.since;
  // With the machine in it: two hosts of one name may start processes of one number.
  me.token = fmt::format("{}-{}-{}-{}-{}", me.host, me.pid, me.process_start, ++count,
                         to_hex(hash64(std::as_bytes(std::span(kind)))));
  return me;
}

std::string Holder::to_json() const {
  return nlohmann::json{{"host", host},       {"pid", pid},     {"process_start", process_start},
                        {"since", since},     {"token", token}, {"edit_socket", edit_socket},
                        {"machine", machine}, {"lease", lease}}
             .dump() +
         "\n";
}

Holder Holder::from_json(const std::string& text) {
  Holder holder;
  const auto object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) return holder;
  holder.host = plain(object, "host");
  holder.pid = whole(object, "pid");
  holder.process_start = whole(object, "process_start");
  holder.since = plain(object, "since");
  holder.edit_socket = plain(object, "edit_socket");
  holder.token = plain(object, "token");
  holder.machine = plain(object, "machine");
  const auto lease = object.find("lease");
  holder.lease = lease != object.end() && lease->is_boolean() && lease->get<bool>();
  return holder;
}

std::string Holder::in_words() const {
  if (host.empty()) return "another program";
  return fmt::format("process {} on host '{}' since {}", pid, host, since);
}

bool Holder::dead() const {
  return pid > 0 && !machine.empty() && machine == machine_name() && start_of(pid) != process_start;
}

std::filesystem::path lock_path(const std::filesystem::path& project) {
  std::filesystem::path path = project;
  path += ".lock";
  return path;
}

Holder holder_of(const std::filesystem::path& lock_file) {
  try {
    return Holder::from_json(read_whole_file(lock_file, 4096));
  } catch (const Error&) {
    return {};  // gone in the meantime, or not a lock file: nobody we could name
  }
}

Error held(const std::filesystem::path& project, const Holder& holder) {
  return {ErrorCode::kHeld, fmt::format("{} is held by {}", project.string(), holder.in_words()),
          "close it there, or open it read-only here"};
}

}  // namespace footwall::project::detail
