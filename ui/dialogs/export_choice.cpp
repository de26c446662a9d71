#include "ui/dialogs/export_choice.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QLocale>
#include <memory>

#include "engine/tasks/export_faces.h"
#include "engine/tasks/export_sticks.h"
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

Exported faces_into(const tasks::FaceTables& faces, const ExportChoice& choice) {
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

}  // namespace

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
  }
  return {};
}

QString with_suffix(const QString& file, const ExportChoice& choice) {
  const QString wanted = suffix_of(choice);
  QString stem = file;
  for (const char* known : {".csv", ".vtp", ".ts", ".dat", ".png"}) {
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

std::function<Exported()> prepare_export(const project::Project& project, const ExportChoice& choice,
                                         const WritePicture& write_picture) {
  switch (choice.kind) {
    case ExportChoice::Kind::kCsv:
    case ExportChoice::Kind::kVtp:
    case ExportChoice::Kind::kTsurf: {
      auto faces = std::make_shared<const tasks::FaceTables>(
          tasks::face_tables(project, choice.fault, choice.run, tasks::Coordinates::kWorld));
      return [faces, choice] { return faces_into(*faces, choice); };
    }
    case ExportChoice::Kind::kSticks:
      return [said = sticks_into(project, choice)] { return said; };
    case ExportChoice::Kind::kPicture:
      break;
  }
  if (!write_picture)
    throw Error(ErrorCode::kUsage, "there is no view to make a picture of", "open one first");
  write_picture(choice.file);
  return [] { return Exported{tr("picture written"), {}}; };
}

}  // namespace footwall::ui
