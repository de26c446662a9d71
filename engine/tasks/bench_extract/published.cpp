// Source: Leif Christian Larsen, "Framework for polygonal structures computations on clusters", master's
// thesis (seed 004), appendix F.1 and F.2. Tables 5.1 to 5.3 of its text repeat F.1 to F.3 as speedups, with
// misprints of their own: in 5.1 MC-nolb at 2 CPUs is 0.83, not 0.33, and MC-globalb 0.85, not 0.72.
#include "engine/tasks/bench_extract/published.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

// Table F.1.
constexpr std::array kSeconds1{
    PublishedRow{"MC-nolb", "minimum", "none", {43.83, 35.49, 32.75, 24.14, 15.24, 8.67, 5.84, 3.29}},
    PublishedRow{"BT-nolb", "block=2", "none", {53.54, 45.19, 53.87, 38.22, 26.76, 16.29, 11.84, 6.88}},
    PublishedRow{"BV-nolb", "bounding", "none", {42.74, 35.29, 35.75, 23.68, 14.67, 32.09, 59.55, 25.33}},
    PublishedRow{"MC-globalb", "minimum", "global=0", {42.92, 22.46, 13.58, 6.65, 4.20, 2.52, 1.65, 1.08}},
    PublishedRow{"BT-globalb", "block=2", "global=0", {53.07, 45.37, 30.95, 14.61, 9.80, 6.16, 4.39, 2.51}},
    PublishedRow{
        "BV-globalb", "bounding", "global=0", {42.58, 26.81, 18.94, 11.90, 6.62, 13.30, 16.23, 7.63}},
    PublishedRow{"MC-localb", "minimum", "local=0", {44.38, 20.81, 14.16, 6.26, 3.37, 1.83, 1.28, 1.00}},
    PublishedRow{"BT-localb", "block=2", "local=0", {83.61, 41.82, 31.81, 13.53, 7.76, 4.47, 3.30, 2.31}},
    PublishedRow{"BV-localb", "bounding", "local=0", {42.85, 26.71, 20.56, 11.68, 5.79, 15.46, 10.34, 6.59}},
    PublishedRow{
        "MC-mhlb-inf", "minimum", "manhattan=0", {43.10, 21.08, 13.62, 6.71, 4.26, 2.52, 1.64, 1.06}},
    PublishedRow{
        "BT-mhlb-inf", "block=2", "manhattan=0", {53.10, 42.73, 31.44, 12.90, 7.97, 5.15, 3.82, 2.42}},
    PublishedRow{
        "BV-mhlb-inf", "bounding", "manhattan=0", {42.65, 26.23, 18.62, 11.89, 6.67, 13.59, 16.48, 7.83}},
    PublishedRow{
        "MC-mhlb-2", "minimum", "manhattan=0,2", {43.34, 21.32, 14.37, 14.54, 13.17, 8.99, 5.77, 3.29}},
    PublishedRow{
        "BT-mhlb-2", "block=2", "manhattan=0,2", {53.31, 42.97, 31.07, 23.50, 23.54, 16.99, 11.79, 6.93}},
    PublishedRow{
        "BV-mhlb-2", "bounding", "manhattan=0,2", {41.98, 24.87, 21.56, 15.05, 13.10, 25.07, 57.73, 25.01}}};

// Table F.2.
constexpr std::array kSeconds2{
    PublishedRow{"MC-nolb", "minimum", "none", {122.20, 119.63, 83.27, 63.82, 60.92, 44.77, 26.18, 16.71}},
    PublishedRow{"BT-nolb", "block=2", "none", {133.40, 128.34, 104.17, 83.21, 100.12, 73.29, 45.28, 30.20}},
    PublishedRow{"BV-nolb", "bounding", "none", {126.00, 114.96, 91.71, 72.22, 77.45, 50.99, 130.09, 190.45}},
    PublishedRow{
        "MC-globalb", "minimum", "global=0", {287.70, 103.25, 39.84, 18.80, 16.16, 12.13, 7.44, 4.81}},
    PublishedRow{
        "BT-globalb", "block=2", "global=0", {622.31, 217.24, 86.52, 47.21, 35.05, 21.77, 13.91, 9.58}},
    PublishedRow{
        "BV-globalb", "bounding", "global=0", {450.39, 156.84, 79.86, 54.87, 42.59, 108.20, 43.74, 52.98}},
    PublishedRow{"MC-localb", "minimum", "local=0", {109.87, 100.05, 97.88, 44.30, 29.48, 13.03, 6.10, 3.56}},
    PublishedRow{
        "BT-localb", "block=2", "local=0", {112.99, 99.46, 177.12, 87.90, 63.94, 27.91, 14.11, 8.48}},
    PublishedRow{
        "BV-localb", "bounding", "local=0", {124.95, 121.27, 130.54, 65.85, 48.57, 76.36, 98.93, 40.08}},
    PublishedRow{
        "MC-mhlb-inf", "minimum", "manhattan=0", {286.56, 109.26, 39.92, 19.20, 15.74, 12.24, 7.42, 4.77}},
    PublishedRow{
        "BT-mhlb-inf", "block=2", "manhattan=0", {618.33, 208.58, 86.30, 38.96, 28.19, 21.08, 13.79, 9.62}},
    PublishedRow{"BV-mhlb-inf",
                 "bounding",
                 "manhattan=0",
                 {450.41, 157.70, 79.92, 52.56, 43.26, 100.73, 44.85, 52.67}},
    PublishedRow{
        "MC-mhlb-2", "minimum", "manhattan=0,2", {280.49, 102.25, 43.43, 49.15, 57.04, 44.79, 26.41, 16.70}},
    PublishedRow{
        "BT-mhlb-2", "block=2", "manhattan=0,2", {627.25, 211.31, 79.95, 64.73, 94.44, 73.74, 45.62, 30.82}},
    PublishedRow{"BV-mhlb-2",
                 "bounding",
                 "manhattan=0,2",
                 {445.73, 140.89, 82.27, 62.85, 73.67, 68.68, 115.92, 29.63}}};

// Table F.3. Its last three rows are printed as MC, MC, MH; they are MC, BT, BV.
constexpr std::array kSeconds3{
    PublishedRow{"MC-nolb", "minimum", "none", {191.90, 190.64, 181.05, 169.92, 125.31, 88.21, 85.75, 67.04}},
    PublishedRow{
        "BT-nolb", "block=2", "none", {199.87, 198.03, 196.39, 191.37, 153.97, 116.12, 138.28, 110.95}},
    PublishedRow{
        "BV-nolb", "bounding", "none", {227.01, 226.87, 223.31, 204.89, 176.81, 126.49, 499.26, -750}},
    PublishedRow{
        "MC-globalb", "minimum", "global=0", {493.34, 215.86, 87.55, 54.91, 37.54, 25.98, 22.53, 18.52}},
    PublishedRow{
        "BT-globalb", "block=2", "global=0", {1154.89, 534.35, 208.59, 131.52, 52.71, 34.46, 36.85, 31.03}},
    PublishedRow{"BV-globalb",
                 "bounding",
                 "global=0",
                 {1599.07, 864.49, 381.64, 297.55, 176.43, 481.23, 509.44, 183.32}},
    PublishedRow{
        "MC-localb", "minimum", "local=0", {190.25, 188.14, 160.80, 145.04, 153.54, 64.14, 39.62, 18.95}},
    PublishedRow{
        "BT-localb", "block=2", "local=0", {190.99, 187.46, 163.97, 146.32, 281.08, 123.25, 85.64, 40.29}},
    PublishedRow{
        "BV-localb", "bounding", "local=0", {285.72, 277.87, 302.69, 246.95, 266.33, 138.18, 581.77, 455.56}},
    PublishedRow{
        "MC-mhlb-inf", "minimum", "manhattan=0", {498.49, 220.99, 89.34, 54.34, 37.30, 25.79, 22.90, 18.46}},
    PublishedRow{"BT-mhlb-inf",
                 "block=2",
                 "manhattan=0",
                 {1155.67, 524.71, 203.60, 106.46, 51.87, 34.92, 36.82, 30.84}},
    PublishedRow{"BV-mhlb-inf",
                 "bounding",
                 "manhattan=0",
                 {1613.38, 825.17, 393.35, 301.93, 169.23, 476.98, 512.50, 183.72}},
    PublishedRow{"MC-mhlb-2",
                 "minimum",
                 "manhattan=0,2",
                 {499.85, 219.66, 102.25, 132.83, 112.56, 87.98, 83.49, 66.35}},
    PublishedRow{"BT-mhlb-2",
                 "block=2",
                 "manhattan=0,2",
                 {1141.40, 527.74, 197.18, 153.84, 140.28, 115.83, 136.65, 110.05}},
    PublishedRow{"BV-mhlb-2",
                 "bounding",
                 "manhattan=0,2",
                 {1585.46, 828.54, 368.57, 225.41, 176.42, 188.80, 547.48, -750}}};

// Table F.4.
constexpr std::array kDeviations{
    PublishedRow{"None", "", "none", {4035741, 2795743, 1409932, 764145, 440201, 255620, 134062, 70636}},
    PublishedRow{"Global", "", "global=0", {59952, 54850, 138740, 121864, 81925, 53437, 28854, 15577}},
    PublishedRow{"Local", "", "local=0", {3221577, 2259919, 1062365, 520218, 264423, 136158, 68542, 34525}},
    PublishedRow{
        "Manhattan, inf", "", "manhattan=0", {59952, 54951, 161597, 139445, 90575, 58135, 31003, 16763}},
    PublishedRow{
        "Manhattan, 2", "", "manhattan=0,2", {59952, 54951, 549288, 536090, 383139, 245467, 129715, 68884}}};

// The first rows of F.1 to F.3.
constexpr std::array kSerialSeconds{36.39, 86.99, 133.57};

}  // namespace

std::span<const PublishedRow> published_seconds(int benchmark) {
  switch (benchmark) {
    case 1:
      return kSeconds1;
    case 2:
      return kSeconds2;
    case 3:
      return kSeconds3;
    default:
      break;
  }
  require(false, "one of the seed's benchmarks");
  return {};
}

double published_serial_seconds(int benchmark) {
  require(benchmark >= 1 && benchmark <= 3, "one of the seed's benchmarks");
  return kSerialSeconds[static_cast<std::size_t>(benchmark - 1)];
}

std::span<const PublishedRow> published_deviations() {
  return kDeviations;
}

const double* published_value(const PublishedRow& row, int ranks) {
  const auto* const column = std::find(kPublishedRanks.begin(), kPublishedRanks.end(), ranks);
  return column == kPublishedRanks.end()
             ? nullptr
             : &row.values[static_cast<std::size_t>(column - kPublishedRanks.begin())];
}

}  // namespace footwall::tasks
