#include "ui/dialogs/export_choice.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QLocale>
#include <memory>

#include "engine/tasks/export_faces.h"
#include "engine/tasks/export_sticks.h"
#include "engine/tasks/export_volume.h"
#include "storage/formats/stick_formats.h"

namespace footwall::ui {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("Export", text);
}

QString number(std::int64_t n) {
  return QLocale::c().toString(static_cast<qlonglong>(n));
}

QString faults_text(std::int64_t faults) {
  return faults == 1 ? tr("1 fault") : tr("%1 faults").arg(number(faults));
}

Exported faces_into(const project::Project& project, const ExportChoice& choice, const JobContext& job) {
  job.report(0, "read");
  const tasks::FaceTables faces =
      tasks::face_tables(project, choice.fault, choice.run, tasks::Coordinates::kWorld);
  job.report(0.5, "write");
  const tasks::FacesExported done = tasks::write_faces(faces, choice.file.toStdString());
  Exported said;
  said.text = tr("%1 faces of %2, %3")
                  .arg(number(done.faces), faults_text(done.faults),
                       done.run.empty() ? tr("no statistics yet")
                                        : tr("statistics of %1").arg(QString::fromStdString(done.run)));
  for (const std::string& fault : done.stale) {
    said.notices += tr("%1 was edited since: the run's faces are written").arg(QString::fromStdString(fault));
  }
  for (const std::string& renamed : done.renamed) {
    said.notices += tr("renamed: %1").arg(QString::fromStdString(renamed));
  }
  return said;
}

Exported sticks_into(const project::Project& project, const ExportChoice& choice) {
  tasks::SticksChoice what;
  what.fault = choice.fault;
  what.interpolated = choice.interpolated;
  const tasks::SticksExported done =
      tasks::export_sticks(project, choice.file.toStdString(), choice.stick_format, what);
  Exported said;
  said.text = tr("%1 pillars of %2, %3 nodes")
                  .arg(number(done.pillars), faults_text(done.faults), number(done.nodes));
  for (const std::string& renamed : done.renamed) {
    said.notices += tr("renamed: %1").arg(QString::fromStdString(renamed));
  }
  return said;
}

Exported volume_into(const project::Project& project, const ExportChoice& choice, const JobContext& job) {
  const std::string file = choice.file.toStdString();
  const project::VolumeRecord volume = project.volume(choice.volume);
  Exported said;
  said.text = tr("%1: %2 x %3 x %4 samples")
                  .arg(QString::fromStdString(volume.name), number(volume.dims[0]), number(volume.dims[1]),
                       number(volume.dims[2]));
  if (choice.kind == ExportChoice::Kind::kSegy) {
    const formats::segy::Written done = tasks::export_segy(project, volume.name, file, {}, job);
    said.text = tr("%1: %2 traces, %3 bins without a trace left out")
                    .arg(QString::fromStdString(volume.name), number(done.traces), number(done.skipped));
    for (const std::string& note : done.notes) said.notices += QString::fromStdString(note);
  } else if (choice.kind == ExportChoice::Kind::kVti) {
    tasks::export_vti(project, volume.name, file, true, job);
  } else if (choice.kind == ExportChoice::Kind::kNrrd) {
    tasks::export_nrrd(project, volume.name, file, formats::raw::axis_order_from("kji"), job);
  } else {
    tasks::export_raw(project, volume.name, file, {}, job);
    said.notices += tr("float32, little-endian, samples fastest, then crosslines, then inlines");
  }
  return said;
}

}  // namespace

bool is_volume(ExportChoice::Kind kind) {
  using Kind = ExportChoice::Kind;
  return kind == Kind::kSegy || kind == Kind::kVti || kind == Kind::kNrrd || kind == Kind::kRaw;
}

QString suffix_of(const ExportChoice& choice) {
  switch (choice.kind) {
    case ExportChoice::Kind::kCsv:
      return QStringLiteral(".csv");
    case ExportChoice::Kind::kVtp:
      return QStringLiteral(".vtp");
    case ExportChoice::Kind::kTsurf:
      return QStringLiteral(".ts");
    case ExportChoice::Kind::kSticks:
      return QStringLiteral(".dat");
    case ExportChoice::Kind::kPicture:
      return QStringLiteral(".png");
    case ExportChoice::Kind::kSegy:
      return QStringLiteral(".sgy");
    case ExportChoice::Kind::kVti:
      return QStringLiteral(".vti");
    case ExportChoice::Kind::kNrrd:
      return QStringLiteral(".nrrd");
    case ExportChoice::Kind::kRaw:
      return QStringLiteral(".raw");
  }
  return {};
}

QString with_suffix(const QString& file, const ExportChoice& choice) {
  const QString wanted = suffix_of(choice);
  QString stem = file;
  for (const char* known :
       {".csv", ".vtp", ".ts", ".dat", ".png", ".sgy", ".segy", ".vti", ".nrrd", ".raw"}) {
    if (stem.endsWith(QLatin1String(known), Qt::CaseInsensitive)) {
      stem.chop(static_cast<qsizetype>(qstrlen(known)));
      break;
    }
  }
  return stem + wanted;
}

QStringList stick_format_names() {
  QStringList names;
  for (const formats::StickFormat& format : formats::stick_formats()) {
    if (format.write == nullptr) continue;
    names += QString::fromUtf8(format.name.data(), static_cast<qsizetype>(format.name.size()));
  }
  return names;
}

std::function<Exported(const JobContext&)> prepare_export(const project::Project& project,
                                                          const ExportChoice& choice,
                                                          const WritePicture& write_picture) {
  if (choice.kind == ExportChoice::Kind::kPicture) {
    if (!write_picture)
      throw Error(ErrorCode::kUsage, "there is no view to make a picture of", "open one first");
    write_picture(choice.file);
    return [](const JobContext&) { return Exported{tr("picture written"), {}}; };
  }
  auto beside = std::make_shared<const project::Project>(project.beside());
  return [beside, choice](const JobContext& job) {
    if (is_volume(choice.kind)) return volume_into(*beside, choice, job);
    return choice.kind == ExportChoice::Kind::kSticks ? sticks_into(*beside, choice)
                                                      : faces_into(*beside, choice, job);
  };
}

}  // namespace footwall::ui
