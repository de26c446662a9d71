#include "ui/section/view_transform.h"

#include <QTest>
#include <cmath>

#include "ui/section/axes.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

survey::Geometry geometry_of(std::int64_t inlines, std::int64_t crosslines, std::int64_t samples) {
  survey::Geometry survey;
  survey.inlines = {100, 2, inlines};
  survey.crosslines = {300, 1, crosslines};
  survey.samples = samples;
  survey.z0 = 1000;
  survey.interval = 4;
  survey.map = {.per_inline_x = 0, .per_inline_y = 25, .per_crossline_x = 12.5, .per_crossline_y = 0};
  return survey;
}

bool is_near(double a, double b, double within = 1e-6) {
  return std::abs(a - b) <= within;
}

}  // namespace

class ViewTransformTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void keeps_the_proportions_of_the_world();
  void fits_the_whole_plane();
  void zooms_and_stretches_about_the_mouse();
  void slices_are_not_mirrored();
  void bears_one_sample_and_any_zoom();
  void ticks_are_round_and_apart();
  void polarity_is_said_in_words();
};

void ViewTransformTest::keeps_the_proportions_of_the_world() {
  const survey::Geometry survey = geometry_of(20, 30, 40);
  ViewTransform view;
  view.set_area({50, 20, 700, 500});
  view.set_frame(frame_of({.kind = Section::Kind::kInline, .index = 3}, survey, 0));
  view.fit(true);
  QCOMPARE(view.stretch(), 1.0);
  QVERIFY(is_near(view.pixels_per_u() / view.pixels_per_v(), 12.5 / 4));  // 1 ms as 1 m
  view.set_frame(frame_of({.kind = Section::Kind::kInline, .index = 3}, survey, 3000));
  QVERIFY(is_near(view.pixels_per_u() / view.pixels_per_v(), 12.5 / 6));
  view.set_frame(frame_of({.kind = Section::Kind::kSlice, .index = 3}, survey, 0));
  view.fit();
  QVERIFY(is_near(view.pixels_per_u() / view.pixels_per_v(), 12.5 / 25));
  const Section line{.kind = Section::Kind::kLine, .index = 0, .from = {0, 0, 0}, .to = {3, 4, 0}};
  QVERIFY(is_near(frame_of(line, survey, 0).metres_per_u, std::hypot(75, 50) / 5));
}

void ViewTransformTest::fits_the_whole_plane() {
  const survey::Geometry survey = geometry_of(20, 300, 40);
  for (const auto kind : {Section::Kind::kInline, Section::Kind::kCrossline, Section::Kind::kSlice}) {
    ViewTransform view;
    view.set_area({50, 20, 700, 500});
    view.set_frame(frame_of({.kind = kind}, survey, 0));
    const PlaneSize size = view.frame().size;
    const QRectF plane =
        QRectF(view.to_pixels({-0.5, -0.5}), view.to_pixels({size.width - 0.5, size.height - 0.5}))
            .normalized();
    QVERIFY(view.area().adjusted(-1e-6, -1e-6, 1e-6, 1e-6).contains(plane));
    QVERIFY(is_near(plane.width(), 700) || is_near(plane.height(), 500));
    // A vertical plane fills most of the view, by a factor that can be said.
    if (kind != Section::Kind::kSlice) QVERIFY(plane.width() * plane.height() > 0.6 * 700 * 500);
  }
}

void ViewTransformTest::zooms_and_stretches_about_the_mouse() {
  ViewTransform view;
  view.set_area({50, 20, 700, 500});
  view.set_frame(frame_of({.kind = Section::Kind::kInline}, geometry_of(20, 300, 200), 0));
  const QPointF mouse(300, 310);
  for (const double factor : {1.2, 3.0, 0.7, 1.9}) {
    const PlanePoint before = view.to_plane(mouse);
    const double scale = view.pixels_per_u();
    view.zoom(mouse, factor);
    QVERIFY(is_near(view.to_plane(mouse).u, before.u) && is_near(view.to_plane(mouse).v, before.v));
    QVERIFY(is_near(view.pixels_per_u(), scale * factor));
    view.stretch(mouse, factor);
    QVERIFY(is_near(view.to_plane(mouse).u, before.u) && is_near(view.to_plane(mouse).v, before.v));
    QVERIFY(is_near(view.pixels_per_u(), scale * factor));
  }
}

void ViewTransformTest::slices_are_not_mirrored() {
  survey::Geometry survey = geometry_of(20, 30, 40);  // crosslines to the east, inlines to the north
  QVERIFY(frame_of({.kind = Section::Kind::kSlice}, survey, 0).upward);
  survey.map.per_inline_y = -25;
  QVERIFY(!frame_of({.kind = Section::Kind::kSlice}, survey, 0).upward);
  QVERIFY(!frame_of({.kind = Section::Kind::kInline}, survey, 0).upward);
}

void ViewTransformTest::bears_one_sample_and_any_zoom() {
  ViewTransform view;
  view.set_area({50, 20, 700, 500});
  view.set_frame(frame_of({.kind = Section::Kind::kInline}, geometry_of(1, 1, 1), 0));
  for (int n = 0; n < 500; ++n) view.zoom({60, 30}, 1.7);
  for (int n = 0; n < 500; ++n) view.stretch({60, 30}, 1.7);
  for (int n = 0; n < 1000; ++n) view.pan({1000, -1000});
  QVERIFY(std::isfinite(view.to_plane({300, 300}).u) && std::isfinite(view.to_pixels({0, 0}).y()));
  for (int n = 0; n < 1500; ++n) view.zoom({60, 30}, 0.6);
  QVERIFY(view.pixels_per_u() > 0 && view.pixels_per_v() > 0);
  view.set_area({0, 0, 0, 0});
  view.fit();
  QVERIFY(view.pixels_per_u() > 0 && std::isfinite(view.pixels_per_v()));
}

void ViewTransformTest::ticks_are_round_and_apart() {
  const survey::Geometry survey = geometry_of(20, 30, 40);
  const AxisScale z = v_axis({.kind = Section::Kind::kInline}, survey);
  QCOMPARE(z.unit, QStringLiteral("ms"));
  const auto ticks = round_ticks(z, 0, 39, 10, 45);
  QCOMPARE(ticks.size(), std::size_t{8});  // 1000, 1020, ... 1140
  QCOMPARE(ticks[1].text, QStringLiteral("1020"));
  QVERIFY(is_near(ticks[1].coordinate, 5));
  // Between two lines there is no number, however near one looks.
  const AxisScale lines = u_axis({.kind = Section::Kind::kCrossline}, survey);
  for (const Tick& tick : round_ticks(lines, 3.2, 4.9, 1000, 45)) QVERIFY(!tick.text.contains(u'.'));
  for (const Tick& tick : round_ticks(z, 3.2, 3.3, 2000, 45))
    QVERIFY(is_near(tick.text.toDouble(), 1000 + 4 * tick.coordinate));
  QVERIFY(round_ticks(z, 0, NAN, 10, 45).empty());
  QCOMPARE(round_length(740), 500.0);
}

void ViewTransformTest::polarity_is_said_in_words() {
  SectionReader::VolumeFacts facts{.signed_values = true, .percentiles = std::vector<double>(101, 1)};
  const auto polarity = [&facts](const char* map, bool wiggles = false) {
    SampleLook look;
    look.colour_map = QLatin1String(map);
    return polarity_of(SampleColours(look, &facts), wiggles);
  };
  QCOMPARE(polarity("grey"), QStringLiteral("+ = white"));
  QCOMPARE(polarity("seismic"), QStringLiteral("+ = red"));
  QCOMPARE(polarity("red-white-blue"), QStringLiteral("+ = blue"));
  QCOMPARE(polarity("viridis"), QStringLiteral("+ = yellow"));
  QCOMPARE(polarity("grey", true), QStringLiteral("+ = filled"));
  facts.signed_values = false;  // of a distance, say
  QCOMPARE(polarity("grey"), QString());
}

static const RegisterTest<ViewTransformTest> kRegistered;

}  // namespace footwall::ui

#include "view_transform_test.moc"
