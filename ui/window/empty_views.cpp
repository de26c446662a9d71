#include "ui/window/empty_views.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/window/theme.h"

namespace footwall::ui {

EmptyViews::EmptyViews(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* text = new QLabel(tr("All views are closed. Open one:"), this);
  text->setAlignment(Qt::AlignCenter);
  text->setForegroundRole(QPalette::PlaceholderText);
  inline_ = add_button(tr("Inline"), "inline", "view.inline");
  crossline_ = add_button(tr("Crossline"), "crossline", "view.crossline");
  import_ = add_button(tr("Import SEG-Y..."), "import", "file.import");
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addStretch(1);
  for (QPushButton* button :
       {inline_, crossline_, import_, add_button(tr("3D scene"), "scene", "view.scene")})
    row->addWidget(button);
  row->addStretch(1);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(12);
  column->addStretch(1);
  column->addWidget(text);
  column->addLayout(row);
  column->addStretch(1);
  connect(&workbench_.document, &Document::survey_changed, this, &EmptyViews::follow_survey);
  follow_survey();
}

QPushButton* EmptyViews::add_button(const QString& text, const char* icon_name, const char* action) {
  const QString id = QString::fromLatin1(action);
  auto* button = new QPushButton(icon(QString::fromLatin1(icon_name)), text, this);
  button->setObjectName(id);
  connect(button, &QPushButton::clicked, this, [this, id] { Q_EMIT action_asked(id); });
  return button;
}

void EmptyViews::follow_survey() {
  const bool there = workbench_.document.survey().has_value();
  inline_->setVisible(there);
  crossline_->setVisible(there);
  import_->setVisible(!there);
}

}  // namespace footwall::ui
