// What a file is, by its content: for drag and drop.
#pragma once
#include <QString>

namespace footwall::ui {

enum class FileKind { kUnknown, kProject, kVolume, kSticks, kSurface };

// Reads its first 64 KiB at most. A file that cannot be read is kUnknown.
FileKind kind_of_file(const QString& path);

}  // namespace footwall::ui
