// A widget that OpenGL draws into, on the screen by a window of its own.
//
// A QOpenGLWidget in a window makes Qt compose that whole window by OpenGL whenever any part of it is
// painted; on a processor that draws, one step of a mouse in another view then costs as much as a frame of
// the scene. Here the two go to the screen apart. The mouse and the keys are the widget's own: the inner
// window takes none.
#pragma once
#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QWidget>
#include <memory>

namespace footwall::ui {

class GlWidget : public QWidget {
  Q_OBJECT

 public:
  explicit GlWidget(QWidget* parent = nullptr);
  ~GlWidget() override;

  // A frame soon; several calls make one.
  void update();
  // The picture of now, drawn for this; null where there is no OpenGL.
  QImage grab_frame();
  // Why there is no OpenGL 4.5; empty where there is, or where it was not tried yet.
  QString problem() const { return problem_; }

 Q_SIGNALS:
  // A frame was handed to the screen.
  void frame_shown();

 protected:
  // Once, before the first frame; the context is current. What is in the way, or nothing.
  virtual QString start_gl() = 0;
  // The picture of now into the framebuffer; the context is current.
  virtual void paint_gl(GLuint framebuffer) = 0;

  // Between the two, OpenGL may be called. False where there is none.
  bool make_current();
  void done_current();
  void show_problem(const QString& problem);

  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Surface;

  bool start();
  void paint_frame();
  QSize device_size() const;

  std::unique_ptr<QOpenGLContext> context_;
  QOffscreenSurface nowhere_;  // for what is made before the window is on the screen
  Surface* surface_;           // the container's
  QWidget* container_;
  QString problem_;
  bool started_ = false, asked_ = false;
};

}  // namespace footwall::ui
