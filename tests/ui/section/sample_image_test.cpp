#include "ui/section/sample_image.h"

#include <QTest>
#include <cmath>
#include <limits>

#include "ui/test_class.h"

namespace footwall::ui {
namespace {

constexpr QRgb kNothing = 0xff123456;

SectionSamples samples_of(int columns, int rows, const std::function<float(int, int)>& value) {
  SectionSamples samples{.volume = 1, .section = {}, .columns = columns, .rows = rows, .values = {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) samples.values.push_back(value(column, row));
  }
  return samples;
}

ViewTransform view_of(int columns, int rows, double width, double height) {
  ViewTransform view;
  view.set_area({0, 0, width, height});
  view.set_frame({.size = {static_cast<double>(columns), static_cast<double>(rows)},
                  .metres_per_u = 1,
                  .metres_per_v = 1,
                  .upward = false,
                  .vertical = false});
  view.fit();
  return view;
}

SampleColours grey(double most) {
  SectionReader::VolumeFacts facts;
  facts.max_abs = most;
  facts.percentiles.assign(101, most);
  return {SampleLook{}, &facts};
}

}  // namespace

class SampleImageTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void texels_are_the_samples();
  void interpolates_between_samples();
  void a_pixel_of_many_samples_is_their_mean();
  void nothing_where_there_is_no_sample();
  void interpolates_up_to_six_pixels();
  void clips_and_gains();
  void draws_filled_wiggles();
};

void SampleImageTest::texels_are_the_samples() {
  const auto value = [](int column, int row) { return static_cast<float>((column * 7 + row * 3) % 11 - 5); };
  const SectionSamples samples = samples_of(5, 4, value);
  const SampleColours colours = grey(5);
  for (const double ratio : {1.0, 2.0}) {
    const QImage image = sample_image(samples, colours, view_of(5, 4, 100, 80), ratio, false, kNothing);
    QCOMPARE(image.size(), QSize(static_cast<int>(100 * ratio), static_cast<int>(80 * ratio)));
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const auto texel = static_cast<int>(20 * ratio);
        QCOMPARE(image.pixel(x, y), colours.colour_of(value(x / texel, y / texel)));
      }
    }
  }
  QCOMPARE(qRed(colours.colour_of(-5)), qBlue(colours.colour_of(-5)));
  QVERIFY(qRed(colours.colour_of(-5)) < qRed(colours.colour_of(5)));
}

void SampleImageTest::interpolates_between_samples() {
  const SectionSamples samples =
      samples_of(4, 3, [](int column, int row) { return static_cast<float>(column + 10 * row); });
  const SampleColours colours = grey(40);
  const ViewTransform view = view_of(4, 3, 400, 300);
  const QImage image = sample_image(samples, colours, view, 1, true, kNothing);
  for (int y = 60; y < 240; y += 7) {
    for (int x = 60; x < 340; x += 7) {
      const PlanePoint p = view.to_plane({x + 0.5, y + 0.5});
      const int expected = colours.place_of(static_cast<float>(p.u + 10 * p.v));
      const QRgb low = colours.table()[static_cast<std::size_t>(std::max(expected - 1, 0))];
      const QRgb high = colours.table()[static_cast<std::size_t>(std::min(expected + 1, 255))];
      QVERIFY(qRed(image.pixel(x, y)) >= qRed(low) && qRed(image.pixel(x, y)) <= qRed(high));
    }
  }
}

void SampleImageTest::a_pixel_of_many_samples_is_their_mean() {
  // +1 and -1 in turn: any single sample would be black or white.
  const SectionSamples samples =
      samples_of(400, 400, [](int column, int row) { return (column + row) % 2 == 0 ? 1.0F : -1.0F; });
  const SampleColours colours = grey(1);
  const QImage image = sample_image(samples, colours, view_of(400, 400, 50, 50), 1, true, kNothing);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 50; ++x) QVERIFY(std::abs(qRed(image.pixel(x, y)) - qRed(colours.colour_of(0))) <= 2);
  }
}

void SampleImageTest::nothing_where_there_is_no_sample() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const SectionSamples samples = samples_of(4, 4, [&](int column, int) { return column == 1 ? nan : 0.0F; });
  for (const bool interpolate : {false, true}) {
    const QImage image = sample_image(samples, grey(1), view_of(4, 4, 200, 80), 1, interpolate, kNothing);
    QCOMPARE(image.pixel(1, 1), kNothing);  // left of the plane
    QCOMPARE(image.pixel(90, 40), kNothing);
    QVERIFY(image.pixel(130, 40) != kNothing);
  }
  const QImage single = sample_image(samples_of(1, 1, [](int, int) { return 1.0F; }), grey(1),
                                     view_of(1, 1, 9, 9), 1, true, kNothing);
  QVERIFY(single.pixel(4, 4) != kNothing);
  const QImage empty = sample_image(samples_of(1, 1, [&](int, int) { return nan; }), grey(1),
                                    view_of(1, 1, 9, 9), 1, true, kNothing);
  QCOMPARE(empty.pixel(4, 4), kNothing);
}

void SampleImageTest::interpolates_up_to_six_pixels() {
  SampleLook look;
  QVERIFY(interpolates(look, view_of(100, 100, 500, 500), 1));
  QVERIFY(!interpolates(look, view_of(100, 100, 700, 700), 1));
  QVERIFY(!interpolates(look, view_of(100, 100, 400, 400), 2));
  look.interpolate = false;
  QVERIFY(!interpolates(look, view_of(100, 100, 50, 50), 1));
}

void SampleImageTest::clips_and_gains() {
  SectionReader::VolumeFacts facts;
  facts.max_abs = 100;
  for (int p = 0; p <= 100; ++p) facts.percentiles.push_back(p);
  SampleLook look;
  look.clip_percentile = 90;
  look.gain = 2;
  const SampleColours both(look, &facts);
  QCOMPARE(both.low(), -45.0);
  QCOMPARE(both.high(), 45.0);
  facts.signed_values = false;
  look.clip_percentile = 98;
  look.gain = 1;
  const SampleColours positive(look, &facts);
  QCOMPARE(positive.low(), 2.0);
  QCOMPARE(positive.high(), 98.0);
  facts.percentiles.assign(101, 7);
  const SampleColours flat({}, &facts);
  QVERIFY(flat.high() > flat.low());
  QVERIFY(std::abs(flat.place_of(7) - 128) <= 1);
  QCOMPARE(flat.place_of(std::numeric_limits<float>::max()), 255);
}

void SampleImageTest::draws_filled_wiggles() {
  const SectionSamples samples =
      samples_of(1, 64, [](int, int row) { return static_cast<float>(std::sin(row * 0.4)); });
  QImage image(300, 300, QImage::Format_RGB32);
  image.fill(Qt::white);
  {
    QPainter painter(&image);
    ViewTransform view = view_of(1, 64, 300, 300);
    view.set_frame(
        {.size = {1, 64}, .metres_per_u = 60, .metres_per_v = 1, .upward = false, .vertical = true});
    view.fit();
    draw_wiggles(painter, samples, grey(1), view, Qt::black);
  }
  int right = 0, left = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) (x >= 150 ? right : left) += qRed(image.pixel(x, y)) < 128 ? 1 : 0;
  }
  QVERIFY(left > 100);
  QVERIFY(right > 3 * left);
}

static const RegisterTest<SampleImageTest> kRegistered;

}  // namespace footwall::ui

#include "sample_image_test.moc"
