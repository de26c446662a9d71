#include "engine/service/client/connection_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "engine/service/words_on_the_wire.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::service {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLimit = std::size_t{1} << 18;
constexpr const char* kStart = "footwall serve starts one";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// A file that holds a secret: only this user may be able to read or write it.
std::string read_secret(const std::filesystem::path& path, const char* what) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    if (errno != ENOENT && errno != ENOTDIR) throw io_error("open", path.string(), errno);
    throw Error(ErrorCode::kNotFound, "there is no " + std::string(what) + " " + path.string(), kStart);
  }
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) throw io_error("look at", path.string(), errno);
  if (!S_ISREG(facts.st_mode)) {
    throw Error(ErrorCode::kInvalid, path.string() + " is no plain file", "name the " + std::string(what));
  }
  if (facts.st_uid != ::geteuid() || (facts.st_mode & 077U) != 0) {
    throw Error(ErrorCode::kInvalid, path.string() + " can be used by others, and holds a secret",
                "make it yours alone: chmod 600, and stop and start the engine if others may have read it");
  }
  std::string bytes(kLimit + 1, '\0');
  std::size_t length = 0;
  while (length < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + length, bytes.size() - length);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw io_error("read", path.string(), errno);
    if (got == 0) break;
    length += static_cast<std::size_t>(got);
  }
  if (length > kLimit)
    throw Error(ErrorCode::kFormat, path.string() + " is too long for a " + std::string(what),
                "name the " + std::string(what));
  bytes.resize(length);
  return bytes;
}

// "unix:/PATH" or "tcp:HOST:PORT".
bool is_address(const std::string& words) {
  if (words.starts_with("unix:/")) return true;
  if (!words.starts_with("tcp:")) return false;
  const std::size_t colon = words.rfind(':');
  const auto port = text::integer(std::string_view(words).substr(colon + 1));
  return colon > 4 && port && *port >= 1 && *port <= 65535;
}

Connection from_environment(const std::string& address) {
  if (!is_address(address)) {
    throw Error(ErrorCode::kUsage, "'" + address + "' is no address of an engine",
                "give unix:/PATH, tcp:HOST:PORT, or @FILE with the file that footwall serve wrote");
  }
  Connection connection;
  connection.address = address;
  connection.token = told_token();
  if (connection.token.empty()) {
    throw Error(ErrorCode::kUsage, "the token of the engine at " + address + " is not given",
                "set FOOTWALL_ENGINE_TOKEN_FILE or FOOTWALL_ENGINE_TOKEN, or give --engine @FILE");
  }
  if (address.starts_with("unix:")) return connection;
  const std::string certificate = variable("FOOTWALL_ENGINE_CERTIFICATE");
  if (certificate.empty()) {
    throw Error(ErrorCode::kUsage, "the certificate of the engine at " + address + " is not given",
                "name its file in FOOTWALL_ENGINE_CERTIFICATE, or give --engine @FILE");
  }
  connection.certificate = read_whole_file(certificate, kLimit);
  return connection;
}

// A folder of this user alone, made where there is none.
std::filesystem::path private_home(const std::filesystem::path& path) {
  if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) throw io_error("make the folder", path, errno);
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0) throw io_error("look at", path.string(), errno);
  if (!S_ISDIR(facts.st_mode) || facts.st_uid != ::geteuid() || (facts.st_mode & 077U) != 0) {
    throw Error(ErrorCode::kInvalid, path.string() + " is not this user's own folder",
                "remove it, or name a file with --connection");
  }
  return path;
}

}  // namespace

void write_connection(const Connection& connection, const std::filesystem::path& path) {
  const std::string bytes = Json{{"footwall_engine", 1},
                                 {"address", connection.address},
                                 {"token", connection.token},
                                 {"certificate", connection.certificate},
                                 {"fingerprint", connection.fingerprint},
                                 {"host", connection.host},
                                 {"process", connection.process},
                                 {"version", connection.version},
                                 {"project", connection.project}}
                                .dump(1, ' ', false, Json::error_handler_t::replace) +
                            "\n";
  PartialFile file(std::filesystem::absolute(path));
  Descriptor out(::open(file.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (out.get() < 0) throw io_error("write", path.string(), errno);
  std::string_view left = bytes;
  while (!left.empty()) {
    const ssize_t written = ::write(out.get(), left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw io_error("write", path.string(), errno);
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!out.close()) throw io_error("write", path.string(), errno);
  file.commit();
}

Connection read_connection(const std::filesystem::path& path) {
  const Json json = Json::parse(read_secret(path, "connection file"), nullptr, false);
  const Error wrong(ErrorCode::kFormat, path.string() + " is no connection file of an engine",
                    "name the file that footwall serve wrote");
  if (!json.is_object() || !json.contains("footwall_engine")) throw wrong;
  Connection connection;
  try {
    if (json.at("footwall_engine").get<int>() > 1) {
      throw Error(ErrorCode::kUnsupported, path.string() + " was written by a newer Footwall",
                  "use the Footwall that started the engine");
    }
    connection.address = json.at("address").get<std::string>();
    connection.token = json.at("token").get<std::string>();
    connection.certificate = json.value("certificate", "");
    connection.fingerprint = json.value("fingerprint", "");
    connection.host = json.value("host", "");
    connection.process = json.value("process", 0);
    connection.version = json.value("version", "");
    connection.project = json.value("project", "");
  } catch (const Json::exception&) {
    throw wrong;
  }
  if (!is_address(connection.address) || connection.token.empty()) throw wrong;
  if (connection.address.starts_with("tcp:") && connection.certificate.empty()) throw wrong;
  return connection;
}

Connection connection_from(const std::string& words) {
  if (words.starts_with("@")) return read_connection(words.substr(1));
  return from_environment(words);
}

std::string told_token() {
  std::string token = variable(kTokenVariable);
  const std::string file = variable("FOOTWALL_ENGINE_TOKEN_FILE");
  if (token.empty() && !file.empty())
    token = text::trimmed(text::split(read_secret(file, "token file"), '\n').front());
  return token;
}

std::filesystem::path certificate_folder() {
  // As the XDG base directory specification has it: what is not absolute is ignored.
  const std::filesystem::path state = variable("XDG_STATE_HOME");
  if (state.is_absolute()) return state / "footwall" / "engine";
  const std::filesystem::path home = variable("HOME");
  return home.is_absolute() ? home / ".local" / "state" / "footwall" / "engine" : std::filesystem::path();
}

std::filesystem::path default_connection_file(const std::filesystem::path& project) {
  const std::string runtime = variable("XDG_RUNTIME_DIR");
  const std::filesystem::path folder =
      !runtime.empty() && std::filesystem::is_directory(runtime)
          ? private_home(std::filesystem::path(runtime) / "footwall")
          : private_home(session::temporary_home() / ("footwall-" + std::to_string(::geteuid())));
  if (project.empty()) return folder / "engine.json";
  const std::string whole = std::filesystem::weakly_canonical(project).string();
  const auto bytes = std::as_bytes(std::span(whole.data(), whole.size()));
  return folder / (std::filesystem::path(whole).stem().string() + "-" + to_hex(hash64(bytes)) + ".json");
}

}  // namespace footwall::service
