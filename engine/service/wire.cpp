#include "engine/service/wire.h"

#include <fmt/format.h>

#include "engine/extract/registry.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr std::size_t kCorners = 9;

Error uneven(std::string_view what) {
  return {ErrorCode::kInvalid, fmt::format("{} have arrays of different lengths", what),
          "give one entry for each face"};
}

template <class Message>
std::size_t count_of(const Message& message, std::string_view what) {
  const int count = message.faults_size();
  if (message.owners_size() != count || message.numbers_size() != count) throw uneven(what);
  return static_cast<std::size_t>(count);
}

template <class Message>
extract::FaceIdentity name_at(const Message& message, std::size_t n) {
  const int at = static_cast<int>(n);
  return {message.faults(at), message.owners(at), message.numbers(at)};
}

template <class Message>
void append_name(const extract::FaceIdentity& name, Message& to) {
  to.add_faults(name.fault);
  to.add_owners(name.owner);
  to.add_numbers(name.n);
}

}  // namespace

std::vector<extract::Face> faces_from(const v1::Faces& message) {
  const std::size_t count = count_of(message, "faces");
  if (static_cast<std::size_t>(message.corners_size()) != kCorners * count) throw uneven("faces");
  std::vector<extract::Face> faces(count);
  for (std::size_t n = 0; n < count; ++n) {
    const extract::FaceIdentity name = name_at(message, n);
    faces[n] = {name.fault, name.owner, name.n, {}};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const int at = static_cast<int>(kCorners * n + 3 * corner);
      faces[n].triangle[corner] = {message.corners(at), message.corners(at + 1), message.corners(at + 2)};
    }
  }
  return faces;
}

v1::Faces message_of(std::span<const extract::Face> faces) {
  v1::Faces message;
  message.mutable_corners()->Reserve(static_cast<int>(kCorners * faces.size()));
  for (const extract::Face& face : faces) {
    append_name(extract::identity_of(face), message);
    for (const survey::LatticePoint& corner : face.triangle) {
      for (const std::int32_t place : {corner.i, corner.j, corner.k}) message.add_corners(place);
    }
  }
  return message;
}

std::vector<extract::FaceIdentity> names_from(const v1::FaceNames& message) {
  std::vector<extract::FaceIdentity> names(count_of(message, "names of faces"));
  for (std::size_t n = 0; n < names.size(); ++n) names[n] = name_at(message, n);
  return names;
}

v1::FaceNames message_of(std::span<const extract::FaceIdentity> names) {
  v1::FaceNames message;
  for (const extract::FaceIdentity& name : names) append_name(name, message);
  return message;
}

v1::FaceNames names_of(std::span<const extract::Face> faces) {
  v1::FaceNames message;
  for (const extract::Face& face : faces) append_name(extract::identity_of(face), message);
  return message;
}

std::vector<NumberedFace> numbers_from(const v1::FaceNumbers& message) {
  std::vector<NumberedFace> all(count_of(message.faces(), "numbers of faces"));
  for (const int size :
       {message.count_size(), message.nulls_size(), message.outside_size(), message.mean_size(),
        message.variance_size(), message.min_size(), message.max_size(), message.discontinuity_size(),
        message.contrast_size(), message.offset_voxels_size(), message.offset_score_size()}) {
    if (static_cast<std::size_t>(size) != all.size()) throw uneven("numbers of faces");
  }
  for (std::size_t n = 0; n < all.size(); ++n) {
    const int at = static_cast<int>(n);
    const int outside = message.outside(at);
    if (outside < 0 || outside > static_cast<int>(extract::Outside::kWholly))
      throw Error(ErrorCode::kInvalid, fmt::format("a face is {} outside", outside), "0, 1 or 2 it can be");
    all[n] = {name_at(message.faces(), n),
              {message.count(at), message.nulls(at), static_cast<extract::Outside>(outside), message.mean(at),
               message.variance(at), message.min(at), message.max(at), message.discontinuity(at),
               message.contrast(at), message.offset_voxels(at), message.offset_score(at)}};
  }
  return all;
}

void append(const extract::FaceIdentity& face, const extract::FaceStatistics& statistics,
            v1::FaceNumbers& to) {
  append_name(face, *to.mutable_faces());
  to.add_count(statistics.count);
  to.add_nulls(statistics.nulls);
  to.add_outside(static_cast<int>(statistics.outside));
  to.add_mean(statistics.mean);
  to.add_variance(statistics.variance);
  to.add_min(statistics.min);
  to.add_max(statistics.max);
  to.add_discontinuity(statistics.discontinuity);
  to.add_contrast(statistics.contrast);
  to.add_offset_voxels(statistics.offset_voxels);
  to.add_offset_score(statistics.offset_score);
}

survey::Index index_from(const v1::Index& message) {
  return {message.i(), message.j(), message.k()};
}

v1::Index message_of(const survey::Index& index) {
  v1::Index message;
  message.set_i(index[0]);
  message.set_j(index[1]);
  message.set_k(index[2]);
  return message;
}

survey::Box box_from(const v1::Box& message) {
  return {index_from(message.lo()), index_from(message.hi())};
}

v1::Box message_of(const survey::Box& box) {
  v1::Box message;
  *message.mutable_lo() = message_of(box.lo);
  *message.mutable_hi() = message_of(box.hi);
  return message;
}

extract::Options options_from(const v1::ExtractOptions& message, int threads) {
  extract::Options options;
  if (!message.exchange().empty()) options.exchange = message.exchange();
  if (!message.balance().empty()) options.balance = message.balance();
  if (!message.voxelizer().empty()) options.voxelizer = message.voxelizer();
  options.compute = {message.compute().begin(), message.compute().end()};
  if (options.compute.empty()) options.compute = extract::usual_computations();
  options.threads = threads;
  extract::validate(options);
  return options;
}

}  // namespace footwall::service
