#include "ui/window/put_back.h"

#include <QCoreApplication>

#include "ui/model/project_tree.h"
#include "ui/window/banner.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("PutBack", text);
}

QString words_for(const ProjectTree::Removed& removed) {
  const std::size_t count = removed.isosurfaces.size() + removed.views.size();
  if (count > 1) return translated("%1 views and isosurfaces were deleted.").arg(count);
  if (removed.views.empty()) return translated("An isosurface was deleted.");
  return translated("The view %1 was deleted.").arg(QString::fromStdString(removed.views.front().name));
}

}  // namespace

void show_what_was_removed(MainWindow& window, ProjectTree& tree) {
  const QString key = QStringLiteral("removed");
  if (tree.removed().empty()) return window.banners().remove(key);
  window.banners().show_banner(
      key, {.text = words_for(tree.removed()),
            .buttons = {{translated("Put back"), [&tree] { tree.put_back(); }},
                        {translated("Dismiss"), [&window, key] { window.banners().remove(key); }}}});
}

}  // namespace footwall::ui
