#include "ui/window/status_line.h"

#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/model/accept_shift.h"

namespace footwall::ui {
namespace {

constexpr int kMargin = 10;
constexpr int kGap = 14;
constexpr int kSmallGap = 4;

QString grouped(double value, int decimals) {
  QString text = QString::number(value, 'f', decimals);
  const qsizetype point = text.indexOf(QLatin1Char('.'));
  for (qsizetype at = (point < 0 ? text.size() : point) - 3; at > (value < 0 ? 1 : 0); at -= 3) {
    text.insert(at, QChar(0x2009));  // thin space
  }
  return text;
}

}  // namespace

std::vector<ReadOut> read_out(const survey::Geometry& survey, const survey::IndexPoint& place,
                              const QString& name, double value) {
  const survey::WorldPoint world = survey.world_of(place);
  const QString z_unit = QString::fromUtf8(survey::name_of(survey.vertical_unit).data());
  const QString unit = QString::fromStdString(survey.horizontal_unit);
  std::vector<ReadOut> words{
      {QObject::tr("il"), true},     {QString::number(survey.inlines.line_of(std::llround(place.i)))},
      {QObject::tr("xl"), true},     {QString::number(survey.crosslines.line_of(std::llround(place.j)))},
      {QObject::tr("sample"), true}, {QString::number(std::llround(place.k))},
      {QStringLiteral("z"), true},   {QStringLiteral("%1 %2").arg(grouped(world.z, 1), z_unit)},
      {QStringLiteral("X"), true},   {grouped(world.x, 1)},
      {QStringLiteral("Y"), true},   {QStringLiteral("%1 %2").arg(grouped(world.y, 1), unit)}};
  if (!name.isEmpty()) {
    words.push_back({name, true});
    words.push_back({std::isnan(value) ? QStringLiteral("–") : QString::number(value, 'g', 4)});
  }
  return words;
}

double value_at(const Workbench& workbench, const survey::IndexPoint& place) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (std::abs(distance_from(shown.section, place)) > 0.5) continue;
    const auto samples = workbench.sections.kept(workbench.display.volume(), shown.section);
    if (!samples) continue;
    const PlanePoint at = plane_of(shown.section, place);
    const double column = std::round(at.u);
    const double row = std::round(at.v);
    if (column < 0 || row < 0 || column >= samples->columns || row >= samples->rows) continue;
    return samples->at(static_cast<int>(column), static_cast<int>(row));
  }
  return kNone;
}

StatusLine::StatusLine(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void StatusLine::show_workbench(Workbench* workbench) {
  if (workbench_ != nullptr) {
    workbench_->display.disconnect(this);
    workbench_->picking.disconnect(this);
    workbench_->line.disconnect(this);
    workbench_->sections.disconnect(this);
    workbench_->selection.disconnect(this);
    workbench_->surfaces.disconnect(this);
    workbench_->document.disconnect(this);
  }
  workbench_ = workbench;
  if (workbench_ != nullptr) {
    connect(&workbench_->display, &Display::cursor_moved, this, &StatusLine::refresh);
    connect(&workbench_->display, &Display::samples_changed, this, &StatusLine::refresh);
    connect(&workbench_->sections, &SectionReader::ready, this, &StatusLine::refresh);
    connect(&workbench_->picking, &Picking::hint_changed, this, &StatusLine::refresh);
    connect(&workbench_->line, &LineDrawing::changed, this, &StatusLine::refresh);
    connect(&workbench_->picking, &Picking::tool_changed, this, &StatusLine::refresh_shift);
    connect(&workbench_->selection, &Selection::changed, this, &StatusLine::refresh_shift);
    connect(&workbench_->surfaces, &Surfaces::numbers_changed, this, &StatusLine::refresh_shift);
    connect(&workbench_->surfaces, &Surfaces::offsets_changed, this, &StatusLine::refresh_shift);
    connect(&workbench_->document, &Document::faults_changed, this, &StatusLine::refresh_shift);
    connect(&workbench_->document, &Document::shapes_changed, this, &StatusLine::refresh_shift);
  }
  refresh_shift();
}

// By itself: it looks at all faces of a fault, and the mouse moves often.
void StatusLine::refresh_shift() {
  shift_.clear();
  if (workbench_ != nullptr && workbench_->picking.tool() == Tool::kSelect)
    shift_ = shift_hint(workbench_->document, workbench_->surfaces, workbench_->selection);
  refresh();
}

QString StatusLine::text() const {
  QString text;
  for (const ReadOut& word : words_) text += (text.isEmpty() ? QString() : QStringLiteral(" ")) + word.text;
  return text;
}

void StatusLine::refresh() {
  std::vector<ReadOut> words;
  QString hint;
  if (workbench_ != nullptr) {
    hint = workbench_->picking.hint();
    if (!shift_.isEmpty()) hint = hint.isEmpty() ? shift_ : tr("%1; %2").arg(shift_, hint);
    if (workbench_->line.is_active()) hint = workbench_->line.hint();
    const auto& survey = workbench_->document.survey();
    const auto& cursor = workbench_->display.cursor();
    if (survey && cursor) {
      QString name;
      for (const project::VolumeRecord& volume : workbench_->document.volumes()) {
        if (volume.id == workbench_->display.volume()) name = QString::fromStdString(volume.name);
      }
      words = read_out(*survey, *cursor, name, value_at(*workbench_, *cursor));
    }
  }
  if (words == words_ && hint == hint_) return;
  words_ = std::move(words);
  hint_ = std::move(hint);
  update();
}

void StatusLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.fillRect(QRect(0, 0, width(), 1), palette().color(QPalette::Mid));
  const QFontMetrics metrics = painter.fontMetrics();
  // The advance is rounded; without the slack a hint that fits would be cut.
  const int hint_width = std::min(metrics.horizontalAdvance(hint_) + kSmallGap, width() * 6 / 10);
  int x = kMargin;
  const int end = width() - 2 * kMargin - hint_width;
  for (const ReadOut& word : words_) {
    painter.setPen(palette().color(word.dim ? QPalette::PlaceholderText : QPalette::WindowText));
    const int advance = metrics.horizontalAdvance(word.text);
    if (x + advance > end) break;
    painter.drawText(QRect(x, 0, advance + 1, height()), Qt::AlignVCenter | Qt::AlignLeft, word.text);
    x += advance + (word.dim ? kSmallGap : kGap);
  }
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRect(width() - kMargin - hint_width, 0, hint_width, height()),
                   Qt::AlignVCenter | Qt::AlignRight, metrics.elidedText(hint_, Qt::ElideRight, hint_width));
}

}  // namespace footwall::ui
