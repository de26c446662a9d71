// SEG-Y files for the import dialog's tests: a made one with a hole and a duplicate, and real ones where they
// are.
#pragma once
#include <QDir>
#include <QTemporaryDir>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "storage/formats/segy/segy_writer.h"

namespace footwall::ui {

class MadeSegy {
 public:
  static constexpr int kInlines = 12, kCrosslines = 9, kSamples = 50;

  // Inlines from 100 by 2, crosslines from 300, bins of 25 m, 4 ms; no trace in bin (3, 4); the first trace
  // twice.
  MadeSegy() : path_(std::filesystem::path(folder_.path().toStdString()) / "made.sgy") {
    survey::Geometry geometry;
    geometry.inlines = {100, 2, kInlines};
    geometry.crosslines = {300, 1, kCrosslines};
    geometry.samples = kSamples;
    geometry.interval = 4;
    geometry.map = {.origin_x = 600000,
                    .origin_y = 6000000,
                    .per_inline_x = 0,
                    .per_inline_y = 25,
                    .per_crossline_x = 25,
                    .per_crossline_y = 0};
    std::vector<std::uint8_t> live(kInlines * kCrosslines, 1);
    live[3 * kCrosslines + 4] = 0;
    formats::segy::write(path_, geometry, live,
                         [](const survey::Box& box, std::span<float> values) {
                           std::size_t n = 0;
                           for (auto i = box.lo[0]; i < box.hi[0]; ++i) {
                             for (auto j = box.lo[1]; j < box.hi[1]; ++j) {
                               for (auto k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = sample(i, j, k);
                             }
                           }
                         },
                         4, {});
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    std::vector<char> trace(240 + kSamples * 4);
    file.seekg(3600);
    file.read(trace.data(), static_cast<std::streamsize>(trace.size()));
    file.seekp(0, std::ios::end);
    file.write(trace.data(), static_cast<std::streamsize>(trace.size()));
  }
  static float sample(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<float>(100 * i + 10 * j) - static_cast<float>(k);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path folder() const { return folder_.path().toStdString(); }

 private:
  QTemporaryDir folder_;
  std::filesystem::path path_;
};

// Of the data beside the project's folder; empty where they are not.
inline QString real_segy(const QString& name) {
  const QString path = QStringLiteral(QT_TESTCASE_SOURCEDIR "/../../../../shared/data/") + name;
  return QFileInfo::exists(path) ? path : QString();
}

}  // namespace footwall::ui
