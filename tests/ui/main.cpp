// Runs every test class that registered itself (test_class.h); exits with the number of failures.
#include <QApplication>
#include <QTest>

#include "ui/test_class.h"

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  application.setApplicationName(QStringLiteral("footwall-studio-test"));
  int failures = 0;
  for (const auto& make : footwall::ui::test_classes()) failures += QTest::qExec(make().get(), argc, argv);
  return failures == 0 && !footwall::ui::test_classes().empty() ? 0 : 1;
}
