#include "ui/dialogs/export_dialog.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QPointer>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <memory>
#include <utility>

#include "ui/dialogs/fault_box.h"

namespace footwall::ui {

using Kind = ExportChoice::Kind;

ExportDialog::ExportDialog(Workbench& workbench, WritePicture write_picture, QWidget* parent)
    : QDialog(parent), workbench_(workbench), write_picture_(std::move(write_picture)) {
  setWindowTitle(tr("Export"));
  setMinimumWidth(460);
  const Document& document = workbench.document;
  kind_ = new QComboBox(this);
  kind_->setObjectName(QStringLiteral("kind"));
  kind_->addItem(tr("Faces and statistics, table (CSV)"), static_cast<int>(Kind::kCsv));
  kind_->addItem(tr("Faces and statistics, ParaView (VTP)"), static_cast<int>(Kind::kVtp));
  kind_->addItem(tr("Meshes, GOCAD (TSurf)"), static_cast<int>(Kind::kTsurf));
  kind_->addItem(tr("Pillars, fault sticks"), static_cast<int>(Kind::kSticks));
  if (!document.volumes().empty()) {
    kind_->addItem(tr("Volume, SEG-Y"), static_cast<int>(Kind::kSegy));
    kind_->addItem(tr("Volume, ParaView (VTI)"), static_cast<int>(Kind::kVti));
    kind_->addItem(tr("Volume, NRRD"), static_cast<int>(Kind::kNrrd));
    kind_->addItem(tr("Volume, plain samples (float32)"), static_cast<int>(Kind::kRaw));
  }
  if (write_picture_) kind_->addItem(tr("Picture of the view (PNG)"), static_cast<int>(Kind::kPicture));
  fault_ = fault_box(workbench, true, false, this);
  run_ = new QComboBox(this);
  run_->setObjectName(QStringLiteral("run"));
  run_->addItem(tr("the last run"));
  for (const project::RunRecord& run : document.project().runs()) {
    run_->addItem(QString::fromStdString(run.name), static_cast<qlonglong>(run.id));
  }
  volume_ = new QComboBox(this);
  volume_->setObjectName(QStringLiteral("volume"));
  for (const project::VolumeRecord& volume : document.volumes()) {
    volume_->addItem(QString::fromStdString(volume.name));
    if (volume.id == workbench.display.volume()) volume_->setCurrentIndex(volume_->count() - 1);
  }
  stick_format_ = new QComboBox(this);
  stick_format_->setObjectName(QStringLiteral("stick_format"));
  stick_format_->addItems(stick_format_names());
  stick_format_->setCurrentText(QString::fromStdString(ExportChoice().stick_format));
  interpolated_ = new QCheckBox(tr("interpolated pillars too"), this);
  const QFileInfo project(QString::fromStdString(document.project().path().string()));
  file_ = new QLineEdit(
      project.absolutePath() + QLatin1Char('/') + project.completeBaseName() + QStringLiteral(".csv"), this);
  file_->setObjectName(QStringLiteral("file"));
  auto* browse = new QPushButton(tr("…"), this);
  browse->setAutoDefault(false);
  browse->setToolTip(tr("Choose the file"));
  browse->setFixedWidth(32);
  auto* file_row = new QHBoxLayout;
  file_row->setSpacing(4);
  file_row->addWidget(file_, 1);
  file_row->addWidget(browse);

  auto* form = new QFormLayout;
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->addRow(tr("What"), kind_);
  form->addRow(tr("Faults"), fault_);
  form->addRow(tr("Statistics"), run_);
  form->addRow(tr("Volume"), volume_);
  form->addRow(tr("Stick format"), stick_format_);
  form->addRow(QString(), interpolated_);
  form->addRow(tr("File"), file_row);
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  message_->setMinimumHeight(fontMetrics().height() * 2);
  export_ = new QPushButton(tr("Export"), this);
  export_->setObjectName(QStringLiteral("export"));
  export_->setDefault(true);
  close_ = new QPushButton(tr("Close"), this);
  close_->setAutoDefault(false);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addStretch(1);
  buttons->addWidget(close_);
  buttons->addWidget(export_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addLayout(form);
  column->addWidget(message_);
  column->addStretch(1);
  column->addLayout(buttons);
  connect(kind_, &QComboBox::currentIndexChanged, this, &ExportDialog::kind_changed);
  connect(browse, &QPushButton::clicked, this, &ExportDialog::browse);
  connect(export_, &QPushButton::clicked, this, &ExportDialog::export_chosen);
  connect(close_, &QPushButton::clicked, this, &QDialog::reject);
  connect(&workbench.jobs, &Jobs::finished, this,
          [this](int job, Jobs::State state, const QString& message, const QString& hint) {
            if (job != job_) return;
            job_ = 0;
            export_->setEnabled(true);
            if (state == Jobs::State::kDone) return;
            say(hint.isEmpty() ? message : message + QStringLiteral(": ") + hint, QPalette::BrightText);
          });
  kind_changed();
}

ExportChoice ExportDialog::choice() const {
  ExportChoice choice;
  choice.kind = static_cast<Kind>(kind_->currentData().toInt());
  choice.file = file_->text();
  choice.fault = fault_->currentData().toString().toStdString();
  if (run_->currentData().isValid()) choice.run = run_->currentData().toLongLong();
  choice.volume = volume_->currentText().toStdString();
  choice.stick_format = stick_format_->currentText().toStdString();
  choice.interpolated = interpolated_->isChecked();
  return choice;
}

void ExportDialog::choose(ExportChoice::Kind kind) {
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(kind)));
}

void ExportDialog::kind_changed() {
  const ExportChoice now = choice();
  const bool sticks = now.kind == Kind::kSticks;
  const bool volume = is_volume(now.kind);
  const bool faces = !sticks && !volume && now.kind != Kind::kPicture;
  fault_->setEnabled(sticks || faces);
  run_->setEnabled(faces);
  volume_->setEnabled(volume);
  stick_format_->setEnabled(sticks);
  interpolated_->setEnabled(sticks);
  file_->setText(with_suffix(file_->text(), now));
  message_->clear();
}

void ExportDialog::browse() {
  const ExportChoice now = choice();
  const QString file = QFileDialog::getSaveFileName(this, tr("Export to"), now.file,
                                                    QStringLiteral("*%1").arg(suffix_of(now)));
  if (!file.isEmpty()) file_->setText(file);
}

void ExportDialog::say(const QString& text, QPalette::ColorRole role) {
  message_->setForegroundRole(role);
  message_->setText(text);
}

void ExportDialog::export_chosen() {
  const ExportChoice now = choice();
  try {
    const auto write = prepare_export(workbench_.document.project(), now, write_picture_);
    auto done = std::make_shared<Exported>();
    const QPointer<ExportDialog> dialog = this;
    say(tr("writing …"), QPalette::PlaceholderText);
    export_->setEnabled(false);
    job_ = workbench_.jobs.start(
        tr("Export %1").arg(QFileInfo(now.file).fileName()),
        [write, done](const JobContext& job) { *done = write(job); },
        [dialog, done, file = now.file] {
          if (!dialog) return;
          dialog->say((QStringList(done->text) + done->notices).join(QLatin1Char('\n')),
                      QPalette::WindowText);
          Q_EMIT dialog->exported(file);
        });
  } catch (const Error& error) {
    const QString message = QString::fromStdString(error.message());
    const QString hint = QString::fromStdString(error.hint());
    say(hint.isEmpty() ? message : message + QStringLiteral(": ") + hint, QPalette::BrightText);
  }
}

}  // namespace footwall::ui
