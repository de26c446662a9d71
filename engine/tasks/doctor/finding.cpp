#include "engine/tasks/doctor/finding.h"

#include <algorithm>
#include <exception>

#include "storage/base/error.h"

namespace footwall::tasks {

Finding ok(std::string what) {
  return {{}, Verdict::kOk, std::move(what), {}};
}
Finding warning(std::string what, std::string hint) {
  return {{}, Verdict::kWarning, std::move(what), std::move(hint)};
}
Finding failed(std::string what, std::string hint) {
  return {{}, Verdict::kFailed, std::move(what), std::move(hint)};
}

bool Checkup::run(const std::string& name, const std::function<Finding()>& check) {
  job_.report(std::min(1.0, static_cast<double>(findings_.size()) / expected_), name);
  Finding finding;
  try {
    finding = check();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    finding =
        failed(error.message(),
               error.hint().empty() ? "choose another folder, or ask who runs this machine" : error.hint());
  } catch (const std::exception& error) {
    finding = failed(error.what(), "this is a bug of Footwall: please report it");
  }
  finding.name = name;
  findings_.push_back(std::move(finding));
  return findings_.back().verdict != Verdict::kFailed;
}

}  // namespace footwall::tasks
