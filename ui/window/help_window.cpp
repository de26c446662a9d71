#include "ui/window/help_window.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QTextTable>
#include <QVBoxLayout>

#include "ui/window/actions.h"

namespace footwall::ui {
namespace {

constexpr double kMargin = 20;
constexpr int kPictureWidth = 780;  // of pictures that are wider

// Room between paragraphs, and more above headings; tables stay tight.
void space_out(QTextDocument& document) {
  constexpr double kParagraph = 5, kHeading = 16;
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    QTextCursor cursor(block);
    if (cursor.currentTable() != nullptr) continue;
    QTextBlockFormat format = block.blockFormat();
    format.setTopMargin(format.headingLevel() > 0 ? kHeading : kParagraph);
    format.setBottomMargin(kParagraph);
    cursor.setBlockFormat(format);
  }
}

// Pictures no wider than the window is at first.
class GuideBrowser final : public QTextBrowser {
 public:
  using QTextBrowser::QTextBrowser;
  QVariant loadResource(int type, const QUrl& name) override {
    const QVariant found = QTextBrowser::loadResource(type, name);
    if (type != QTextDocument::ImageResource) return found;
    const QImage image = found.typeId() == QMetaType::QByteArray ? QImage::fromData(found.toByteArray())
                                                                 : found.value<QImage>();
    if (image.width() <= kPictureWidth) return image;
    return image.scaledToWidth(kPictureWidth, Qt::SmoothTransformation);
  }
};

}  // namespace

QString guide_path() {
  const QDir program(QCoreApplication::applicationDirPath());
  for (const QString& path : {program.filePath(QStringLiteral(FOOTWALL_INSTALLED_DOCS "/docs/studio.md")),
                              QStringLiteral(FOOTWALL_SOURCE_DOCS "/studio.md")}) {
    if (QFileInfo::exists(path)) return QDir::cleanPath(path);
  }
  return {};
}

QString shortcut_list(const Actions& actions) {
  QString text;
  const ActionRow* before = nullptr;
  for (const ActionRow& row : actions.table()) {
    const QAction* action = actions.action(QString::fromLatin1(row.id));
    if (before == nullptr || before->menu != row.menu) {
      text += QStringLiteral("\n## %1\n\n| %2 | %3 | %4 |\n|---|---|---|\n")
                  .arg(title_of(row.menu).remove(QLatin1Char('&')), HelpWindow::tr("Action"),
                       HelpWindow::tr("Keys"), HelpWindow::tr("What it does"));
    }
    before = &row;
    QStringList keys;
    for (const QKeySequence& key : action->shortcuts()) keys.append(key.toString(QKeySequence::NativeText));
    text += QStringLiteral("| **%1** | %2 | %3 |\n")
                .arg(action->text().remove(QLatin1Char('&')), keys.join(QStringLiteral(", ")),
                     action->statusTip());
  }
  return text;
}

HelpWindow::HelpWindow(QWidget* parent) : QDialog(parent) {
  resize(860, 720);
  browser_ = new GuideBrowser(this);
  browser_->setOpenExternalLinks(false);
  browser_->setFrameShape(QFrame::NoFrame);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(browser_);
}

void HelpWindow::show_guide() {
  const QString path = guide_path();
  QFile file(path);
  if (path.isEmpty() || !file.open(QIODevice::ReadOnly)) {
    return show_text(tr("Guide"),
                     tr("# Footwall Studio\n\nThe guide, docs/studio.md, was not installed with this "
                        "program. Help > Shortcuts lists all that the window can do."));
  }
  browser_->setSearchPaths({QFileInfo(path).absolutePath()});
  show_text(tr("Guide"), QString::fromUtf8(file.readAll()));
}

void HelpWindow::show_text(const QString& title, const QString& markdown) {
  setWindowTitle(tr("%1 - Footwall Studio").arg(title));
  browser_->setMarkdown(markdown);
  browser_->document()->setDocumentMargin(kMargin);
  for (QTextFrame* frame : browser_->document()->rootFrame()->childFrames()) {
    auto* table = qobject_cast<QTextTable*>(frame);
    if (table == nullptr) continue;
    QTextTableFormat plain = table->format();
    plain.setBorder(0);
    plain.setCellPadding(3);
    plain.setCellSpacing(0);
    table->setFormat(plain);
  }
  space_out(*browser_->document());
  show();
  raise();
  activateWindow();
}

}  // namespace footwall::ui
