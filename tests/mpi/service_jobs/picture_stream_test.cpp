#include "engine/service/resident/jobs/picture_stream.h"

#include <nlohmann/json.hpp>

#include "mpi/service_jobs/small_volume.h"

namespace footwall::service {
namespace {

constexpr int kWidth = 90;
constexpr int kHeight = 600;

class PictureStreamTest : public SmallVolume {
 protected:
  v1::RenderRequest request_of(std::vector<float> isovalues) {
    const std::array<render::Vec3, 8> corners = [&] {
      std::array<render::Vec3, 8> all;
      for (std::size_t n = 0; n < 8; ++n) {
        const auto at = [&](std::size_t axis) {
          return (n >> axis & 1) != 0 ? static_cast<double>(session::kSmallDims[axis] - 1) : 0.0;
        };
        all[n] = {at(0), at(1), at(2)};
      }
      return all;
    }();
    const auto camera = render::Camera::look(30, 25, 1, corners, double{kWidth} / kHeight, true);
    v1::RenderRequest request;
    for (const double each : camera.view_projection) request.mutable_camera()->add_view_projection(each);
    const auto add = [](const render::Vec3& v, auto* to) {
      for (const double each : {v.x, v.y, v.z}) to->Add(each);
    };
    add(camera.eye, request.mutable_camera()->mutable_eye());
    add(camera.right, request.mutable_camera()->mutable_right());
    add(camera.up, request.mutable_camera()->mutable_up());
    add(camera.forward, request.mutable_camera()->mutable_forward());
    request.mutable_camera()->set_perspective(true);
    request.set_width(kWidth);
    request.set_height(kHeight);
    for (const float value : isovalues) {
      v1::DrawnIsosurface& surface = *request.add_isosurfaces();
      surface.set_volume(checksum);
      surface.set_value(value);
      surface.set_colour(value > 500 ? 0xff2060c0U : 0xffc06020U);
      for (int n = 0; n < 9; ++n) surface.mutable_placement()->add_linear(n % 4 == 0 ? 1 : 0);
      for (int n = 0; n < 3; ++n) surface.mutable_placement()->add_shift(0);
    }
    return request;
  }

  struct Picture {
    std::vector<float> depths = std::vector<float>(std::size_t{kWidth} * kHeight, 1.0F);
    std::vector<render::Rgba> colours = std::vector<render::Rgba>(std::size_t{kWidth} * kHeight, 0);
    std::vector<int> passes;
    std::vector<std::int64_t> uncovered;
    nlohmann::json report;
    friend bool same(const Picture& a, const Picture& b) {
      return a.depths == b.depths && a.colours == b.colours;
    }
  };

  Picture ask(const v1::RenderRequest& request) {
    Picture picture;
    const session::RenderJob job = world.collectively([&] {
      return render_job_of(
          request, [&](const std::string&) { return volume(); }, 1);
    });
    if (!drawn) drawn.emplace(world, volume());
    send_picture(
        world, job, request.visible().every_pass(),
        [&](const std::filesystem::path&) -> session::DrawnVolume& { return *drawn; },
        [&](const google::protobuf::Message& message) {
          const auto& reply = dynamic_cast<const v1::RenderReply&>(message);
          if (reply.has_tile()) put(reply.tile(), picture);
          if (reply.has_pass()) {
            picture.passes.push_back(reply.pass().pass());
            picture.uncovered.push_back(reply.pass().uncovered_pixels());
          }
          if (reply.has_done()) picture.report = nlohmann::json::parse(reply.done().report_json());
        },
        {});
    return picture;
  }
  static void put(const v1::Tile& tile, Picture& into) {
    ASSERT_LE(tile.rows(), 256);
    const std::size_t count = std::size_t{kWidth} * static_cast<std::size_t>(tile.rows());
    const auto depths = inflated<float>(tile.depths(), count);
    const auto colours = inflated<render::Rgba>(tile.colours(), count);
    ASSERT_EQ(depths.size(), count);
    ASSERT_EQ(colours.size(), count);
    const auto first = static_cast<std::ptrdiff_t>(kWidth) * tile.first_row();
    std::copy(depths.begin(), depths.end(), into.depths.begin() + first);
    std::copy(colours.begin(), colours.end(), into.colours.begin() + first);
  }
  // The same as a job of the command line.
  Picture by_job(const v1::RenderRequest& request) {
    session::RenderJob job = render_job_of(
        request, [&](const std::string&) { return volume(); }, 1);
    job.visible.reset();
    job.layer = path / "layer";
    job.result = path / "result.json";
    session::run_render(world, job, {});
    Picture picture;
    if (world.rank() != 0) return picture;
    const render::SurfaceLayer layer = render::SurfaceLayer::read(job.layer);
    for (int y = 0; y < kHeight; ++y) {
      const std::size_t at = static_cast<std::size_t>(y) * kWidth;
      layer.row(y, std::span(picture.depths).subspan(at, kWidth),
                std::span(picture.colours).subspan(at, kWidth));
    }
    return picture;
  }

  std::optional<session::DrawnVolume> drawn;
};

TEST_F(PictureStreamTest, IsThatOfTheCommandLineAndSoIsTheNext) {
  const v1::RenderRequest whole = request_of({100, 900});
  v1::RenderRequest visible = whole;
  visible.mutable_visible()->set_mode("depth");
  const Picture wanted = by_job(whole);
  const Picture first = ask(whole);
  const Picture second = ask(whole);
  const Picture seen = ask(visible);
  const Picture seen_again = ask(visible);
  if (world.rank() != 0) return;
  EXPECT_LT(std::count(wanted.depths.begin(), wanted.depths.end(), 1.0F), kWidth * kHeight);
  EXPECT_TRUE(same(first, wanted));
  EXPECT_TRUE(same(second, wanted));
  EXPECT_TRUE(same(seen, wanted));
  EXPECT_TRUE(same(seen_again, wanted));
  // The second was drawn with what the first made.
  EXPECT_GT(first.report["seconds"]["extract"], 0);
  EXPECT_EQ(second.report["seconds"]["extract"], 0);
}

TEST_F(PictureStreamTest, EveryPassIsShownWhenItIsAskedFor) {
  v1::RenderRequest request = request_of({100});
  request.mutable_visible()->set_every_pass(true);
  const Picture picture = ask(request);
  request.clear_visible();
  const Picture whole = ask(request);
  if (world.rank() != 0) return;
  ASSERT_FALSE(picture.passes.empty());
  EXPECT_EQ(picture.passes.front(), 1);
  EXPECT_EQ(picture.passes.size(), picture.report["isosurfaces"][0]["passes"].size());
  EXPECT_TRUE(std::is_sorted(picture.uncovered.rbegin(), picture.uncovered.rend()));
  EXPECT_EQ(picture.uncovered.back(), std::count(whole.depths.begin(), whole.depths.end(), 1.0F));
  EXPECT_TRUE(same(picture, whole));
}

TEST_F(PictureStreamTest, WhatIsNoPictureIsRefusedOnAllRanksAndTheNextIsDrawn) {
  const v1::RenderRequest good = request_of({100});
  const auto refused = [&](const std::function<void(v1::RenderRequest&)>& change) {
    v1::RenderRequest request = good;
    change(request);
    return code_of([&] { ask(request); });
  };
  EXPECT_EQ(refused([](auto& r) { r.set_width(0); }), ErrorCode::kUsage);
  EXPECT_EQ(refused([](auto& r) { r.set_height(2000000000); }), ErrorCode::kUsage);
  EXPECT_EQ(refused([](auto& r) { r.mutable_camera()->mutable_eye()->RemoveLast(); }), ErrorCode::kInvalid);
  EXPECT_EQ(refused([](auto& r) { r.mutable_isosurfaces(0)->mutable_placement()->set_shift(0, NAN); }),
            ErrorCode::kInvalid);
  EXPECT_EQ(refused([](auto& r) { r.mutable_isosurfaces(0)->set_value(NAN); }), ErrorCode::kUsage);
  EXPECT_EQ(refused([](auto& r) { r.clear_isosurfaces(); }), ErrorCode::kUsage);
  EXPECT_EQ(refused([](auto& r) { r.mutable_visible()->set_mode("x-ray"); }), ErrorCode::kUsage);
  const Picture picture = ask(good);
  EXPECT_EQ(picture.report.contains("isosurfaces"), world.rank() == 0);
}

}  // namespace
}  // namespace footwall::service
