#include "ui/model/workbench.h"

#include <QTest>

#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class WorkbenchTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void what_is_shown_is_stored_while_the_project_is_open();
};

void WorkbenchTest::what_is_shown_is_stored_while_the_project_is_open() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  bench.display.add_isosurface(bench.display.volume(), 1.25);
  // As another program would find the file if this one were killed now.
  const auto stored = [&] {
    const auto setting = sample.open(project::OpenMode::kRead).setting("studio.display");
    return setting && setting->find("1.25") != std::string::npos;
  };
  QTRY_VERIFY(stored());
}

static const RegisterTest<WorkbenchTest> kRegistered;

}  // namespace footwall::ui

#include "workbench_test.moc"
