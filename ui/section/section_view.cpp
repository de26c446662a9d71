#include "ui/section/section_view.h"

#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

namespace footwall::ui {

SectionView::SectionView(Workbench& bench, Id section_of_display, QWidget* parent)
    : QWidget(parent), bench_(bench), shown_(section_of_display) {
  canvas_ = new SectionCanvas(bench, section_of_display, this);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setFocusPolicy(Qt::NoFocus);  // X and Z step as well
  slider_->setAccessibleName(tr("Section number"));
  slider_->setToolTip(tr("Which section is shown: X and Z step, digits and Enter jump"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(canvas_, 1);
  layout->addWidget(slider_);
  setFocusProxy(canvas_);
  connect(slider_, &QSlider::valueChanged, this, [this](int index) {
    Section moved = canvas_->section();
    moved.index = index;
    bench_.display.move_section(shown_, moved);
  });
  connect(canvas_, &SectionCanvas::import_wanted, this, &SectionView::import_wanted);
  connect(&bench_.display, &Display::sections_changed, this, &SectionView::follow_display);
  connect(&bench_.document, &Document::survey_changed, this, &SectionView::follow_display);
  connect(&bench_.display, &Display::samples_changed, this, &SectionView::details_changed);
  connect(&bench_.document, &Document::volumes_changed, this, &SectionView::details_changed);
  follow_display();
}

QString SectionView::details() const {
  const auto& volumes = bench_.document.volumes();
  const auto volume = std::ranges::find(volumes, bench_.display.volume(), &project::VolumeRecord::id);
  return volume == volumes.end() ? QString() : QString::fromStdString(volume->name);
}

QJsonObject SectionView::look() const {
  const ShownPart part = canvas_->view().part();
  if (part.fits) return part.true_proportions ? QJsonObject{{"true_proportions", true}} : QJsonObject();
  return {{"u", part.centre.u},
          {"v", part.centre.v},
          {"pixels_per_metre", part.pixels_per_metre},
          {"stretch", part.stretch}};
}

void SectionView::set_look(const QJsonObject& look) {
  canvas_->show_part({.fits = !look.contains(QStringLiteral("pixels_per_metre")),
                      .true_proportions = look["true_proportions"].toBool(),
                      .centre = {look["u"].toDouble(), look["v"].toDouble()},
                      .pixels_per_metre = look["pixels_per_metre"].toDouble(),
                      .stretch = look["stretch"].toDouble()});
}

void SectionView::follow_display() {
  const auto& sections = bench_.display.sections();
  const auto found = std::ranges::find(sections, shown_, &Display::ShownSection::id);
  const bool steps =
      found != sections.end() && found->section.kind != Section::Kind::kLine && bench_.document.survey();
  slider_->setVisible(steps);
  if (!steps) return;
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, static_cast<int>(last_index(found->section, *bench_.document.survey())));
  slider_->setPageStep(10);
  slider_->setValue(static_cast<int>(found->section.index));
}

}  // namespace footwall::ui
