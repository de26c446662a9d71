#include "engine/tasks/write_job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <vector>

#include "engine/tasks/job_texts.h"
#include "storage/base/byte_rate.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw io_error("open", path, errno);
  }
  ~Descriptor() { ::close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return descriptor_; }

 private:
  int descriptor_;
};

// Shares the bytes where the file system can (they are copied when either file changes, which volumes never
// do); else another name for the same file; else a copy.
void take_volume(const fs::path& from, const fs::path& to, const JobContext& context) {
  {
    const Descriptor source(from, O_RDONLY);
    const Descriptor target(to, O_WRONLY | O_CREAT | O_EXCL);
    if (::ioctl(target, FICLONE, static_cast<int>(source)) == 0) return;
  }
  fs::remove(to);
  std::error_code no_link;
  fs::create_hard_link(fs::canonical(from), to, no_link);
  if (!no_link) return;
  const auto size = static_cast<std::int64_t>(fs::file_size(from));
  const Descriptor source(from, O_RDONLY);
  const Descriptor target(to, O_WRONLY | O_CREAT | O_EXCL);
  std::vector<char> bytes(std::size_t{8} << 20);
  ByteRate rate(size);
  for (std::int64_t done = 0; done < size;) {
    context.report(static_cast<double>(done) / static_cast<double>(size), "copy the volume",
                   rate.text(done, ByteRate::Clock::now()));
    const ssize_t got = ::read(source, bytes.data(), bytes.size());
    if (got <= 0) throw io_error("read", from, got < 0 ? errno : EIO);
    for (ssize_t at = 0; at < got;) {
      const ssize_t put = ::write(target, bytes.data() + at, static_cast<std::size_t>(got - at));
      if (put < 0) throw io_error("write", to, errno);
      at += put;
    }
    done += got;
  }
  if (::fsync(target) != 0) throw io_error("flush", to, errno);
}

}  // namespace

void write_job_folder(const session::Job& wanted, const Forecast& forecast, const fs::path& folder,
                      bool with_volume, const JobContext& context) {
  const fs::path place = fs::absolute(folder).lexically_normal();
  const fs::path target = place.has_filename() ? place : place.parent_path();
  std::error_code ignored;
  if (fs::exists(target) && !fs::is_empty(target, ignored)) {
    throw Error(ErrorCode::kInvalid, fmt::format("there is something in {} already", folder.string()),
                "give a folder that does not exist, or an empty one");
  }
  // Beside its place, and renamed when whole.
  std::string temporary =
      fmt::format("{}/.{}.partial-XXXXXX", target.parent_path().string(), target.filename().string());
  if (::mkdtemp(temporary.data()) == nullptr) throw io_error("make a folder in", target.parent_path(), errno);
  struct Sweep {
    fs::path path;
    ~Sweep() {
      std::error_code nothing_to_do;
      fs::remove_all(path, nothing_to_do);
    }
  } const sweep{temporary};
  const fs::path made = temporary;

  session::Job job = wanted;
  job.output = "parts";
  if (with_volume) {
    take_volume(job.volume, made / "volume.h5", context.part(0, 0.95));
    job.volume = "volume.h5";
  }
  session::write_job(job, made / "JOB.json");
  const std::string name = target.filename().string();
  write_whole_file(made / "job.sbatch", job_script(job, forecast, name));
  write_whole_file(made / "README.txt", job_readme(job, forecast));
  fs::permissions(made, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                            fs::perms::others_read | fs::perms::others_exec);
  context.check();
  if (::rename(made.c_str(), target.c_str()) != 0) throw io_error("write", target, errno);
  context.report(1, "written");
}

}  // namespace footwall::tasks
