#include "ui/scene3d/gl_widget.h"

#include <QBackingStore>
#include <QCoreApplication>
#include <QEvent>
#include <QOpenGLFramebufferObject>
#include <QPainter>
#include <QWindow>

namespace footwall::ui {
namespace {

const auto kFrame = static_cast<QEvent::Type>(QEvent::registerEventType());

QSurfaceFormat wanted_format() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

}  // namespace

class GlWidget::Surface final : public QWindow {
 public:
  explicit Surface(GlWidget& owner) : owner_(owner) {
    setSurfaceType(QSurface::OpenGLSurface);
    setFormat(wanted_format());
    setFlag(Qt::WindowTransparentForInput);
  }

 protected:
  void exposeEvent(QExposeEvent*) override {
    if (isExposed()) owner_.paint_frame();
  }

 private:
  GlWidget& owner_;
};

GlWidget::GlWidget(QWidget* parent)
    : QWidget(parent),
      surface_(new Surface(*this)),
      container_(QWidget::createWindowContainer(surface_, this)) {
  container_->setAttribute(Qt::WA_TransparentForMouseEvents);
  container_->setFocusPolicy(Qt::NoFocus);
}

GlWidget::~GlWidget() = default;

void GlWidget::update() {
  if (!problem_.isEmpty()) return QWidget::update();
  if (std::exchange(asked_, true)) return;
  QCoreApplication::postEvent(this, new QEvent(kFrame), Qt::LowEventPriority);
}

QSize GlWidget::device_size() const {
  return (QSizeF(size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
}

bool GlWidget::start() {
  if (std::exchange(started_, true)) return problem_.isEmpty();
  nowhere_.setFormat(wanted_format());
  nowhere_.create();
  context_ = std::make_unique<QOpenGLContext>();
  context_->setFormat(wanted_format());
  if (!context_->create()) {
    show_problem(tr("The scene needs OpenGL 4.5, and this screen offers none."));
    return false;
  }
  if (!make_current()) {
    show_problem(tr("The scene's OpenGL could not be started."));
    return false;
  }
  show_problem(start_gl());
  done_current();
  return problem_.isEmpty();
}

void GlWidget::show_problem(const QString& problem) {
  problem_ = problem;
  container_->setVisible(problem.isEmpty());
  if (!problem.isEmpty()) QWidget::update();
}

bool GlWidget::make_current() {
  if (context_ == nullptr) return false;
  return surface_->isExposed() ? context_->makeCurrent(surface_) : context_->makeCurrent(&nowhere_);
}

void GlWidget::done_current() {
  if (context_ != nullptr) context_->doneCurrent();
}

void GlWidget::paint_frame() {
  if (!surface_->isExposed() || !start() || !context_->makeCurrent(surface_)) return;
  paint_gl(context_->defaultFramebufferObject());
  context_->swapBuffers(surface_);
  context_->doneCurrent();
  Q_EMIT frame_shown();
}

QImage GlWidget::grab_frame() {
  if (!start() || !make_current()) return {};
  QImage image;
  {
    QOpenGLFramebufferObject target(device_size());
    paint_gl(target.handle());
    image = target.toImage().convertToFormat(QImage::Format_RGB32);
  }
  done_current();
  image.setDevicePixelRatio(devicePixelRatioF());
  return image;
}

bool GlWidget::event(QEvent* event) {
  if (event->type() == kFrame) {
    asked_ = false;
    paint_frame();
    return true;
  }
  return QWidget::event(event);
}

// What the inner window covers is painted only for a picture of the widget.
void GlWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!problem_.isEmpty()) {
    painter.fillRect(rect(), palette().color(QPalette::Window));
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap, problem_);
    return;
  }
  QPoint off;
  QBackingStore* screen = window()->backingStore();
  if (screen != nullptr && redirected(&off) == screen->paintDevice()) return;
  painter.drawImage(rect(), grab_frame());
}

void GlWidget::resizeEvent(QResizeEvent* event) {
  container_->setGeometry(rect());
  QWidget::resizeEvent(event);
}

}  // namespace footwall::ui
