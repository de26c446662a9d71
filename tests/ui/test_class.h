// A test class tells main.cpp about itself: static const RegisterTest<MyTest> registered;
#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <vector>

namespace footwall::ui {

using MakeTest = std::function<std::unique_ptr<QObject>()>;

inline std::vector<MakeTest>& test_classes() {
  static std::vector<MakeTest> all;
  return all;
}

template <class Test>
struct RegisterTest {
  RegisterTest() {
    test_classes().push_back([] { return std::make_unique<Test>(); });
  }
};

}  // namespace footwall::ui
