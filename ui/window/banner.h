// Lines above the views: for states that last (read-only, engine stopped), and for what just failed, which go
// by themselves. Never in the way of work.
#pragma once
#include <QWidget>
#include <functional>
#include <map>
#include <vector>

class QVBoxLayout;

namespace footwall::ui {

class BannerArea final : public QWidget {
  Q_OBJECT

 public:
  enum class Kind { kNotice, kWarning, kError };
  struct Button {
    QString text;
    std::function<void()> pressed;
  };
  struct Banner {
    Kind kind = Kind::kNotice;
    QString text;
    QString hint = {};  // how to mend it; may be empty
    std::vector<Button> buttons = {};
    bool passes = false;  // goes after a while, sooner by its cross
  };

  explicit BannerArea(QWidget* parent = nullptr);

  // Takes the place of the banner of the same key.
  void show_banner(const QString& key, const Banner& banner);
  void remove(const QString& key);
  void clear();
  bool has(const QString& key) const { return rows_.contains(key); }
  QString text(const QString& key) const;  // with its hint
  // Presses a button of a banner by its number; false where there is none.
  bool press(const QString& key, std::size_t button);

 private:
  struct Row {
    QWidget* widget = nullptr;
    Banner banner;
  };
  QVBoxLayout* column_ = nullptr;
  std::map<QString, Row> rows_;
};

}  // namespace footwall::ui
