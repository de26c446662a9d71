// The samples of a section as a picture of the view.
#pragma once
#include <QImage>
#include <QPainter>

#include "ui/model/sample_colours.h"
#include "ui/section/view_transform.h"

namespace footwall::ui {

// Whether to interpolate: as the look says, else where a sample covers at most 6 pixels both ways.
bool interpolates(const SampleLook& look, const ViewTransform& view, double pixel_ratio);

// Of view.area(), at pixel_ratio device pixels each. Texels, or bilinear where a sample covers more than a
// pixel and the mean of the samples of a pixel where it covers less. NaN and what lies outside the plane
// takes `nothing`.
QImage sample_image(const SectionSamples& samples, const SampleColours& colours, const ViewTransform& view,
                    double pixel_ratio, bool interpolate, QRgb nothing);

// Traces as curves, the positive lobes filled; as many as leave 6 pixels to each.
void draw_wiggles(QPainter& painter, const SectionSamples& samples, const SampleColours& colours,
                  const ViewTransform& view, const QColor& ink);

}  // namespace footwall::ui
