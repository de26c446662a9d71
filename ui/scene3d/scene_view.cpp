#include "ui/scene3d/scene_view.h"

#include <QPalette>
#include <QResizeEvent>
#include <algorithm>
#include <cmath>

#include "storage/base/error.h"
#include "storage/base/log.h"
#include "ui/scene3d/mixed_colour.h"
#include "ui/scene3d/scene_private.h"

static void load_shaders() {
  Q_INIT_RESOURCE(scene_shaders);
}

namespace footwall::ui {
namespace {

using render::Vec3;

}  // namespace

SceneView::SceneView(Workbench& workbench, QWidget* parent)
    : GlWidget(parent), d_(std::make_unique<Private>(*this, workbench)) {
  load_shaders();
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(120, 90);
  setAccessibleName(tr("Scene"));
  Workbench& models = workbench;
  set_source(
      {[&models](Id fault) { return models.surfaces.surface(fault); },
       [&models](Id fault, const QString& name) { return models.shown_numbers.numbers(fault, name); },
       [&models](Id fault, const QString& name) { return models.shown_numbers.freshness(fault, name); },
       [&models](const std::set<Id>& faults, const QString& name) {
         return models.shown_numbers.range(faults, name);
       },
       [&models] { return models.surfaces.statistics(); },
       [&models](const PictureRequest& request) { return models.engine.draw(request); },
       [&models](QObject* asker, Id volume, const Section& section) {
         models.sections.ask(asker, volume, section);
       },
       [&models] { return models.engine.is_wanted() && models.engine.state() != EngineLink::State::kLost; }});
  d_->connect_models();
  d_->take_style();
  d_->drawing.camera.set_perspective(workbench.display.perspective());
  d_->sections_changed();
  d_->ask_for_voxels();
  d_->ask_for_shapes();
}

SceneView::~SceneView() {
  if (!d_->drawing.is_built()) return;
  make_current();
  d_->drawing.release();
  done_current();
}

void SceneView::set_source(SceneSource source) {
  d_->drawing.source = std::move(source);
  d_->asked.clear();
  d_->ask_for_samples();
  std::set<Id> all;
  for (const Fault& fault : d_->workbench.document.faults()) all.insert(fault.record.id);
  d_->drawing.surfaces_changed(all);
  d_->ask_for_voxels();
  d_->changed();
}

void SceneView::Private::take_style() {
  const QPalette palette = view.palette();
  const QColor window = palette.color(QPalette::Window);
  const bool dark = window.lightnessF() < 0.5F;
  SceneColours colours;
  colours.text = palette.color(QPalette::WindowText);
  colours.top = dark ? mixed(window, Qt::black, 0.12) : mixed(window, Qt::white, 0.6);
  colours.bottom = dark ? mixed(window, Qt::black, 0.32) : mixed(window, Qt::black, 0.03);
  colours.dim = mixed(colours.text, colours.bottom, 0.38);
  colours.line = mixed(colours.text, colours.bottom, 0.75);
  colours.accent = palette.color(QPalette::Highlight);
  colours.panel = dark ? mixed(window, Qt::white, 0.04) : QColor(Qt::white);
  QFont font = view.font();
  font.setPixelSize(12);
  drawing.set_style(colours, font, view.devicePixelRatioF());
}

void SceneView::Private::changed() {
  fine_timer.start();
  was_settled = false;
  soon_timer.stop();
  work_timer.start();
  view.update();
}

void SceneView::Private::changed_soon() {
  fine_timer.start();
  was_settled = false;
  if (!soon_timer.isActive()) soon_timer.start();
}

void SceneView::Private::camera_moved() {
  drawing.set_moving(true);
  drawing.camera_moved();
  rest_timer.start();
  changed();
  Q_EMIT view.camera_changed();
}

void SceneView::Private::do_work() {
  if (!drawing.is_built() || !view.isVisible()) return;
  if (drawing.has_work()) {
    const bool was_shown = drawing.has_front();
    const bool was_fine = drawing.is_fine();
    const std::uint64_t layers = drawing.counters.layers;
    view.make_current();
    bool more = false;
    QElapsedTimer clock;
    clock.start();
    try {
      more = drawing.work();
    } catch (const Error& error) {
      log::warn("the scene could not be drawn: " + error.message());
    }
    view.done_current();
    double& longest = drawing.counters.longest_slice_ms;
    longest = std::max(longest, static_cast<double>(clock.nsecsElapsed()) / 1e6);
    if (layers != drawing.counters.layers || was_shown != drawing.has_front() ||
        was_fine != drawing.is_fine())
      view.update();
    if (more) {
      work_timer.start();
      return;
    }
  }
  if (!was_settled && view.is_settled()) {
    was_settled = true;
    Q_EMIT view.settled();
  }
}

bool SceneView::is_settled() const {
  const Private& d = *d_;
  if (!problem().isEmpty()) return true;
  return d.drawing.is_built() && d.voxels.is_settled() && d.drawing.shape_share == 1 &&
         !d.rest_timer.isActive() && !d.fine_timer.isActive() && !d.soon_timer.isActive() &&
         !d.drawing.has_work();
}

QString SceneView::start_gl() {
  Private& d = *d_;
  if (!d.gl.initializeOpenGLFunctions()) {
    const QSurfaceFormat offered = QOpenGLContext::currentContext()->format();
    return tr("The scene needs OpenGL 4.5, and this screen offers %1.%2. Start with LIBGL_ALWAYS_SOFTWARE=1.")
        .arg(offered.majorVersion())
        .arg(offered.minorVersion());
  }
  try {
    d.drawing.build(d.gl);
  } catch (const Error& error) {
    return QString::fromStdString(error.message());
  }
  d.ask_for_samples();
  d.give_what_is_there();
  d.changed();
  return {};
}

void SceneView::resizeEvent(QResizeEvent* event) {
  Private& d = *d_;
  GlWidget::resizeEvent(event);
  const int width = event->size().width();
  const int height = event->size().height();
  d.drawing.set_view(QSizeF(width, height));
  d.take_style();
  if (!d.fitted && width > 20 && height > 20) {
    if (d.drawing.frame()) {
      const auto corners = d.drawing.frame()->corners();
      const Vec3 side = corners[1] - corners[0];
      d.drawing.camera.look_along(std::atan2(side.x, side.y) * 180 / M_PI);
    }
    d.drawing.camera.fit(QSizeF(width, height));
    d.fitted = true;
    d.placed = true;
  }
  d.camera_moved();
}

void SceneView::paint_gl(GLuint framebuffer) {
  Private& d = *d_;
  if (!d.drawing.is_built()) return;
  try {
    d.drawing.paint(framebuffer);
  } catch (const Error& error) {
    show_problem(QString::fromStdString(error.message()));
  }
  if (d.drawing.has_work() && !d.work_timer.isActive()) d.work_timer.start();
}

void SceneView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    d_->take_style();
    d_->drawing.camera_moved();
    d_->changed();
  }
  GlWidget::changeEvent(event);
}

void SceneView::fit() {
  d_->drawing.camera.fit(d_->size());
  d_->camera_moved();
}

void SceneView::frame_selection() {
  const Selection& selection = d_->workbench.selection;
  const Document& document = d_->workbench.document;
  std::vector<Vec3> places;
  const double heights = d_->drawing.heights();
  const auto add_pillar = [&](const survey::Pillar& pillar) {
    for (const survey::PillarNode& node : pillar.nodes) {
      const Vec3 p = d_->drawing.flat_of(node.position);
      places.push_back({p.x, p.y, p.z * heights});
    }
  };
  std::set<Id> faults = selection.faults();
  if (faults.empty() && selection.pillars().empty() && selection.active_fault() != 0)
    faults.insert(selection.active_fault());
  for (const Id id : faults) {
    if (document.fault(id) == nullptr) continue;
    for (const survey::Pillar& pillar : document.shown_pillars(id)) add_pillar(pillar);
  }
  for (const Id id : selection.pillars()) {
    if (const survey::Pillar* pillar = document.pillar(id)) add_pillar(*pillar);
  }
  if (places.size() < 2) return fit();
  d_->drawing.camera.fit(d_->size(), places);
  d_->camera_moved();
}

void SceneView::look(StandardView view) {
  d_->drawing.camera.look(view);
  fit();
}

const OrbitCamera& SceneView::camera() const {
  return d_->drawing.camera;
}

const SceneCounters& SceneView::counters() const {
  return d_->drawing.counters;
}

void SceneView::reset_counters() {
  d_->drawing.counters = {};
}

QString SceneView::camera_text() const {
  const std::array<double, 9> now = d_->camera_numbers();
  if (!d_->camera_words.isEmpty() && d_->numbers_of_words == now) return d_->camera_words;
  QStringList parts;
  for (std::size_t n = 0; n < now.size(); n += 3) {
    const auto number = [](double x) { return QString::number(x, 'g', QLocale::FloatingPointShortest); };
    parts << QStringLiteral("%1,%2,%3").arg(number(now[n]), number(now[n + 1]), number(now[n + 2]));
  }
  return parts.join(u';');
}

bool SceneView::has_camera() const {
  return d_->placed;
}

// Eye, target and up.
std::array<double, 9> SceneView::Private::camera_numbers() const {
  const Vec3 eye = drawing.camera.eye();
  const Vec3 up = drawing.camera.up();
  const Vec3& target = drawing.camera.target();
  return {eye.x, eye.y, eye.z, target.x, target.y, target.z, up.x, up.y, up.z};
}

bool SceneView::set_camera_text(const QString& text) {
  std::vector<Vec3> points;
  for (const QString& part : text.split(u';')) {
    const QStringList words = part.split(u',');
    if (words.size() != 3) return false;
    std::array<double, 3> numbers{};
    for (qsizetype n = 0; n < 3; ++n) {
      bool good = false;
      numbers[static_cast<std::size_t>(n)] = words[n].trimmed().toDouble(&good);
      if (!good || !std::isfinite(numbers[static_cast<std::size_t>(n)])) return false;
    }
    points.push_back({numbers[0], numbers[1], numbers[2]});
  }
  if (points.size() < 2 || points.size() > 3 || !d_->drawing.camera.place(points[0], points[1])) return false;
  // Straight down or up, the third point tells where the top of the picture is.
  const Vec3 view = points[1] - points[0];
  if (points.size() == 3 && std::hypot(view.x, view.y) <= 1e-9 * length(view)) {
    const double sign = view.z < 0 ? 1 : -1;
    d_->drawing.camera.set_direction(std::atan2(sign * points[2].x, sign * points[2].y) * 180 / M_PI,
                                     d_->drawing.camera.elevation());
  }
  d_->fitted = true;
  d_->placed = true;
  d_->camera_words = text;
  d_->numbers_of_words = d_->camera_numbers();
  d_->camera_moved();
  return true;
}

QImage SceneView::picture(const QSize& size, double scale, QString* problem) {
  constexpr int kLargest = 16384;
  problem->clear();
  if (!this->problem().isEmpty() || !d_->drawing.is_built()) {
    *problem = GlWidget::problem().isEmpty() ? tr("The scene has not been shown yet.") : GlWidget::problem();
    return {};
  }
  if (size.width() < 1 || size.height() < 1 || size.width() > kLargest || size.height() > kLargest ||
      !(scale > 0)) {
    *problem = tr("A picture has 1 to %1 pixels each way.").arg(kLargest);
    return {};
  }
  make_current();
  QImage image;
  try {
    image = d_->drawing.picture(size, scale);
  } catch (const Error& error) {
    *problem = QString::fromStdString(error.message());
  }
  done_current();
  d_->changed();
  return image;
}

bool SceneView::export_png(const QString& path, const QSize& size, double scale, QString* problem) {
  const QImage image = picture(size, scale, problem);
  if (image.isNull()) return false;
  if (image.save(path, "PNG")) return true;
  *problem = tr("%1 could not be written.").arg(path);
  return false;
}

}  // namespace footwall::ui
