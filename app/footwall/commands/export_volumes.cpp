// footwall export: volumes.
#include <fmt/format.h>

#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/export_volume.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

std::string order_text(const formats::raw::AxisOrder& order) {
  constexpr const char* kNames[] = {"inline", "crossline", "sample"};
  std::string text;
  for (const int axis : order) text += fmt::format("[{}]", kNames[axis]);
  return text;
}

}  // namespace

void ExportVolumes::add_to(CLI::App& command) {
  command.add_option("--volume", volume, "The volume to write (default: the first)");
  command.add_option("--raw", raw, "Samples as float32");
  command.add_option("--section", section,
                     "Raw: only this plane of the volume: inline=N, crossline=N or z=VALUE");
  command.add_option("--nrrd", nrrd, "Samples with their place in space, as NRRD (float32, raw)");
  command.add_option("--segy", segy, "SEG-Y, revision 1 where it can hold the volume, else 2.0");
  command.add_option("--vti", vti, "VTK XML ImageData for ParaView (z positive up)");
  command.add_option(
      "--axes", axes,
      "Raw, NRRD: axes from the slowest to the fastest; i inline, j crossline, k sample (raw ijk, "
      "NRRD kji)");
  command.add_option("--endian", endian, "Raw: byte order, big or little (default little)")
      ->check(CLI::IsMember({"big", "little"}));
  command.add_option("--segy-format", segy_format, "SEG-Y: samples as 5 IEEE float (default) or 1 IBM float")
      ->check(CLI::IsMember({1, 5}));
  command
      .add_option("--segy-holes", holes,
                  "SEG-Y: bins without a trace: skip (left out, default) or dead (zeros, marked dead)")
      ->check(CLI::IsMember({"skip", "dead"}));
  command.add_option("--segy-null", segy_null,
                     "SEG-Y: the value for nulls in live traces (default NaN; 0 in IBM float)");
}

void ExportVolumes::run(const project::Project& project, const ExportChoice& choice,
                        const console::Console& console, console::Output& output) const {
  const int files = !raw.empty() + !nrrd.empty() + !segy.empty() + !vti.empty();
  int started = 0;
  const auto next_part = [&] {
    const double from = static_cast<double>(started) / files;
    return console.job().part(from, static_cast<double>(++started) / files);
  };
  if (!section.empty()) {
    if (raw.empty() || !axes.empty())
      throw Error(ErrorCode::kUsage, "--section goes with --raw, without --axes");
    const tasks::RawSection done =
        tasks::export_raw_section(project, volume, section, raw, endian == "big", next_part());
    add_file(output, raw);
    output.json["section"] = {{"axis", done.axis}, {"index", done.index}, {"dims", done.dims}};
  } else if (!raw.empty()) {
    formats::raw::WriteOptions how;
    if (!axes.empty()) how.order = formats::raw::axis_order_from(axes);
    how.big_endian = endian == "big";
    const std::int64_t samples = tasks::export_raw(project, volume, raw, how, next_part());
    output.json["files"].push_back(raw);
    output.json["samples"] = samples;
    output.text += fmt::format("written {}: {} float32 samples, {}-endian, {}\n", raw, samples,
                               how.big_endian ? "big" : "little", order_text(how.order));
  }
  if (!nrrd.empty()) {
    const auto order = formats::raw::axis_order_from(axes.empty() ? "kji" : axes);
    tasks::export_nrrd(project, volume, nrrd, order, next_part());
    add_file(output, nrrd);
  }
  if (!segy.empty()) {
    tasks::SegyExport how;
    how.format = segy_format;
    how.holes = holes == "dead" ? formats::segy::Holes::kDead : formats::segy::Holes::kSkip;
    how.null_value = segy_null;
    const formats::segy::Written written = tasks::export_segy(project, volume, segy, how, next_part());
    output.json["files"].push_back(segy);
    output.json["segy"] = {{"traces", written.traces},     {"dead_traces", written.dead},
                           {"skipped", written.skipped},   {"nulls", written.nulls},
                           {"revision", written.revision}, {"coordinate_scalar", written.coordinate_scalar},
                           {"notes", written.notes}};
    output.text += fmt::format("written {}: {} traces, {} bins without a trace left out\n", segy,
                               written.traces, written.skipped);
    for (const std::string& note : written.notes) log::warn(note);
  }
  if (!vti.empty()) {
    tasks::export_vti(project, volume, vti, choice.z_up(true), next_part());
    add_file(output, vti);
  }
}

}  // namespace footwall::commands
