#include "ui/model/picture_thread.h"

#include <QtEndian>
#include <cstring>
#include <utility>

#include "engine/service/client/engine_client.h"
#include "storage/base/error.h"

namespace footwall::ui {
namespace {

// `bytes` must unpack to exactly `size`.
QByteArray unpacked(const std::string& bytes, qsizetype size) {
  QByteArray framed(4, '\0');  // qUncompress() wants the size in front
  qToBigEndian(static_cast<quint32>(size), framed.data());
  framed.append(bytes.data(), static_cast<qsizetype>(bytes.size()));
  QByteArray plain = qUncompress(framed);
  if (plain.size() == size) return plain;
  throw Error(ErrorCode::kFormat, "the engine sent a tile that cannot be unpacked",
              "are engine and editor of one version?");
}

v1::RenderRequest message_of(const PictureRequest& wanted, const std::vector<std::string>& volumes) {
  v1::RenderRequest request;
  v1::Camera& camera = *request.mutable_camera();
  camera.mutable_view_projection()->Assign(wanted.view_projection.begin(), wanted.view_projection.end());
  camera.mutable_eye()->Assign(wanted.eye.begin(), wanted.eye.end());
  camera.mutable_right()->Assign(wanted.right.begin(), wanted.right.end());
  camera.mutable_up()->Assign(wanted.up.begin(), wanted.up.end());
  camera.mutable_forward()->Assign(wanted.forward.begin(), wanted.forward.end());
  camera.set_perspective(wanted.perspective);
  request.set_width(wanted.width);
  request.set_height(wanted.height);
  for (std::size_t n = 0; n < wanted.isosurfaces.size(); ++n) {
    const PictureRequest::Isosurface& one = wanted.isosurfaces[n];
    v1::DrawnIsosurface& drawn = *request.add_isosurfaces();
    drawn.set_volume(volumes[n]);
    drawn.set_value(one.value);
    drawn.set_colour(0xff000000U | static_cast<std::uint32_t>(qBlue(one.colour)) << 16 |
                     static_cast<std::uint32_t>(qGreen(one.colour)) << 8 |
                     static_cast<std::uint32_t>(qRed(one.colour)));
    drawn.mutable_placement()->mutable_linear()->Assign(one.linear.begin(), one.linear.end());
    drawn.mutable_placement()->mutable_shift()->Assign(one.shift.begin(), one.shift.end());
  }
  request.mutable_visible()->set_mode("depth");
  request.mutable_visible()->set_every_pass(true);
  return request;
}

// A picture that tiles are put into.
class Canvas {
 public:
  Canvas(int width, int height)
      : colours_(width, height, QImage::Format_RGBA8888),
        depths_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0F) {
    colours_.fill(Qt::transparent);
  }
  void put(const v1::Tile& tile) {
    const int width = colours_.width();
    if (tile.first_row() < 0 || tile.rows() < 0 || tile.rows() > colours_.height() - tile.first_row()) {
      throw Error(ErrorCode::kFormat, "the engine sent a tile that lies beside the picture");
    }
    const qsizetype pixels = static_cast<qsizetype>(width) * tile.rows();
    const QByteArray colours = unpacked(tile.colours(), pixels * 4);
    const QByteArray depths = unpacked(tile.depths(), pixels * 4);
    for (int row = 0; row < tile.rows(); ++row) {
      std::memcpy(colours_.scanLine(tile.first_row() + row), colours.constData() + qsizetype{4} * width * row,
                  static_cast<std::size_t>(width) * 4);
    }
    if (pixels == 0) return;
    std::memcpy(depths_.data() + static_cast<std::size_t>(tile.first_row()) * static_cast<std::size_t>(width),
                depths.constData(), static_cast<std::size_t>(pixels) * 4);
  }
  std::shared_ptr<const Picture> picture(std::uint64_t request, bool last) const {
    auto picture = std::make_shared<Picture>();
    picture->request = request;
    picture->colours = colours_.copy();
    picture->depths = depths_;
    picture->last = last;
    return picture;
  }

 private:
  QImage colours_;
  std::vector<float> depths_;
};

}  // namespace

PictureThread::PictureThread(Events events) : events_(std::move(events)), thread_([this] { work(); }) {}

PictureThread::~PictureThread() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    job_.cancel();
  }
  wake_.notify_all();
  thread_.join();
}

std::uint64_t PictureThread::draw(const PictureRequest& request, std::vector<EngineVolume> volumes) {
  std::uint64_t number = 0;
  {
    const std::scoped_lock lock(mutex_);
    number = ++last_;
    wanted_ = Wanted{number, request, std::move(volumes)};
    without_engine_.reset();
    job_.cancel();
  }
  wake_.notify_all();
  return number;
}

void PictureThread::engine_came() {
  {
    const std::scoped_lock lock(mutex_);
    if (!without_engine_ || wanted_) return;
    wanted_ = std::exchange(without_engine_, std::nullopt);
  }
  wake_.notify_all();
}

void PictureThread::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || wanted_.has_value(); });
    if (ends_) return;
    const Wanted wanted = *std::exchange(wanted_, std::nullopt);
    job_ = JobContext();
    const JobContext job = job_;
    lock.unlock();
    try {
      make(wanted, job);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kCancelled) events_.failed(error.message(), error.hint());
    }
  }
}

void PictureThread::make(const Wanted& wanted, const JobContext& job) {
  auto connection = events_.connection();
  if (!connection) {
    const std::scoped_lock lock(mutex_);
    if (wanted_) return;  // a newer one
    // It may have come since the question, and engine_came() been called already.
    connection = events_.connection();
    if (!connection) {
      without_engine_ = wanted;
      return;
    }
  }
  service::EngineClient client(*connection);
  std::vector<std::string> volumes;
  for (const EngineVolume& volume : wanted.volumes) {
    v1::VolumeName name;
    name.set_checksum(volume.checksum);
    name.set_path(volume.path);
    volumes.push_back(client.open_volume(name, job).volume());
  }
  Canvas canvas(wanted.request.width, wanted.request.height);
  client.render(
      message_of(wanted.request, volumes),
      [&](const v1::RenderReply& reply) {
        if (reply.has_tile()) canvas.put(reply.tile());
        if (reply.has_pass()) events_.picture(canvas.picture(wanted.number, false));
      },
      job);
  events_.picture(canvas.picture(wanted.number, true));
}

}  // namespace footwall::ui
