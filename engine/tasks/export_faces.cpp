#include "engine/tasks/export_faces.h"

#include "storage/base/error.h"
#include "storage/formats/faces_csv.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/vtp.h"

namespace footwall::tasks {

namespace {

std::string suffix_of(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  if (suffix != ".csv" && suffix != ".vtp" && suffix != ".ts") {
    throw Error(ErrorCode::kUsage, "no format of faces has the suffix '" + suffix + "'",
                "use .csv, .vtp or .ts");
  }
  return suffix;
}

}  // namespace

FacesExported export_faces(const project::Project& project, const std::filesystem::path& file,
                           const std::string& fault, std::optional<std::int64_t> run) {
  suffix_of(file);  // before the long work
  return write_faces(face_tables(project, fault, run, Coordinates::kWorld), file);
}

FacesExported write_faces(const FaceTables& faces, const std::filesystem::path& file) {
  const std::string suffix = suffix_of(file);
  if (faces.tables.empty()) {
    throw Error(ErrorCode::kInvalid, "there are no faces to export", "pick two pillars on a fault first");
  }
  FacesExported done;
  if (faces.run) done.run = faces.run->name;
  done.stale = faces.stale;
  done.faults = static_cast<std::int64_t>(faces.tables.size());
  for (const formats::MeshTable& table : faces.tables)
    done.faces += static_cast<std::int64_t>(table.triangles.size());
  if (suffix == ".vtp") {
    formats::vtp::Options how;
    how.z_axis = formats::vtp::ZAxis::kUp;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    how.crs = faces.crs;
    formats::vtp::write(file, faces.tables, how);
  } else if (suffix == ".ts") {
    formats::gocad_tsurf::WriteOptions how;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    done.renamed = formats::gocad_tsurf::write(file, faces.tables, how);
  } else {
    formats::faces_csv::write(
        file, faces.tables,
        formats::faces_csv::Declared{faces.units.horizontal, faces.units.vertical, false, faces.crs});
  }
  return done;
}

}  // namespace footwall::tasks
