#include "engine/service/client/connection_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

Connection sample() {
  Connection connection;
  connection.address = "tcp:cluster.example:4711";
  connection.token = "0123456789abcdef0123456789abcdef";
  connection.certificate = "-----BEGIN CERTIFICATE-----\n";
  connection.fingerprint = "AB:CD";
  connection.host = "node7";
  connection.process = 4242;
  connection.version = "0.1.0";
  connection.project = "/surveys/f3.footwall";
  return connection;
}

ErrorCode code_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_FALSE(error.hint().empty()) << error.message();
    EXPECT_EQ(std::string(error.what()).find("0123456789abcdef"), std::string::npos) << "tells the token";
    return error.code();
  }
  return ErrorCode::kInternal;
}

class ConnectionFile : public testing::Test {
 protected:
  ConnectionFile() {
    for (const char* name :
         {"FOOTWALL_ENGINE_TOKEN", "FOOTWALL_ENGINE_TOKEN_FILE", "FOOTWALL_ENGINE_CERTIFICATE"})
      unsetenv(name);
  }
  ~ConnectionFile() override {
    for (const char* name : {"FOOTWALL_ENGINE_TOKEN", "FOOTWALL_ENGINE_TOKEN_FILE",
                             "FOOTWALL_ENGINE_CERTIFICATE", "XDG_RUNTIME_DIR"})
      unsetenv(name);
  }
  std::filesystem::path written(const std::string& text, mode_t mode = 0600) {
    const auto path = folder.file("c.json", text);
    chmod(path.c_str(), mode);
    return path;
  }
  ErrorCode reading(const std::filesystem::path& path) {
    return code_of([&] { read_connection(path); });
  }

  ScratchFolder folder;
};

TEST_F(ConnectionFile, ReadsBackAsWritten) {
  const auto path = folder / "c.json";
  umask(0);
  write_connection(sample(), path);
  umask(022);
  struct stat facts {};
  ASSERT_EQ(stat(path.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777U, 0600U);
  const Connection read = connection_from("@" + path.string());
  EXPECT_EQ(read.address, sample().address);
  EXPECT_EQ(read.token, sample().token);
  EXPECT_EQ(read.certificate, sample().certificate);
  EXPECT_EQ(read.fingerprint, sample().fingerprint);
  EXPECT_EQ(read.host, sample().host);
  EXPECT_EQ(read.process, sample().process);
  EXPECT_EQ(read.version, sample().version);
  EXPECT_EQ(read.project, sample().project);
  // Written again it is the new one, and nothing else is left in the folder.
  Connection other = sample();
  other.process = 1;
  write_connection(other, path);
  EXPECT_EQ(read_connection(path).process, 1);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST_F(ConnectionFile, WhatOthersCanReadOrWriteIsRefused) {
  write_connection(sample(), folder / "c.json");
  const std::string good = content_of(folder / "c.json");
  for (const mode_t mode : {0640U, 0604U, 0620U, 0666U})
    EXPECT_EQ(reading(written(good, mode)), ErrorCode::kInvalid);
  if (geteuid() == 0) {
    const auto path = written(good);
    ASSERT_EQ(chown(path.c_str(), 12345, 12345), 0);
    EXPECT_EQ(reading(path), ErrorCode::kInvalid);
  }
  EXPECT_EQ(reading(folder.path()), ErrorCode::kInvalid);
  EXPECT_EQ(reading(folder / "nothing"), ErrorCode::kNotFound);
}

TEST_F(ConnectionFile, OtherTextIsRefused) {
  for (const std::string text :
       {"", "{", "[]", "{}", "null", R"({"footwall_engine": 1})",
        R"({"footwall_engine": "one", "address": "unix:/a"})",
        R"({"footwall_engine": 1, "address": 7, "token": "t"})",
        R"({"footwall_engine": 1, "address": "unix:/a"})",
        R"({"footwall_engine": 1, "address": "unix:/a", "token": ""})",
        R"({"footwall_engine": 1, "address": "http://a", "token": "t"})",
        R"({"footwall_engine": 1, "address": "tcp:a", "token": "t", "certificate": "c"})",
        R"({"footwall_engine": 1, "address": "tcp:a:70000", "token": "t", "certificate": "c"})",
        R"({"footwall_engine": 1, "address": "tcp:a:1", "token": "t"})",
        R"({"footwall_engine": 1, "address": "unix:/a", "token": "t", "process": "x"})"}) {
    EXPECT_EQ(reading(written(text)), ErrorCode::kFormat) << text;
  }
  EXPECT_EQ(reading(written(R"({"footwall_engine": 2})")), ErrorCode::kUnsupported);
  EXPECT_EQ(reading(written(std::string(std::size_t{1} << 20, ' '))), ErrorCode::kFormat);
}

TEST_F(ConnectionFile, AnAddressTakesItsSecretsFromTheEnvironment) {
  const auto code = [](const std::string& words) { return code_of([&] { connection_from(words); }); };
  EXPECT_EQ(code("somewhere"), ErrorCode::kUsage);
  EXPECT_EQ(code(""), ErrorCode::kUsage);
  EXPECT_EQ(code("unix:relative"), ErrorCode::kUsage);
  EXPECT_EQ(code("unix:/a"), ErrorCode::kUsage);  // no token
  setenv("FOOTWALL_ENGINE_TOKEN_FILE", written("secret\n").c_str(), 1);
  EXPECT_EQ(connection_from("unix:/a").token, "secret");
  setenv("FOOTWALL_ENGINE_TOKEN_FILE", written("secret\n", 0644).c_str(), 1);
  EXPECT_EQ(code("unix:/a"), ErrorCode::kInvalid);
  setenv("FOOTWALL_ENGINE_TOKEN", "other", 1);
  EXPECT_EQ(connection_from("unix:/a").token, "other");
  EXPECT_EQ(code("tcp:a:1"), ErrorCode::kUsage);  // no certificate
  setenv("FOOTWALL_ENGINE_CERTIFICATE", folder.file("cert.pem", "PEM").c_str(), 1);
  EXPECT_EQ(connection_from("tcp:a:1").certificate, "PEM");
}

TEST_F(ConnectionFile, EachProjectHasItsOwnPlace) {
  setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  const auto none = default_connection_file({});
  const auto a = default_connection_file(folder / "a" / "s.footwall");
  const auto b = default_connection_file(folder / "b" / "s.footwall");
  EXPECT_NE(a, b);
  EXPECT_NE(a, none);
  EXPECT_EQ(a.parent_path(), folder / "footwall");
  EXPECT_EQ(default_connection_file(folder / "b" / ".." / "a" / "s.footwall"), a);
  struct stat facts {};
  ASSERT_EQ(stat((folder / "footwall").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777U, 0700U);
  // A folder that somebody else could have prepared.
  chmod((folder / "footwall").c_str(), 0777);
  EXPECT_EQ(code_of([] { default_connection_file({}); }), ErrorCode::kInvalid);
}

}  // namespace
}  // namespace footwall::service
