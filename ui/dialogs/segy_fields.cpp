#include "ui/dialogs/segy_fields.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <cmath>

#include "engine/tasks/add_volume.h"

namespace footwall::ui {
namespace {

namespace segy = formats::segy;

QString tr(const char* text) {
  return QCoreApplication::translate("SegyFields", text);
}

std::optional<segy::HeaderWord> word_of(const QString& text, const char* field) {
  const QString trimmed = text.trimmed();
  if (trimmed.isEmpty()) return std::nullopt;
  return segy::header_word_from(trimmed.toStdString(), field);
}

QString words(const segy::HeaderWord& a, const segy::HeaderWord& b) {
  return QString::fromStdString(segy::text_of(a) + "/" + segy::text_of(b));
}

QString lines_text(std::int64_t inlines, std::int64_t crosslines) {
  return tr("%1 × %2 lines").arg(inlines).arg(crosslines);
}

bool suit(survey::Domain domain, survey::VerticalUnit unit) {
  return (domain == survey::Domain::kTime) == (unit == survey::VerticalUnit::kMillisecond);
}

}  // namespace

segy::Options options_of(const SegyFields& fields) {
  segy::Options options;
  options.inline_byte = word_of(fields.inline_byte, "the inline's byte");
  options.crossline_byte = word_of(fields.crossline_byte, "the crossline's byte");
  options.x_byte = word_of(fields.x_byte, "the byte of X");
  options.y_byte = word_of(fields.y_byte, "the byte of Y");
  if (const QString scalar = fields.scalar.trimmed(); !scalar.isEmpty()) {
    bool is_number = false;
    const int factor = QLocale::c().toInt(scalar, &is_number);
    if (!is_number || factor == 0 || factor < -32768 || factor > 32767) {
      throw Error(ErrorCode::kUsage,
                  "the coordinate scalar is no whole number as at byte 71: " + scalar.toStdString(),
                  "10 multiplies by 10, -100 divides by 100; leave it empty to take the file's");
    }
    options.coordinate_scalar = factor;
  }
  options.format = fields.format;
  options.endian = fields.endian;
  if (!fields.interval.trimmed().isEmpty()) {
    bool is_number = false;
    const double interval = QLocale::c().toDouble(fields.interval.trimmed(), &is_number);
    if (!is_number || !(interval > 0) || !std::isfinite(interval)) {
      throw Error(ErrorCode::kUsage,
                  "the sample interval is no number above 0: " + fields.interval.toStdString(),
                  "leave it empty to take the file's");
    }
    options.interval = interval;
  }
  options.domain = fields.domain.value_or(survey::Domain::kTime);
  options.vertical_unit =
      fields.unit.value_or(options.domain == survey::Domain::kTime ? survey::VerticalUnit::kMillisecond
                                                                   : survey::VerticalUnit::kMetre);
  options.crs = fields.crs.trimmed().toStdString();
  return options;
}

QString evidence_of(const segy::LineCandidate& candidate) {
  QString text = words(candidate.inline_word, candidate.crossline_word) + QStringLiteral(": ") +
                 lines_text(candidate.inlines, candidate.crosslines) +
                 tr(", %1 % filled").arg(std::lround(100 * candidate.fill));
  text += std::isnan(candidate.misfit) ? tr(", no coordinates")
                                       : tr(", fit %1 bins").arg(candidate.misfit, 0, 'f', 2);
  if (!candidate.one_offset) text += tr(", several offsets");
  if (!candidate.preset.empty())
    text += QStringLiteral(" (%1)").arg(QString::fromStdString(candidate.preset));
  return text;
}

QString evidence_of(const segy::Inspection& found) {
  if (!found.inlines) return tr("no line numbers found");
  const segy::Report& report = found.report;
  QString text = words(report.inline_word, report.crossline_word) + QStringLiteral(": ") +
                 lines_text(found.inlines->count, found.crosslines->count) +
                 (report.missing_bins == 1 ? tr(", 1 gap") : tr(", %1 gaps").arg(report.missing_bins));
  if (!std::isnan(report.residual)) {
    text +=
        tr(", fit %1 %2").arg(report.residual, 0, 'f', 2).arg(QString::fromStdString(report.horizontal_unit));
  }
  return text;
}

QStringList missing_of(const SegyFields& fields, const segy::SurveyLook* look,
                       const project::Project* project) {
  QStringList missing;
  if (!fields.domain) missing += tr("choose time or depth");
  if (!fields.unit) missing += tr("choose the vertical unit");
  if (fields.domain && fields.unit && !suit(*fields.domain, *fields.unit)) {
    missing += *fields.domain == survey::Domain::kTime ? tr("time is in ms") : tr("depth is in m or ft");
  }
  try {
    options_of(fields);
    if (project != nullptr) {
      tasks::check_free_name(*project, fields.name.toStdString());
    } else {
      project::check_name("volume", fields.name.toStdString());
    }
    if (look == nullptr) {
      missing += tr("the headers are being read");
    } else if (look->found().refusal) {
      throw Error(*look->found().refusal);
    } else if (missing.isEmpty() && project != nullptr && project->survey()) {
      tasks::origin_in(*project->survey(), *look->found().geometry);
    }
  } catch (const Error& error) {
    missing += QString::fromStdString(error.message());
  }
  return missing;
}

QString bytes_text(std::int64_t bytes) {
  if (bytes < 50'000) return tr("%1 kB").arg(static_cast<double>(bytes) / 1e3, 0, 'f', 1);
  if (bytes < 1'000'000'000) return tr("%1 MB").arg(static_cast<double>(bytes) / 1e6, 0, 'f', 1);
  return tr("%1 GB").arg(static_cast<double>(bytes) / 1e9, 0, 'f', 1);
}

QString import_text(const segy::SurveyLook* look) {
  if (look == nullptr || !look->found().geometry) return tr("Import");
  return tr("Import %1 traces (read %2, write %3)")
      .arg(QLocale::c().toString(static_cast<qlonglong>(look->found().report.live_traces)),
           bytes_text(look->bytes_read()), bytes_text(look->bytes_written()));
}

}  // namespace footwall::ui
