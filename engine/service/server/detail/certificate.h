// The key and the self-signed certificate that an engine proves itself with.
#pragma once
#include <ctime>
#include <filesystem>
#include <string>

namespace footwall::service {

struct Certificate {
  std::string key;          // PEM
  std::string certificate;  // PEM
  std::string fingerprint;  // SHA-256 of the certificate's DER, "AB:CD:..."
};

// What stands in folder/engine.pem, key and certificate; made where there is none, or where it expires within
// 30 days: ECDSA on P-256, ten years, for kCertificateName. The folder is made, private, the file has mode
// 0600; of engines that start at once all take the same one. Throws Error kIo, kCorrupt (the two do not
// belong together), kUsage (folder or file are not this user's alone), kInternal.
Certificate engine_certificate(const std::filesystem::path& folder, std::time_t now = std::time(nullptr));

// "AB:CD:..." of a certificate in PEM. Throws Error kFormat.
std::string fingerprint_of(const std::string& pem);

}  // namespace footwall::service
