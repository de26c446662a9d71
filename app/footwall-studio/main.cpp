// footwall-studio: the desktop editor.
#include <CLI/CLI.hpp>
#include <QApplication>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "storage/base/error.h"
#include "ui/window/banner.h"
#include "ui/window/main_window.h"
#include "ui/window/theme.h"

namespace {

using footwall::Error;
using footwall::ErrorCode;

struct Options {
  std::string project, engine, theme, screenshot;
  int ranks = 0;
};

constexpr int kPollMs = 50;
constexpr int kSettleMs = 120'000;
constexpr int kWidth = 1600, kHeight = 1000;

int fail(const Error& error) {
  std::fprintf(stderr, "footwall-studio: %s\n", error.what());
  return 1;
}

// Qt ends the program with SIGABRT where it finds no display; say so instead.
void tell(QtMsgType type, const QMessageLogContext&, const QString& text) {
  std::fprintf(stderr, "footwall-studio: %s\n", text.toLocal8Bit().constData());
  if (type == QtFatalMsg) std::_Exit(1);
}

void check_display() {
  const QByteArray platform = qgetenv("QT_QPA_PLATFORM");
  const bool needs_one = platform.isEmpty() || platform.startsWith("xcb") || platform.startsWith("wayland");
  if (!needs_one || qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY"))
    return;
  throw Error(
      ErrorCode::kUsage, "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set",
      "log in to a desktop, use ssh -X, or run it under xvfb-run; footwall does everything without windows");
}

// Takes the picture once everything shown has arrived, then ends the program.
void take_picture_when_settled(footwall::ui::MainWindow& window, const QString& path) {
  auto* timer = new QTimer(&window);
  auto* since = new QElapsedTimer;
  since->start();
  QObject::connect(timer, &QTimer::timeout, &window, [&window, timer, since, path, settled = 0]() mutable {
    settled = window.is_settled() ? settled + 1 : 0;
    const bool late = since->elapsed() > kSettleMs;
    if (settled < 4 && !late) return;  // what has just arrived is painted first
    timer->stop();
    delete since;
    int status = 0;
    if (late) status = fail(Error(ErrorCode::kInternal, "the window was not complete after two minutes"));
    if (!window.grab().save(path, "PNG")) {
      status = fail(
          Error(ErrorCode::kIo, "cannot write " + path.toStdString(), "is the folder there, and not full?"));
    }
    window.close();
    QApplication::exit(status);
  });
  timer->start(kPollMs);
}

int run(QApplication& application, const Options& options) {
  using footwall::ui::Theme;
  if (!options.project.empty() && !QFileInfo::exists(QString::fromStdString(options.project))) {
    throw Error(ErrorCode::kNotFound, "there is no file " + options.project, "footwall new makes a project");
  }
  if (!options.theme.empty()) {
    footwall::ui::apply_theme(options.theme == "light" ? Theme::kLight : Theme::kDark);
  } else {
    footwall::ui::apply_theme(footwall::ui::remembered_theme());
  }
  footwall::ui::MainWindow window(
      {.ranks = options.ranks, .connection = QString::fromStdString(options.engine), .starts_at_once = true});
  window.resize(kWidth, kHeight);
  window.show();
  if (!options.project.empty()) window.take_file(QString::fromStdString(options.project));
  if (!options.screenshot.empty()) {
    if (!options.project.empty() && window.workbench() == nullptr) {
      return fail(Error(ErrorCode::kInvalid, window.banners().text(QStringLiteral("failure")).toStdString()));
    }
    take_picture_when_settled(window, QString::fromStdString(options.screenshot));
  }
  return application.exec();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App program("The desktop editor of Footwall: sections, a 3D scene, picking of faults",
                   "footwall-studio");
  program.set_version_flag("--version", "footwall-studio " FOOTWALL_VERSION);
  program.add_option("project", options.project,
                     "The project to open, NAME.footwall (default: the start page)");
  program.add_option(
      "--engine", options.engine,
      "Use an engine that runs already: its address, or @FILE that names it (default: starts one)");
  program
      .add_option("--ranks", options.ranks, "Ranks of the engine that it starts (default: half the cores)")
      ->check(CLI::Range(1, 1024));
  program.add_option("--theme", options.theme, "dark or light (default: as the last time)")
      ->check(CLI::IsMember({"dark", "light"}));
  program.add_option("--screenshot", options.screenshot,
                     "Write a picture of the window as PNG once everything has arrived, and end");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& wrong) {
    std::fprintf(stderr, "footwall-studio: %s\n  --help shows the options\n", wrong.what());
    return 2;
  }
  try {
    check_display();
    qInstallMessageHandler(tell);
    QApplication::setOrganizationName(QStringLiteral("Footwall"));
    QApplication::setApplicationName(QStringLiteral("footwall-studio"));
    QApplication::setApplicationVersion(QStringLiteral(FOOTWALL_VERSION));
    QApplication::setDesktopFileName(QStringLiteral("footwall-studio"));
    QApplication application(argc, argv);
    return run(application, options);
  } catch (const Error& error) {
    return fail(error);
  } catch (const std::exception& error) {
    return fail(Error(ErrorCode::kInternal, error.what(), "this is a bug of Footwall: please report it"));
  }
}
