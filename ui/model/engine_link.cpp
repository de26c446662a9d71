#include "ui/model/engine_link.h"

#include <QPointer>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "storage/base/error.h"
#include "ui/model/live_colours.h"
#include "ui/model/picture_thread.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct EngineLink::Private {
  Document& document;
  State state = State::kOff;
  QString text;
  bool wanted = false;
  Id volume = 0;
  std::uint64_t answered = 0;
  QDateTime answered_at = {};
  // Last: their threads end before the rest goes.
  std::unique_ptr<LiveColours> colours = {};
  std::unique_ptr<PictureThread> pictures = {};

  std::optional<EngineVolume> engine_volume(Id id) const {
    const auto found = std::ranges::find(document.volumes(), id, &project::VolumeRecord::id);
    if (found == document.volumes().end()) return std::nullopt;
    return EngineVolume{found->checksum,
                        std::filesystem::absolute(document.project().volume_path(*found)).string()};
  }
};

EngineLink::EngineLink(Document& document, const Options& options, QObject* parent)
    : QObject(parent), private_(std::make_unique<Private>(document)) {
  std::optional<service::Connection> connection;
  if (!options.connection.isEmpty()) connection = service::connection_from(options.connection.toStdString());
  const auto here = [this](auto f) { QMetaObject::invokeMethod(this, std::move(f), Qt::QueuedConnection); };
  const auto fail = [this, here](const std::string& message, const std::string& hint) {
    here([this, message = QString::fromStdString(message), hint = QString::fromStdString(hint)] {
      Q_EMIT failed(message, hint);
    });
  };
  LiveColours::Events events;
  events.state = [this, here](State state, const std::string& text) {
    here([this, state, text = QString::fromStdString(text)] {
      private_->state = state;
      private_->text = text;
      if (state == State::kReady) private_->pictures->engine_came();
      Q_EMIT state_changed();
    });
  };
  events.numbers = [this, here](EngineNumbers numbers) {
    here([this, numbers = std::move(numbers)] {
      private_->answered = std::max(private_->answered, numbers.edit);
      if (!numbers.faults.empty()) private_->answered_at = QDateTime::currentDateTime();
      Q_EMIT this->numbers(numbers);
    });
  };
  events.failed = fail;
  private_->colours = std::make_unique<LiveColours>(std::move(connection), options.ranks, std::move(events));
  PictureThread::Events drawing;
  drawing.connection = [this] { return private_->colours->connection(); };
  drawing.picture = [this, here](std::shared_ptr<const Picture> made) {
    here([this, made = std::move(made)] { Q_EMIT picture(made); });
  };
  drawing.failed = fail;
  private_->pictures = std::make_unique<PictureThread>(std::move(drawing));
  if (!document.volumes().empty()) set_volume(document.volumes().front().id);
}

EngineLink::~EngineLink() {
  private_->pictures.reset();
  private_->colours.reset();
}

EngineLink::State EngineLink::state() const {
  return private_->state;
}

QString EngineLink::state_text() const {
  switch (private_->state) {
    case State::kOff:
      return tr("off");
    case State::kStarting:
      return tr("starts");
    case State::kReady:
    case State::kBusy:
      return private_->text;
    case State::kLost:
      break;
  }
  return tr("stopped: %1").arg(private_->text);
}

int EngineLink::ranks() const {
  const bool runs = private_->state == State::kReady || private_->state == State::kBusy;
  return runs ? private_->text.section(QLatin1Char(' '), 0, 0).toInt() : 0;
}

std::optional<service::Connection> EngineLink::connection() const {
  return private_->colours->connection();
}

bool EngineLink::is_wanted() const {
  return private_->wanted;
}

void EngineLink::start() {
  private_->wanted = true;
  private_->colours->start();
}

void EngineLink::stop() {
  private_->wanted = false;
  private_->colours->stop();
}

void EngineLink::set_volume(Id volume) {
  const Id before = std::exchange(private_->volume, volume);
  private_->colours->set_volume(private_->engine_volume(volume));
  if (before != 0 && before != volume) Q_EMIT volume_changed();
}

Id EngineLink::volume() const {
  return private_->volume;
}

std::uint64_t EngineLink::answered() const {
  return private_->answered;
}

QDateTime EngineLink::answered_at() const {
  return private_->answered_at;
}

std::uint64_t EngineLink::put_fault(const std::shared_ptr<const FaultSurface>& surface) {
  return private_->colours->put(surface);
}

std::uint64_t EngineLink::remove_fault(Id fault) {
  return private_->colours->remove(fault);
}

std::uint64_t EngineLink::draw(const PictureRequest& request) {
  std::vector<EngineVolume> volumes;
  for (const PictureRequest::Isosurface& one : request.isosurfaces) {
    const auto volume = private_->engine_volume(one.volume);
    if (!volume) return 0;
    volumes.push_back(*volume);
  }
  return private_->pictures->draw(request, std::move(volumes));
}

}  // namespace footwall::ui
