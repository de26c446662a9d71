// Pictures of views against those that were once looked at and found right (tests/ui/baselines).
// CONTRIBUTING.md tells how to make them anew.
#pragma once
#include <QImage>
#include <QString>

namespace footwall::ui {

// How different two pictures look: colours in CIE Lab, averaged over blocks of 4 x 4 pixels, so that smoothed
// edges and the grain of a font hardly count.
struct ImageDifference {
  static constexpr double kSeen = 6;           // of Lab, by which a block looks different
  static constexpr double kMostBlocks = 0.01;  // share of the blocks that may

  double share = 1;    // of the blocks that look different
  double largest = 0;  // of Lab
  QImage picture;      // grey where alike, red by how different
  bool is_small() const { return share <= kMostBlocks; }
};
// Of pictures of different sizes: all of it.
ImageDifference difference_of(const QImage& a, const QImage& b);

// Empty where the picture looks like the baseline of this name; else what to look at: the picture and the
// difference are written to the build folder then. With FOOTWALL_MAKE_BASELINES set, the picture becomes the
// baseline.
QString compare_with_baseline(const QImage& picture, const QString& name);

}  // namespace footwall::ui
