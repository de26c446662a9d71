// The voxels of faces as CSV (RFC 4180): fault,face,i,j,k,inline,crossline,z,value, one row a voxel. Numbers
// are the shortest that read back the same; the value of a null is empty.
#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "storage/survey/box.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::voxels_csv {

struct Depth {
  double factor = 1;  // from the survey's vertical unit to that of the file
  bool up = false;    // z positive up
};

class Writer {
 public:
  // Throws kIo and what an output file throws.
  Writer(const std::filesystem::path& path, const survey::Geometry& survey, const Depth& depth);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  // The voxels of one face, indices in the survey; as many values.
  void add(const std::string& fault, const std::string& face, std::span<const survey::Index> voxels,
           std::span<const float> values);
  // Gives the file its name; without it there is none. Throws kIo.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::formats::voxels_csv
