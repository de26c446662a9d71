#include "ui/window/file_kinds.h"

#include <QFile>
#include <filesystem>

#include "storage/base/error.h"
#include "storage/formats/nrrd.h"
#include "storage/formats/segy/segy_file.h"
#include "storage/formats/stick_formats.h"

namespace footwall::ui {
namespace {

constexpr qint64 kHead = 64 * 1024;

}  // namespace

FileKind kind_of_file(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return FileKind::kUnknown;
  QByteArray head = file.read(kHead);
  if (head.startsWith("SQLite format 3")) return FileKind::kProject;
  if (head.startsWith("GOCAD TSurf")) return FileKind::kSurface;
  if (file.size() > kHead) head.truncate(head.lastIndexOf('\n') + 1);  // whole rows
  try {
    const std::filesystem::path name = path.toStdString();
    if (formats::nrrd::looks_like_nrrd(name) || formats::segy::looks_like_segy(name))
      return FileKind::kVolume;
    if (formats::recognise_sticks({head.constData(), static_cast<std::size_t>(head.size())}) != nullptr) {
      return FileKind::kSticks;
    }
  } catch (const Error&) {
    return FileKind::kUnknown;  // cannot be read: what happens next says why
  }
  return FileKind::kUnknown;
}

}  // namespace footwall::ui
