// How a client reaches an engine: a small file that `footwall serve` writes and --engine @FILE takes. Mode
// 0600, JSON: {footwall_engine: 1, address, token, certificate, fingerprint, host, process, version,
// project}.
#pragma once
#include <filesystem>
#include <string>

namespace footwall::service {

struct Connection {
  std::string address;  // "unix:PATH" or "tcp:HOST:PORT"
  std::string token;
  std::string certificate;  // PEM, empty with unix:
  std::string fingerprint;
  std::string host;  // of rank 0
  int process = 0;   // of rank 0
  std::string version;
  std::string project;  // absolute path, or empty
};

// Whole or not at all, mode 0600 from the first byte. Throws Error kIo.
void write_connection(const Connection& connection, const std::filesystem::path& path);
// Throws Error kNotFound ("no engine runs ..."), kFormat, kInvalid where others than this user could read or
// write it.
Connection read_connection(const std::filesystem::path& path);
// "@FILE", or an address with the token in FOOTWALL_ENGINE_TOKEN or the file that FOOTWALL_ENGINE_TOKEN_FILE
// names; for "tcp:" FOOTWALL_ENGINE_CERTIFICATE names the engine's certificate. Throws as above, kUsage.
Connection connection_from(const std::string& words);
// The token that the environment tells, as above; empty where it tells none. Throws kNotFound, kInvalid.
std::string told_token();
// Where engines of this user keep key and certificate from start to start: $XDG_STATE_HOME/footwall/engine,
// or else ~/.local/state/footwall/engine. Empty where there is no home.
std::filesystem::path certificate_folder();
// Where `serve` writes, and `status` and `stop` look, when no file is named: in $XDG_RUNTIME_DIR/footwall
// (else a private folder of this user under the temporary home), one for each project, one for none.
std::filesystem::path default_connection_file(const std::filesystem::path& project);

}  // namespace footwall::service
