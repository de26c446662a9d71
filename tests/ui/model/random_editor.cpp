// An editor without a window that is made to be killed (kill_test.py): it edits at random, and says after
// each finished gesture, unbuffered, what the interpretation is then.
//   random_editor new PROJECT        makes a project with some faults
//   random_editor edit PROJECT SEED  "NUMBER DIGEST" a line, without end; the same for the same seed and
//   project random_editor look PROJECT       opens it for writing, as after a crash; its digest where it is
//   whole, else why not
#include <fmt/format.h>

#include <QCoreApplication>
#include <QRegularExpression>
#include <cstdio>
#include <span>
#include <string>

#include "storage/base/hash.h"
#include "ui/crowded_project.h"
#include "ui/interpretation_text.h"
#include "ui/random_hand.h"

namespace {

using namespace footwall;
using namespace footwall::ui;

// Without the times of day, which differ from run to run.
std::string digest(const std::filesystem::path& path) {
  static const QRegularExpression time(QStringLiteral("'[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z'"));
  const std::string text =
      QString::fromStdString(interpretation_text(path)).replace(time, QStringLiteral("''")).toStdString();
  return fmt::format("{:016x}", hash64(std::as_bytes(std::span(text))));
}

void say(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void make(const std::filesystem::path& path) {
  tasks::new_synthetic_project(path, "faulted", {48, 40, 64}, 1, 20, {});
  project::Project project = project::Project::open(path, project::OpenMode::kWrite);
  interpolate_samples(project, 6);
}

[[noreturn]] void edit(const std::filesystem::path& path, unsigned seed) {
  Document document(project::Project::open(path, project::OpenMode::kWrite));
  Selection selection(document);
  footwall::ui::Display display(document);
  Picking picking(document, selection, display);
  RandomHand hand(document, selection, picking, seed);
  int number = 0;
  say(fmt::format("{} {}", number, digest(path)));
  QObject::connect(&document, &Document::history_changed,
                   [&] { say(fmt::format("{} {}", ++number, digest(path))); });
  for (;;) hand.act();
}

int look(const std::filesystem::path& path) {
  const project::Project project = project::Project::open(path, project::OpenMode::kWrite);
  const project::IntegrityReport report = project.check();
  for (const std::string& problem : report.problems) fmt::print(stderr, "{}\n", problem);
  if (report.ok()) say(digest(path));
  return report.ok() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  const std::string command = argc > 2 ? argv[1] : "";
  try {
    if (command == "new") return make(argv[2]), 0;
    if (command == "edit" && argc > 3) edit(argv[2], static_cast<unsigned>(std::stoul(argv[3])));
    if (command == "look") return look(argv[2]);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.message());
    return 1;
  }
  fmt::print(stderr, "random_editor new|edit|look PROJECT [SEED]\n");
  return 2;
}
