#include "ui/window/views.h"

#include <QWidget>

#include "ui/scene3d/scene_view.h"
#include "ui/section/section_view.h"
#include "ui/window/actions.h"
#include "ui/window/main_window.h"

namespace footwall::ui {

ViewFactories built_views() {
  ViewFactories views;
  views.section = [](Workbench& workbench, Id section, QWidget* parent) -> QWidget* {
    auto* view = new SectionView(workbench, section, parent);
    QObject::connect(view, &SectionView::import_wanted, view, [view] {
      auto* window = qobject_cast<MainWindow*>(view->window());
      if (window != nullptr) window->actions().action(QStringLiteral("file.import"))->trigger();
    });
    return view;
  };
  views.scene = [](Workbench& workbench, QWidget* parent) -> QWidget* {
    return new SceneView(workbench, parent);
  };
  views.section_look = [](const QWidget& section) { return static_cast<const SectionView&>(section).look(); };
  views.set_section_look = [](QWidget& section, const QJsonObject& look) {
    static_cast<SectionView&>(section).set_look(look);
  };
  views.camera = [](const QWidget& scene) {
    const auto& view = static_cast<const SceneView&>(scene);
    return view.has_camera() ? view.camera_text() : QString();
  };
  views.set_camera = [](QWidget& scene, const QString& camera) {
    return static_cast<SceneView&>(scene).set_camera_text(camera);
  };
  // A view from the north looks south.
  views.look_from = [](QWidget& scene, ViewFactories::From side) {
    using From = ViewFactories::From;
    const std::map<From, StandardView> views_of{
        {From::kTop, StandardView::kTop},   {From::kNorth, StandardView::kSouth},
        {From::kEast, StandardView::kWest}, {From::kSouth, StandardView::kNorth},
        {From::kWest, StandardView::kEast}, {From::kOblique, StandardView::kOblique}};
    static_cast<SceneView&>(scene).look(views_of.at(side));
  };
  views.write_picture = [](QWidget& scene, const QString& path, int width) {
    const double scale = static_cast<double>(width) / std::max(1, scene.width());
    QString problem;
    const QSize size(width, static_cast<int>(std::lround(scene.height() * scale)));
    const bool done = static_cast<SceneView&>(scene).export_png(path, size, scale, &problem);
    return done ? QString() : problem.isEmpty() ? QObject::tr("cannot write %1").arg(path) : problem;
  };
  views.is_settled = [](const QWidget& scene) { return static_cast<const SceneView&>(scene).is_settled(); };
  return views;
}

}  // namespace footwall::ui
