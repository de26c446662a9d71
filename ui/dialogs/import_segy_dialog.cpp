#include "ui/dialogs/import_segy_dialog.h"

#include <QFileInfo>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>
#include <utility>

#include "ui/dialogs/caption.h"
#include "ui/dialogs/import_jobs.h"

namespace footwall::ui {
namespace {

namespace segy = formats::segy;

QLabel* dim_label(QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

QWidget* pane(QWidget* parent) {
  auto* widget = new QWidget(parent);
  auto* column = new QVBoxLayout(widget);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  return widget;
}

QString axis_text(const QString& name, const survey::LineAxis& axis) {
  const QString text = QStringLiteral("%1 %2–%3").arg(name).arg(axis.first).arg(axis.last());
  return axis.step == 1 ? text : text + QObject::tr(" by %1").arg(axis.step);
}

}  // namespace

ImportSegyDialog::ImportSegyDialog(const QString& file, Workbench* workbench, QWidget* parent)
    : QDialog(parent), file_(file), workbench_(workbench), looker_(file.toStdString()) {
  setWindowTitle(tr("Import %1").arg(QFileInfo(file).fileName()));
  resize(1180, 640);
  auto* panes = new QSplitter(this);
  panes->setChildrenCollapsible(false);
  panes->setHandleWidth(1);
  panes->addWidget(findings_pane(QFileInfo(file).completeBaseName().trimmed()));
  panes->addWidget(map_pane());
  panes->addWidget(preview_pane());
  panes->setSizes({400, 330, 450});
  panes->setStretchFactor(2, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(panes, 1);
  column->addLayout(bottom_row());

  pause_.setSingleShot(true);
  pause_.setInterval(120);
  connect(&pause_, &QTimer::timeout, this, &ImportSegyDialog::ask);
  connect(form_, &SegyFieldForm::changed, this, &ImportSegyDialog::fields_changed);
  connect(&looker_, &SegyLooker::looked, this, &ImportSegyDialog::show_look);
  connect(&looker_, &SegyLooker::failed, this,
          [this](quint64 request, const QString& message, const QString& hint) {
            if (request != asked_ || pause_.isActive()) return;  // of fields that are no more
            look_.reset();
            refusal_ = hint.isEmpty() ? message : message + QStringLiteral(": ") + hint;
            reading_ = false;
            map_->show_look(nullptr);
            line_->show_look(nullptr, unit());
            show_state();
            Q_EMIT looked();
          });
  connect(&looker_, &SegyLooker::progressed, this, [this](double fraction) {
    if (reading_) progress_->setValue(static_cast<int>(1000 * fraction));
  });
  connect(map_, &SegyMapView::bin_chosen, this, [this](qint64 inline_index, qint64 crossline_index) {
    choose_line(of_inline_, of_inline_ ? inline_index : crossline_index);
  });
  connect(&jobs_, &QAbstractItemModel::dataChanged, this, [this](const QModelIndex& row) {
    progress_->setValue(static_cast<int>(1000 * jobs_.data(row, Jobs::kFraction).toDouble()));
  });
  connect(&jobs_, &Jobs::finished, this,
          [this](int, Jobs::State state, const QString& message, const QString& hint) {
            job_ = 0;
            if (state == Jobs::State::kDone) {
              Q_EMIT project_made(project_->text());
              accept();
              return;
            }
            refusal_ = state == Jobs::State::kCancelled
                           ? QString()
                           : QStringLiteral("%1. %2").arg(message, hint).trimmed();
            show_state();
          });
  ask();
}

ImportSegyDialog::~ImportSegyDialog() = default;

QWidget* ImportSegyDialog::findings_pane(const QString& name) {
  QWidget* left = pane(this);
  auto* column = static_cast<QVBoxLayout*>(left->layout());
  column->addWidget(caption(tr("Header findings"), left));
  evidence_ = new QLabel(left);
  evidence_->setWordWrap(true);
  column->addWidget(evidence_);
  candidates_ = new QListWidget(left);
  candidates_->setObjectName(QStringLiteral("candidates"));
  candidates_->setAccessibleName(tr("Byte pairs that the headers show"));
  candidates_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  candidates_->setTextElideMode(Qt::ElideRight);
  candidates_->setMinimumHeight(72);
  connect(candidates_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    form_->take(look_->survey->found().candidates[item->data(Qt::UserRole).toUInt()]);
  });
  connect(candidates_, &QListWidget::itemClicked, candidates_, &QListWidget::itemActivated);
  column->addWidget(candidates_, 1);
  form_ = new SegyFieldForm(name, left);
  column->addWidget(form_);
  if (workbench_ == nullptr) {
    const QFileInfo file(file_);
    project_ =
        new QLineEdit(file.absolutePath() + QLatin1Char('/') + name + QStringLiteral(".footwall"), left);
    project_->setObjectName(QStringLiteral("project"));
    project_->setAccessibleName(tr("New project"));
    column->addWidget(caption(tr("New project"), left));
    column->addWidget(project_);
    connect(project_, &QLineEdit::textChanged, this, [this] { fields_changed(false); });
  }
  warnings_ = dim_label(left);
  warnings_->setForegroundRole(QPalette::LinkVisited);
  warnings_->setAlignment(Qt::AlignTop);
  auto* scroll = new QScrollArea(left);
  scroll->setWidget(warnings_);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setMaximumHeight(110);
  column->addWidget(scroll);
  return left;
}

QWidget* ImportSegyDialog::map_pane() {
  QWidget* middle = pane(this);
  auto* column = static_cast<QVBoxLayout*>(middle->layout());
  column->addWidget(caption(tr("Survey map"), middle));
  map_ = new SegyMapView(middle);
  column->addWidget(map_, 1);
  map_text_ = dim_label(middle);
  column->addWidget(map_text_);
  return middle;
}

QWidget* ImportSegyDialog::preview_pane() {
  QWidget* right = pane(this);
  auto* column = static_cast<QVBoxLayout*>(right->layout());
  column->addWidget(caption(tr("Preview"), right));
  line_ = new SegyLineView(right);
  text_ = new QPlainTextEdit(right);
  text_->setObjectName(QStringLiteral("text_header"));
  text_->setAccessibleName(tr("Text header"));
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text_->hide();
  column->addWidget(line_, 1);
  column->addWidget(text_, 1);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  turn_ = new QPushButton(tr("Inline"), right);
  turn_->setObjectName(QStringLiteral("turn"));
  turn_->setToolTip(tr("Preview an inline or a crossline"));
  turn_->setAutoDefault(false);
  line_slider_ = new QSlider(Qt::Horizontal, right);
  line_slider_->setObjectName(QStringLiteral("line"));
  line_slider_->setAccessibleName(tr("Line of the preview"));
  line_text_ = new QLabel(right);
  line_text_->setMinimumWidth(48);
  row->addWidget(turn_);
  row->addWidget(line_text_);
  row->addWidget(line_slider_, 1);
  auto* shows_text = new QPushButton(tr("Text header"), right);
  shows_text->setObjectName(QStringLiteral("shows_text"));
  shows_text->setToolTip(tr("What the file says of itself in words, instead of the preview"));
  shows_text->setCheckable(true);
  shows_text->setAutoDefault(false);
  row->addWidget(shows_text);
  connect(shows_text, &QPushButton::toggled, this, [this](bool on) {
    text_->setVisible(on);
    line_->setVisible(!on);
  });
  column->addLayout(row);
  connect(turn_, &QPushButton::clicked, this, [this] {
    of_inline_ = !of_inline_;
    looker_.show_line(of_inline_, std::nullopt);
  });
  connect(line_slider_, &QSlider::valueChanged, this, [this](int index) { choose_line(of_inline_, index); });
  return right;
}

QLayout* ImportSegyDialog::bottom_row() {
  auto* row = new QHBoxLayout;
  row->setContentsMargins(12, 8, 12, 12);
  row->setSpacing(8);
  message_ = dim_label(this);
  message_->setForegroundRole(QPalette::LinkVisited);
  progress_ = new QProgressBar(this);
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedSize(180, 6);
  cancel_ = new QPushButton(tr("Cancel"), this);
  cancel_->setAutoDefault(false);
  import_ = new QPushButton(tr("Import"), this);
  import_->setObjectName(QStringLiteral("import"));
  import_->setDefault(true);
  connect(cancel_, &QPushButton::clicked, this, &ImportSegyDialog::reject);
  connect(import_, &QPushButton::clicked, this, &ImportSegyDialog::import);
  row->addWidget(message_, 1);
  row->addWidget(progress_);
  row->addWidget(cancel_);
  row->addWidget(import_);
  return row;
}

QString ImportSegyDialog::unit() const {
  const SegyFields fields = form_->fields();
  return fields.unit ? QString::fromUtf8(survey::name_of(*fields.unit).data()) : QString();
}

void ImportSegyDialog::fields_changed(bool changes_look) {
  refusal_.clear();
  if (changes_look) {
    reading_ = true;
    pause_.start();
  }
  show_state();
}

void ImportSegyDialog::ask() {
  try {
    const segy::Options options = options_of(form_->fields());
    asked_ = looker_.look(options);
  } catch (const Error&) {
    reading_ = false;  // show_state() says what is wrong with the fields
  }
  show_state();
}

void ImportSegyDialog::show_look(std::shared_ptr<const SegyLook> look) {
  const bool same_file = look_ && look_->survey == look->survey;
  look_ = std::move(look);
  refusal_.clear();
  if (!same_file) {
    reading_ = pause_.isActive() || look_->request != asked_;
    show_findings();
  }
  map_->show_look(look_);
  line_->show_look(look_, unit());
  const segy::Inspection& found = look_->survey->found();
  const auto& axis = look_->line.of_inline ? found.inlines : found.crosslines;
  const QSignalBlocker block(line_slider_);
  line_slider_->setEnabled(axis.has_value());
  turn_->setEnabled(axis.has_value());
  if (axis) {
    line_slider_->setRange(0, static_cast<int>(axis->count - 1));
    line_slider_->setValue(static_cast<int>(axis->index_of(look_->line.line)));
    line_text_->setText(QString::number(look_->line.line));
  }
  turn_->setText(look_->line.of_inline ? tr("Inline") : tr("Crossline"));
  show_state();
  Q_EMIT looked();
}

void ImportSegyDialog::show_findings() {
  const segy::Inspection& found = look_->survey->found();
  const segy::Report& report = found.report;
  evidence_->setText(evidence_of(found));
  form_->show_found(report, found.geometry);
  QStringList words;
  for (const auto* header : {&report.text_header, &report.extended_text_header}) {
    for (const std::string& line : *header) words += QString::fromStdString(line);
  }
  if (const QString text = words.join(u'\n'); text_->toPlainText() != text) text_->setPlainText(text);
  candidates_->clear();
  for (std::size_t n = 0; n < found.candidates.size(); ++n) {
    const segy::LineCandidate& candidate = found.candidates[n];
    auto* item = new QListWidgetItem(evidence_of(candidate), candidates_);
    item->setData(Qt::UserRole, static_cast<uint>(n));
    item->setToolTip(item->text());
    if (candidate.inline_word == report.inline_word && candidate.crossline_word == report.crossline_word) {
      candidates_->setCurrentItem(item);
    }
  }
  QStringList lines;
  if (found.geometry) {
    for (const std::string& assumed : found.geometry->assumed) lines += QString::fromStdString(assumed);
  }
  for (const std::string& warning : report.warnings) lines += QString::fromStdString(warning);
  warnings_->setText(lines.join(QLatin1Char('\n')));

  if (!found.inlines) {
    map_text_->clear();
    return;
  }
  const auto count = [](std::int64_t number, const QString& one, const QString& many) {
    return QStringLiteral("%1 %2").arg(number).arg(number == 1 ? one : many);
  };
  QStringList counts{count(report.live_traces, tr("live trace"), tr("live traces")),
                     count(report.missing_bins, tr("hole"), tr("holes"))};
  QString duplicates = count(report.duplicates, tr("duplicate"), tr("duplicates"));
  if (report.duplicates > 0) {
    duplicates = QStringLiteral("<span style='color:%1'>%2</span>")
                     .arg(palette().color(QPalette::BrightText).name(), duplicates);
  }
  counts += duplicates;
  if (report.dead_traces > 0) counts += tr("%1 dead").arg(report.dead_traces);
  map_text_->setText(axis_text(tr("inline"), *found.inlines) + QStringLiteral(" · ") +
                     axis_text(tr("crossline"), *found.crosslines) + QStringLiteral("<br>") +
                     counts.join(QStringLiteral(" · ")));
}

void ImportSegyDialog::show_state() {
  const segy::SurveyLook* known = look_ && !reading_ ? look_->survey.get() : nullptr;
  QStringList missing =
      missing_of(form_->fields(), known, workbench_ != nullptr ? &workbench_->document.project() : nullptr);
  if (workbench_ != nullptr && workbench_->document.read_only())
    missing += tr("the project is open for reading only");
  if (project_ != nullptr && QFileInfo::exists(project_->text()))
    missing += tr("the new project exists already");
  if (!refusal_.isEmpty()) missing = QStringList(refusal_);
  missing.removeDuplicates();
  QString text = missing.join(QStringLiteral("; "));
  message_->setText(text.remove(file_ + QStringLiteral(": ")));  // the title names it
  const bool refused = known != nullptr && known->found().refusal;
  message_->setToolTip(refused ? QString::fromStdString(known->found().refusal->hint()) : QString());
  import_->setText(import_text(known));
  import_->setMinimumWidth(fontMetrics().horizontalAdvance(import_->text()) + 32);
  import_->setEnabled(missing.isEmpty() && job_ == 0);
  form_->setEnabled(job_ == 0);
  progress_->setVisible(reading_ || job_ != 0);
}

void ImportSegyDialog::choose_line(bool of_inline, std::int64_t index) {
  looker_.show_line(of_inline, index);
}

void ImportSegyDialog::import() {
  if (!can_import()) return;
  if (workbench_ == nullptr) {
    import_anew();
    return;
  }
  const SegyFields fields = form_->fields();
  survey::Geometry geometry = *look_->survey->found().geometry;
  geometry.crs = fields.crs.trimmed().toStdString();  // no look is needed for it
  try {
    const int job = import_segy(*workbench_, file_.toStdString(), options_of(fields), geometry,
                                fields.name.toStdString());
    Q_EMIT started(job);
    accept();
  } catch (const Error& error) {
    refusal_ = QString::fromStdString(error.message());
    show_state();
  }
}

void ImportSegyDialog::import_anew() {
  const SegyFields fields = form_->fields();
  job_ = import_segy_anew(jobs_, project_->text().toStdString(), file_.toStdString(), options_of(fields),
                          fields.name.toStdString(), {});
  progress_->setValue(0);
  show_state();
}

void ImportSegyDialog::reject() {
  if (job_ != 0) {
    jobs_.cancel(job_);  // the dialog stays until the file under way is gone
    return;
  }
  QDialog::reject();
}

}  // namespace footwall::ui
