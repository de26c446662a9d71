#include "engine/service/server/detail/certificate.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>

#include "engine/service/server/private_folder.h"
#include "engine/service/words_on_the_wire.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::service {
namespace {

template <auto function>
struct Freed {
  template <class T>
  void operator()(T* what) const {
    function(what);
  }
};
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using X509Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;

constexpr std::size_t kLargestFile = 1 << 20;
constexpr long kLifeSeconds = 3650L * 24 * 3600;
constexpr long kRenewSeconds = 30L * 24 * 3600;

void need(bool worked, const char* what) {
  if (!worked) throw Error(ErrorCode::kInternal, fmt::format("OpenSSL cannot {}", what));
}

Bio reader(const std::string& text) {
  Bio bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  need(bio != nullptr, "read memory");
  return bio;
}

std::string text_of(BIO& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(&bio, &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string text_of(EVP_PKEY& key) {
  const Bio text(BIO_new(BIO_s_mem()));
  need(text && PEM_write_bio_PKCS8PrivateKey(text.get(), &key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
       "write a key");
  return text_of(*text);
}

std::string text_of(X509& certificate) {
  const Bio text(BIO_new(BIO_s_mem()));
  need(text && PEM_write_bio_X509(text.get(), &certificate) == 1, "write a certificate");
  return text_of(*text);
}

X509Certificate certificate_from(const std::string& pem) {
  X509Certificate certificate(PEM_read_bio_X509(reader(pem).get(), nullptr, nullptr, nullptr));
  if (!certificate) throw Error(ErrorCode::kFormat, "this is no certificate in PEM");
  return certificate;
}

void add_extension(X509& certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &certificate, &certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  need(extension && X509_add_ext(&certificate, extension.get(), -1) == 1, "describe a certificate");
}

X509Certificate self_signed(EVP_PKEY& key) {
  X509Certificate certificate(X509_new());
  need(certificate != nullptr, "make a certificate");
  std::array<unsigned char, 16> serial{};
  need(RAND_bytes(serial.data(), static_cast<int>(serial.size())) == 1, "draw random numbers");
  serial[0] &= 0x7FU;
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(
      BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr));
  need(number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate.get())) != nullptr,
       "number a certificate");
  need(X509_set_version(certificate.get(), X509_VERSION_3) == 1, "make a certificate");
  // Clocks of two machines differ a little.
  need(X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -24L * 3600) != nullptr &&
           X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kLifeSeconds) != nullptr,
       "date a certificate");
  X509_NAME* name = X509_get_subject_name(certificate.get());
  need(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                                  reinterpret_cast<const unsigned char*>(kCertificateName), -1, -1, 0) == 1,
       "name a certificate");
  need(X509_set_issuer_name(certificate.get(), name) == 1, "name a certificate");
  need(X509_set_pubkey(certificate.get(), &key) == 1, "make a certificate");
  add_extension(*certificate, NID_basic_constraints, "critical,CA:TRUE");
  add_extension(*certificate, NID_subject_alt_name,
                fmt::format("DNS:{},DNS:localhost,IP:127.0.0.1,IP:::1", kCertificateName));
  need(X509_sign(certificate.get(), &key, EVP_sha256()) > 0, "sign a certificate");
  return certificate;
}

// Mode 0600 from the first byte, whole or not at all. is_first: what another engine has written meanwhile
// stays.
void write_secret(const std::filesystem::path& path, const std::string& text, bool is_first) {
  PartialFile partial(path);
  const std::string name = partial.path().string();
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) throw io_error("write", name, errno);
  const ssize_t written = ::write(file, text.data(), text.size());
  const int trouble = written < 0 ? errno : 0;
  ::close(file);
  if (trouble != 0) throw io_error("write", name, trouble);
  if (written != static_cast<ssize_t>(text.size())) throw io_error("write", name, ENOSPC);
  if (!is_first) {
    partial.commit();
  } else if (::link(name.c_str(), path.c_str()) != 0 && errno != EEXIST) {
    throw io_error("write", path.string(), errno);
  }
}

std::string made_pem() {
  const Key key(EVP_EC_gen("P-256"));
  need(key != nullptr, "make a key");
  const X509Certificate certificate = self_signed(*key);
  return text_of(*key) + text_of(*certificate);
}

// Throws kUsage where others may know what stands in it, or could have written it.
std::string read_secret(const std::filesystem::path& path) {
  struct stat facts = {};
  if (::lstat(path.c_str(), &facts) != 0) throw io_error("look at", path.string(), errno);
  if (!S_ISREG(facts.st_mode) || facts.st_uid != ::geteuid() || (facts.st_mode & 077U) != 0) {
    throw Error(ErrorCode::kUsage, fmt::format("the engine's key {} is not yours alone", path.string()),
                "others may know it: remove it, and a new one is made");
  }
  return read_whole_file(path, kLargestFile);
}

bool expires_soon(const X509& certificate, std::time_t now) {
  std::time_t then = now + kRenewSeconds;
  return X509_cmp_time(X509_get0_notAfter(&certificate), &then) < 0;
}

struct Pair {
  Key key;
  X509Certificate certificate;
};

Pair read(const std::filesystem::path& path) {
  const std::string pem = read_secret(path);
  Pair pair{Key(PEM_read_bio_PrivateKey(reader(pem).get(), nullptr, nullptr, nullptr)),
            X509Certificate(PEM_read_bio_X509(reader(pem).get(), nullptr, nullptr, nullptr))};
  if (!pair.key || !pair.certificate || X509_check_private_key(pair.certificate.get(), pair.key.get()) != 1) {
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} is no key with a certificate that belongs to it", path.string()),
                "remove it: a new one is made");
  }
  return pair;
}

}  // namespace

std::string fingerprint_of(const std::string& pem) {
  const X509Certificate certificate = certificate_from(pem);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  need(X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size) == 1, "digest a certificate");
  std::string text;
  for (unsigned int n = 0; n < size; ++n) text += fmt::format("{}{:02X}", n == 0 ? "" : ":", digest.at(n));
  return text;
}

Certificate engine_certificate(const std::filesystem::path& folder, std::time_t now) {
  std::error_code failure;  // require_private_folder() tells
  std::filesystem::create_directories(folder.parent_path(), failure);
  require_private_folder(folder);
  const std::filesystem::path path = folder / "engine.pem";
  if (!std::filesystem::exists(std::filesystem::symlink_status(path))) write_secret(path, made_pem(), true);
  Pair pair = read(path);
  if (expires_soon(*pair.certificate, now)) {
    write_secret(path, made_pem(), false);
    pair = read(path);
  }
  Certificate made{text_of(*pair.key), text_of(*pair.certificate), {}};
  made.fingerprint = fingerprint_of(made.certificate);
  return made;
}

}  // namespace footwall::service
