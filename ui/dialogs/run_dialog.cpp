#include "ui/dialogs/run_dialog.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/dialogs/fault_box.h"

namespace footwall::ui {
namespace {

constexpr int kIsSelected = Qt::UserRole + 1;  // of the row that means the selected faults

QComboBox* box_of(const std::vector<RunChoices::Choice>& choices, const char* name, QWidget* parent) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QLatin1String(name));
  for (const RunChoices::Choice& choice : choices) {
    box->addItem(choice.name);
    box->setItemData(box->count() - 1, choice.help, Qt::ToolTipRole);
  }
  return box;
}

void fill(QFormLayout* form) {
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
}

}  // namespace

RunDialog::RunDialog(Workbench& workbench, QWidget* parent) : QDialog(parent), workbench_(workbench) {
  setWindowTitle(tr("Statistics of faults"));
  setMinimumWidth(380);
  const Document& document = workbench.document;
  volume_ = new QComboBox(this);
  volume_->setObjectName(QStringLiteral("volume"));
  for (const project::VolumeRecord& volume : document.volumes()) {
    volume_->addItem(QString::fromStdString(volume.name));
    if (volume.id == workbench.display.volume()) volume_->setCurrentIndex(volume_->count() - 1);
  }
  fault_ = fault_box(workbench, true, true, this);
  offer_selected();
  name_ = new QLineEdit(this);
  name_->setFocus();
  name_->setObjectName(QStringLiteral("name"));
  name_->setPlaceholderText(tr("run and its number"));

  auto* form = new QFormLayout;
  fill(form);
  form->addRow(tr("Volume"), volume_);
  form->addRow(tr("Faults"), fault_);
  form->addRow(tr("Name"), name_);
  more_ = new QToolButton(this);
  more_->setText(tr("Advanced"));
  more_->setCheckable(true);
  more_->setAutoRaise(true);
  more_->setArrowType(Qt::RightArrow);
  more_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  QWidget* choices = advanced();
  choices->hide();
  connect(more_, &QToolButton::toggled, this, [this, choices](bool open) {
    more_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    choices->setVisible(open);
    adjustSize();
  });
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  message_->setForegroundRole(QPalette::LinkVisited);
  auto* run = new QPushButton(tr("Run"), this);
  run->setObjectName(QStringLiteral("run"));
  run->setDefault(true);
  run->setEnabled(volume_->count() > 0 && !document.faults().empty() && !document.read_only());
  if (document.read_only()) {
    message_->setText(tr("the project is open for reading only"));
  } else if (volume_->count() == 0) {
    message_->setText(tr("import a volume first"));
  } else if (document.faults().empty()) {
    message_->setText(tr("pick a fault first"));
  }
  auto* cancel = new QPushButton(tr("Cancel"), this);
  cancel->setAutoDefault(false);
  connect(run, &QPushButton::clicked, this, &RunDialog::run);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addStretch(1);
  buttons->addWidget(cancel);
  buttons->addWidget(run);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addLayout(form);
  column->addWidget(more_);
  column->addWidget(choices);
  column->addStretch(1);
  column->addWidget(message_);
  column->addLayout(buttons);
}

void RunDialog::offer_selected() {
  const std::set<Id>& faults = workbench_.selection.faults();
  if (faults.size() < 2) return;
  selected_.assign(faults.begin(), faults.end());
  constexpr int kAfterAll = 1;
  fault_->insertItem(kAfterAll, tr("selected (%1)").arg(selected_.size()));
  fault_->setItemData(kAfterAll, true, kIsSelected);
  fault_->setCurrentIndex(kAfterAll);
}

QWidget* RunDialog::advanced() {
  auto* pane = new QWidget(this);
  auto* form = new QFormLayout(pane);
  fill(form);
  const RunChoices choices = run_choices();
  exchange_ = box_of(choices.exchanges, "exchange", pane);
  balance_ = box_of(choices.balances, "balance", pane);
  ranks_ = new QSpinBox(pane);
  ranks_->setObjectName(QStringLiteral("ranks"));
  ranks_->setRange(0, 4096);
  ranks_->setSpecialValueText(tr("as the engine has"));
  form->addRow(tr("Exchange"), exchange_);
  form->addRow(tr("Balance"), balance_);
  form->addRow(tr("Ranks"), ranks_);
  return pane;
}

tasks::ExtractOptions RunDialog::options() const {
  tasks::ExtractOptions options;
  options.volume = volume_->currentText().toStdString();
  options.fault = fault_->currentData().toString().toStdString();
  if (fault_->currentData(kIsSelected).toBool()) options.faults = selected_;
  options.name = name_->text().trimmed().toStdString();
  options.engine.exchange = exchange_->currentText().toStdString();
  options.engine.balance = balance_->currentText().toStdString();
  options.launch.ranks = ranks_->value();
  return options;
}

void RunDialog::run() {
  try {
    const int job = start_run(workbench_, options());
    Q_EMIT started(job);
    accept();
  } catch (const Error& error) {
    message_->setText(QString::fromStdString(error.hint().empty() ? error.message()
                                                                  : error.message() + ": " + error.hint()));
    adjustSize();  // a refusal may need several lines
  }
}

}  // namespace footwall::ui
