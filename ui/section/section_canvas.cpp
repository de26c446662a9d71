#include "ui/section/section_canvas.h"

#include <QApplication>
#include <QPaintEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "storage/base/error.h"
#include "ui/section/axes.h"
#include "ui/section/sample_image.h"

namespace footwall::ui {
namespace {

constexpr int kLeft = 52, kTop = 24, kRight = 10, kBottom = 26;
constexpr int kLeastForName = 640;  // pixels of the strip that holds scale, name and colours
constexpr int kLateMilliseconds = 200;
constexpr double kEndRadius = 4;  // of a line that is drawn

QColor faded(QColor colour, double alpha) {
  colour.setAlphaF(alpha);
  return colour;
}

}  // namespace

SectionCanvas::SectionCanvas(Workbench& bench, Id shown, QWidget* parent)
    : QWidget(parent), bench_(bench), shown_(shown), shapes_(bench) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(160, 72);  // four of them fit a column of a small screen
  setAccessibleName(tr("Section"));
  button_ = new QPushButton(this);
  button_->setFocusPolicy(Qt::TabFocus);
  button_->hide();
  connect(button_, &QPushButton::clicked, this, [this] {
    if (failure_.isEmpty()) {
      Q_EMIT import_wanted();
    } else {
      ask();
    }
  });
  late_.setSingleShot(true);
  late_.setInterval(kLateMilliseconds);
  connect(&late_, &QTimer::timeout, this, [this] {
    is_late_ = true;
    redraw_base();
  });
  connect_models();
  take_survey();
}

void SectionCanvas::connect_models() {
  const auto overlay = [this] { update(); };
  const auto still = [this] { redraw_still(); };
  connect(&bench_.display, &Display::sections_changed, this, &SectionCanvas::follow_display);
  connect(&bench_.display, &Display::samples_changed, this, [this] {
    redraw_base();
    ask();
  });
  connect(&bench_.display, &Display::visibility_changed, this, still);
  connect(&bench_.display, &Display::scene_changed, this, still);
  connect(&bench_.display, &Display::cursor_moved, this, overlay);
  connect(&bench_.display, &Display::place_shown, this,
          [this](const survey::IndexPoint& place, double reach) { show_place(place, reach); });
  connect(&bench_.display, &Display::linked_view_moved, this, &SectionCanvas::follow_linked);
  connect(&bench_.line, &LineDrawing::changed, this, [this] {
    show_pointer_shape();
    update();
  });
  connect(&bench_.selection, &Selection::changed, this, still);
  connect(&bench_.selection, &Selection::active_fault_changed, this, still);
  connect(&bench_.selection, &Selection::hover_changed, this, overlay);
  connect(&bench_.document, &Document::survey_changed, this, &SectionCanvas::take_survey);
  connect(&bench_.document, &Document::volumes_changed, this, [this] {
    samples_.reset();
    ask();
  });
  connect(&bench_.document, &Document::faults_changed, this, still);
  connect(&bench_.document, &Document::shapes_changed, this, [this](const std::set<Id>& faults) {
    shapes_.forget(faults);
    // While they move they are no part of the layer.
    const bool only_moving = std::ranges::all_of(faults, [this](Id fault) {
      return bench_.document.is_provisional(fault) && still_without_.contains(fault);
    });
    if (only_moving) {
      update();
    } else {
      redraw_still();
    }
  });
  connect(&bench_.surfaces, &Surfaces::surfaces_changed, this, [this](const std::set<Id>& faults) {
    const auto stands_still = [this](Id fault) {
      return !still_without_.contains(fault) && shapes_.has_other_surface(fault) &&
             bench_.display.is_visible({.kind = Item::Kind::kFault, .id = fault});
    };
    if (std::ranges::any_of(faults, stands_still)) {
      redraw_still();
    } else {
      update();
    }
  });
  connect(&bench_.sections, &SectionReader::ready, this,
          [this](QObject* asker, const std::shared_ptr<const SectionSamples>& samples) {
            if (asker == this) take_samples(samples);
          });
  connect(&bench_.sections, &SectionReader::failed, this,
          [this](QObject* asker, const QString& message, const QString& hint) {
            if (asker != this) return;
            late_.stop();
            samples_.reset();
            failure_ = message;
            failure_hint_ = hint;
            redraw_base();
            show_message();
          });
  connect(&bench_.picking, &Picking::stroke_changed, this, overlay);
  connect(&bench_.picking, &Picking::hint_changed, this, &SectionCanvas::show_pointer_shape);
  connect(&bench_.picking, &Picking::tool_changed, this, &SectionCanvas::show_pointer_shape);
}

void SectionCanvas::take_survey() {
  velocity_ = 0;
  try {
    const auto stored = bench_.document.project().setting("velocity");
    if (stored) velocity_ = QString::fromStdString(*stored).toDouble();
  } catch (const Error& error) {
    Q_EMIT bench_.document.failed(QString::fromStdString(error.message()),
                                  QString::fromStdString(error.hint()));
  }
  follow_display();
  if (bench_.document.survey()) {
    view_.set_frame(frame_of(section_, *bench_.document.survey(), velocity_));
    view_.fit();
  }
  ask();
  redraw_base();
}

void SectionCanvas::follow_display() {
  const auto& sections = bench_.display.sections();
  const auto found = std::ranges::find(sections, shown_, &Display::ShownSection::id);
  const bool existed = std::exchange(exists_, found != sections.end());
  if (!exists_) {
    if (existed) {
      samples_.reset();
      redraw_base();
      show_message();
    }
    return;
  }
  if (std::exchange(linked_, found->linked) != found->linked) update();
  if (existed && found->section == section_) return;
  section_ = found->section;
  shapes_.set_section(section_);
  if (bench_.document.survey()) view_.set_frame(frame_of(section_, *bench_.document.survey(), velocity_));
  redraw_base();
  ask();
  Q_EMIT view_changed();
}

void SectionCanvas::ask() {
  failure_.clear();
  failure_hint_.clear();
  is_late_ = false;
  const Id volume = bench_.display.volume();
  if (exists_ && bench_.document.survey() && volume != 0) {
    late_.start();
    bench_.sections.ask(this, volume, section_);
  } else {
    late_.stop();
    samples_.reset();
    redraw_base();
  }
  show_message();
}

void SectionCanvas::take_samples(std::shared_ptr<const SectionSamples> samples) {
  // An earlier request's: another answer is on its way.
  if (samples->section != section_ || samples->volume != bench_.display.volume()) return;
  late_.stop();
  is_late_ = false;
  failure_.clear();
  failure_hint_.clear();
  samples_ = std::move(samples);
  redraw_base();
  show_message();
}

QString SectionCanvas::message() const {
  if (!exists_) return tr("This section was closed.");
  if (!bench_.document.survey() || bench_.display.volume() == 0) return tr("No volume yet");
  if (!failure_.isEmpty())
    return failure_ + (failure_hint_.isEmpty() ? QString() : QStringLiteral("\n") + failure_hint_);
  return {};
}

void SectionCanvas::show_message() {
  const bool wants_import = exists_ && (!bench_.document.survey() || bench_.display.volume() == 0);
  const bool failed = exists_ && !failure_.isEmpty();
  button_->setText(failed ? tr("Try again") : tr("Import SEG-Y..."));
  button_->setVisible(wants_import || failed);
  button_->adjustSize();
  button_->move((width() - button_->width()) / 2, height() / 2 + 26);
}

void SectionCanvas::lay_out() {
  view_.set_area(
      QRectF(kLeft, kTop, std::max(1, width() - kLeft - kRight), std::max(1, height() - kTop - kBottom)));
}

void SectionCanvas::redraw_base() {
  base_is_old_ = true;
  redraw_still();
}

void SectionCanvas::redraw_still() {
  still_is_old_ = true;
  update();
}

void SectionCanvas::fit(bool true_proportions) {
  view_.fit(true_proportions);
  view_moved();
}

bool SectionCanvas::show_part(const ShownPart& part) {
  if (!view_.show_part(part)) return false;
  redraw_base();
  Q_EMIT view_changed();
  return true;
}

// By the user: linked sections do the same.
void SectionCanvas::view_moved() {
  redraw_base();
  Q_EMIT view_changed();
  if (!linked_ || !exists_) return;
  const ShownPart part = view_.part();
  bench_.display.show_linked({.by = shown_,
                              .kind = section_.kind,
                              .fits = part.fits,
                              .true_proportions = part.true_proportions,
                              .centre = part.centre,
                              .height = view_.area().height() / view_.pixels_per_v(),
                              .stretch = part.stretch});
}

// Lines go different ways: with each other they share heights alone.
void SectionCanvas::follow_linked(const Display::LinkedView& other) {
  if (!linked_ || !exists_ || other.by == shown_ || !bench_.document.survey()) return;
  const bool both_vertical = section_.kind != Section::Kind::kSlice && other.kind != Section::Kind::kSlice;
  const bool same_kind = section_.kind == other.kind && section_.kind != Section::Kind::kLine;
  if (!same_kind && !both_vertical) return;
  if (other.fits) {
    view_.fit(other.true_proportions);
  } else if (same_kind) {
    view_.show_around(other.centre, other.height, other.stretch);
  } else {
    view_.show_heights(other.centre.v, other.height);
  }
  redraw_base();
  Q_EMIT view_changed();
}

bool SectionCanvas::draws_line() const {
  return bench_.line.is_active() && section_.kind == Section::Kind::kSlice && message().isEmpty();
}

void SectionCanvas::step(std::int64_t lines) {
  if (!exists_ || !bench_.document.survey()) return;
  bench_.display.move_section(shown_, stepped(section_, lines, *bench_.document.survey()));
}

void SectionCanvas::frame_selection() {
  const Selection& selection = bench_.selection;
  std::optional<std::pair<PlanePoint, PlanePoint>> box;
  const auto take = [&](const PlanePoint& p) {
    if (!box) box = {p, p};
    box->first = {std::min(box->first.u, p.u), std::min(box->first.v, p.v)};
    box->second = {std::max(box->second.u, p.u), std::max(box->second.v, p.v)};
  };
  for (const Fault& fault : bench_.document.faults()) {
    const bool whole = selection.faults().contains(fault.record.id);
    const ShapedFault& shape = shapes_.of(fault.record.id);
    for (const ShapedPillar& pillar : shape.pillars) {
      for (const ShapedNode& node : pillar.nodes) {
        const bool near = std::abs(node.distance) <= bench_.display.fade_distance();
        if ((whole && near) || selection.pillars().contains(pillar.id) ||
            selection.nodes().contains(node.id)) {
          take(node.at);
        }
      }
    }
    if (!whole) continue;
    for (const CutSegment& segment : shape.cut) {
      take(segment[0]);
      take(segment[1]);
    }
  }
  if (!box) return;
  view_.show(box->first, box->second);
  view_moved();
}

void SectionCanvas::show_place(const survey::IndexPoint& place, double reach) {
  if (!exists_ || !linked_ || !bench_.document.survey()) return;
  const PlanePoint middle = plane_of(section_, place);
  view_.show({middle.u - reach, middle.v - reach}, {middle.u + reach, middle.v + reach});
  redraw_base();
  Q_EMIT view_changed();
}

std::set<Id> SectionCanvas::moving_faults() const {
  std::set<Id> moving;
  for (const Fault& fault : bench_.document.faults()) {
    if (bench_.document.is_provisional(fault.record.id)) moving.insert(fault.record.id);
  }
  return moving;
}

FaultDrawing SectionCanvas::drawing_of(const Fault& fault) const {
  FaultDrawing how;
  how.colour = QColor(QString::fromStdString(fault.record.colour));
  if (!how.colour.isValid()) how.colour = palette().color(QPalette::WindowText);
  how.accent = palette().color(QPalette::Highlight);
  how.outline = QColor(20, 22, 26);  // on samples, which no theme changes
  how.active = Qt::white;
  how.is_active = bench_.selection.active_fault() == fault.record.id;
  how.fade_distance = bench_.display.fade_distance();
  const Item& current = bench_.selection.current();
  if (current.kind == Item::Kind::kFace && current.id == fault.record.id) how.face = current;
  return how;
}

void SectionCanvas::make_base() {
  base_is_old_ = false;
  ++base_redraws_;
  const double ratio = devicePixelRatioF();
  base_ = QPixmap(size() * ratio);
  base_.setDevicePixelRatio(ratio);
  base_.fill(palette().color(QPalette::Window));
  QPainter painter(&base_);
  painter.setFont(font());
  const auto& survey = bench_.document.survey();
  const QString text = message();
  const QColor dim = palette().color(QPalette::PlaceholderText);
  if (!text.isEmpty() || !survey) {
    painter.setPen(dim);
    painter.drawText(QRectF(16, 0, width() - 32, height() / 2.0 + 14),
                     Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap, text);
    return;
  }
  const QColor ground = palette().color(QPalette::Base);
  painter.fillRect(view_.area(), ground);
  const SampleColours colours(bench_.display.samples(), bench_.sections.facts(bench_.display.volume()));
  const bool right_ones = samples_ && samples_->section == section_;
  if (samples_ && samples_->section.kind == section_.kind && (right_ones || !is_late_)) {
    const SampleLook& look = bench_.display.samples();
    const QRgb nothing = ground.rgb();
    if (look.wiggle && section_.kind != Section::Kind::kSlice) {
      draw_wiggles(painter, *samples_, colours, view_, palette().color(QPalette::WindowText));
    } else {
      painter.drawImage(view_.area().topLeft(), sample_image(*samples_, colours, view_, ratio,
                                                             interpolates(look, view_, ratio), nothing));
    }
  } else if (is_late_) {
    painter.setPen(dim);
    painter.drawText(view_.area(), Qt::AlignCenter, tr("Reading %1 ...").arg(title_of(section_, *survey)));
  }
  const AxisColours ink{palette().color(QPalette::WindowText), dim, palette().color(QPalette::Mid),
                        faded(palette().color(QPalette::WindowText), 0.10)};
  painter.setClipRect(rect());
  QFont small = font();
  small.setPixelSize(std::max(9, QFontInfo(font()).pixelSize() - 2));
  painter.setFont(small);
  const AxisScale u = u_axis(section_, *survey);
  draw_axes(painter, rect(), view_, u, v_axis(section_, *survey), ink);
  const QRectF strip(kLeft, height() - kBottom, width() - kLeft - kRight, kBottom);
  const auto& volumes = bench_.document.volumes();
  const auto volume = std::ranges::find(volumes, bench_.display.volume(), &project::VolumeRecord::id);
  const bool wiggles = bench_.display.samples().wiggle && section_.kind != Section::Kind::kSlice;
  draw_scale(painter, strip, view_, samples_ ? &colours : nullptr, polarity_of(colours, wiggles),
             volume == volumes.end() ? QString() : QString::fromStdString(volume->name), ink);
  if (strip.width() > kLeastForName) painter.drawText(strip, Qt::AlignCenter, u.name);
}

void SectionCanvas::make_still() {
  if (base_is_old_) make_base();
  still_is_old_ = false;
  ++still_redraws_;
  still_ = base_;
  still_without_ = moving_faults();
  if (!message().isEmpty()) return;
  QPainter painter(&still_);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(view_.area());
  const Id active = bench_.selection.active_fault();
  for (const bool last : {false, true}) {  // the active one on top
    for (const Fault& fault : bench_.document.faults()) {
      const Id id = fault.record.id;
      if ((id == active) != last || still_without_.contains(id)) continue;
      if (!bench_.display.is_visible({.kind = Item::Kind::kFault, .id = id})) continue;
      draw_fault(painter, shapes_.of(id), view_, drawing_of(fault), bench_.selection.pillars(),
                 bench_.selection.nodes());
    }
  }
}

void SectionCanvas::draw_moving(QPainter& painter) {
  const Item& hovered = bench_.selection.hovered();
  const Fault* owner = hovered.kind == Item::Kind::kNode     ? bench_.document.fault_of_node(hovered.id)
                       : hovered.kind == Item::Kind::kPillar ? bench_.document.fault_of_pillar(hovered.id)
                       : hovered.kind == Item::Kind::kFault || hovered.kind == Item::Kind::kFace
                           ? bench_.document.fault(hovered.id)
                           : nullptr;
  for (const Fault& fault : bench_.document.faults()) {
    const Id id = fault.record.id;
    const bool moves = still_without_.contains(id);
    if ((!moves && owner != &fault) || !bench_.display.is_visible({.kind = Item::Kind::kFault, .id = id}))
      continue;
    const ShapedFault& shape = shapes_.of(id);
    const FaultDrawing how = drawing_of(fault);
    if (moves) draw_fault(painter, shape, view_, how, bench_.selection.pillars(), bench_.selection.nodes());
    if (owner == &fault) draw_hovered(painter, shape, hovered, view_, how);
  }
  if (stroke_here_ && bench_.picking.stroke().size() > 1) {
    QPolygonF line;
    for (const survey::IndexPoint& p : bench_.picking.stroke())
      line << view_.to_pixels(plane_of(section_, p));
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(line);
  }
}

void SectionCanvas::draw_cursor(QPainter& painter) const {
  const auto& cursor = bench_.display.cursor();
  if (!cursor || !(linked_ || mouse_inside_)) return;
  const QPointF at = view_.to_pixels(plane_of(section_, *cursor));
  const QRectF& area = view_.area();
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(faded(palette().color(QPalette::Highlight), 0.55), 1));
  const double x = std::floor(at.x()) + 0.5, y = std::floor(at.y()) + 0.5;
  if (x > area.left() && x < area.right())
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  if (y > area.top() && y < area.bottom())
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  painter.setRenderHint(QPainter::Antialiasing);
}

void SectionCanvas::draw_selecting(QPainter& painter) const {
  if (selecting_.size() < 2) return;
  const QColor accent = palette().color(QPalette::Highlight);
  painter.setPen(QPen(accent, 1, Qt::DashLine));
  painter.setBrush(faded(accent, 0.12));
  painter.drawPolygon(selecting_);
}

void SectionCanvas::draw_line_under_way(QPainter& painter) const {
  if (!draws_line() || !bench_.line.first()) return;
  const QPointF first = view_.to_pixels(plane_of(section_, *bench_.line.first()));
  const QColor accent = palette().color(QPalette::Highlight);
  painter.setPen(QPen(accent, 2, Qt::DashLine));
  if (const auto& cursor = bench_.display.cursor())
    painter.drawLine(first, view_.to_pixels(plane_of(section_, *cursor)));
  painter.setPen(Qt::NoPen);
  painter.setBrush(accent);
  painter.drawEllipse(first, kEndRadius, kEndRadius);
}

void SectionCanvas::draw_jump(QPainter& painter) const {
  if (jump_.isEmpty() || !bench_.document.survey()) return;
  const survey::Geometry& survey = *bench_.document.survey();
  const AxisScale v = v_axis({.kind = Section::Kind::kInline}, survey);
  const QString name = section_.kind == Section::Kind::kInline      ? tr("Inline %1")
                       : section_.kind == Section::Kind::kCrossline ? tr("Crossline %1")
                                                                    : QStringLiteral("%1 ") + v.unit;
  const QString text = tr("Go to %1  -  Enter").arg(name.arg(jump_));
  const QFontMetricsF metrics(font());
  QRectF box(0, 0, metrics.horizontalAdvance(text) + 24, metrics.height() + 14);
  box.moveCenter(QPointF(view_.area().center().x(), view_.area().top() + 30));
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1));
  painter.setBrush(palette().color(QPalette::Window));
  painter.drawRoundedRect(box, 4, 4);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(box, Qt::AlignCenter, text);
}

void SectionCanvas::paintEvent(QPaintEvent* event) {
  if (still_is_old_ || still_.deviceIndependentSize().toSize() != size()) make_still();
  QPainter painter(this);
  painter.setClipRegion(event->region());
  painter.drawPixmap(0, 0, still_);
  if (!message().isEmpty()) return;
  painter.setFont(font());
  painter.setClipRect(view_.area().intersected(QRectF(event->rect())));
  painter.setRenderHint(QPainter::Antialiasing);
  draw_cursor(painter);
  draw_moving(painter);
  draw_selecting(painter);
  draw_line_under_way(painter);
  draw_jump(painter);
}

void SectionCanvas::resizeEvent(QResizeEvent*) {
  lay_out();
  redraw_base();
  show_message();
  Q_EMIT view_changed();
}

void SectionCanvas::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange ||
      event->type() == QEvent::StyleChange) {
    redraw_base();
  }
  QWidget::changeEvent(event);
}

}  // namespace footwall::ui
