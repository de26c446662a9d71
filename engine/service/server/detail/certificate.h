// The key and the self-signed certificate that an engine proves itself with.
#pragma once
#include <filesystem>
#include <string>

namespace footwall::service {

struct Certificate {
  std::string key;          // PEM
  std::string certificate;  // PEM
  std::string fingerprint;  // SHA-256 of the certificate's DER, "AB:CD:..."
};

// What stands in folder/key.pem and folder/certificate.pem; made where neither is there, or where it expires
// within 30 days: ECDSA on P-256, ten years, for kCertificateName. The folder is made private, the
// files have mode 0600. Throws Error kIo, kCorrupt (the two do not belong together), kUsage (the folder is
// not private), kInternal.
Certificate engine_certificate(const std::filesystem::path& folder);

// "AB:CD:..." of a certificate in PEM. Throws Error kFormat.
std::string fingerprint_of(const std::string& pem);

}  // namespace footwall::service
