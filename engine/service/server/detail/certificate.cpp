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
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
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

// Mode 0600 from the first byte, whole or not at all.
void write_secret(const std::filesystem::path& path, const std::string& text) {
  PartialFile partial(path);
  const std::string name = partial.path().string();
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) throw io_error("write", name, errno);
  const ssize_t written = ::write(file, text.data(), text.size());
  const int trouble = written < 0 ? errno : 0;
  ::close(file);
  if (trouble != 0) throw io_error("write", name, trouble);
  if (written != static_cast<ssize_t>(text.size())) throw io_error("write", name, ENOSPC);
  partial.commit();
}

void make(const std::filesystem::path& key_path, const std::filesystem::path& certificate_path) {
  const Key key(EVP_EC_gen("P-256"));
  need(key != nullptr, "make a key");
  const X509Certificate certificate = self_signed(*key);
  const Bio key_text(BIO_new(BIO_s_mem()));
  const Bio certificate_text(BIO_new(BIO_s_mem()));
  need(key_text && certificate_text, "write to memory");
  need(PEM_write_bio_PKCS8PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1 &&
           PEM_write_bio_X509(certificate_text.get(), certificate.get()) == 1,
       "write a certificate");
  write_secret(key_path, text_of(*key_text));
  write_secret(certificate_path, text_of(*certificate_text));
}

bool expires_soon(const X509& certificate) {
  std::time_t then = std::time(nullptr) + kRenewSeconds;
  return X509_cmp_time(X509_get0_notAfter(&certificate), &then) < 0;
}

Certificate read(const std::filesystem::path& key_path, const std::filesystem::path& certificate_path) {
  return {read_whole_file(key_path, kLargestFile), read_whole_file(certificate_path, kLargestFile), {}};
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

Certificate engine_certificate(const std::filesystem::path& folder) {
  require_private_folder(folder);
  const std::filesystem::path key_path = folder / "key.pem";
  const std::filesystem::path certificate_path = folder / "certificate.pem";
  if (!exists(key_path) && !exists(certificate_path)) make(key_path, certificate_path);
  Certificate made = read(key_path, certificate_path);
  X509Certificate certificate = certificate_from(made.certificate);
  if (expires_soon(*certificate)) {
    make(key_path, certificate_path);
    made = read(key_path, certificate_path);
    certificate = certificate_from(made.certificate);
  }
  const Key key(PEM_read_bio_PrivateKey(reader(made.key).get(), nullptr, nullptr, nullptr));
  if (!key || X509_check_private_key(certificate.get(), key.get()) != 1) {
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} and {} do not belong together", key_path.string(), certificate_path.string()),
                "remove both: new ones are made");
  }
  made.fingerprint = fingerprint_of(made.certificate);
  return made;
}

}  // namespace footwall::service
