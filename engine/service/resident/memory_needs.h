// What calls take of a rank's memory, estimated before they begin: bytes of one face, one triangle, one
// pixel. Plain arithmetic; measured where it says so in the source.
#pragma once
#include <cstdint>

#include "engine/isosurface/extract.h"

namespace footwall::v1 {
class EditBatch;
}

namespace footwall::service {

// Estimates below this are not worth asking all ranks for what is free: an edit under way must be quick.
inline constexpr std::int64_t kWorthAsking = std::int64_t{1} << 20;

// The model, which every rank has whole.
std::int64_t model_bytes(std::int64_t faces);
// An edit while it is made: new faces, those that are replaced for the case of failure, names of touched
// ones.
std::int64_t edit_bytes(const v1::EditBatch& batch, std::int64_t faces_of_model);
// An extraction of so many faces: what stays to know them next time, and what passes.
std::int64_t extraction_stays(std::int64_t faces);
std::int64_t extraction_passes(std::int64_t faces);

// About how many triangles an isosurface has: the bricks that it crosses, by the min/max table.
std::int64_t expected_triangles(const isosurface::Bricks& bricks, float isovalue);
// This rank's share of extracting that many, with the samples that are read for it; of having them; of
// welding and collecting them to be sent.
std::int64_t surface_extraction_bytes(std::int64_t triangles, const survey::Index& dims, int ranks);
std::int64_t surface_sending_bytes(std::int64_t triangles, int ranks);
// Drawing them in a picture: pixels on every rank; tiles on rank 0.
std::int64_t picture_bytes(std::int64_t triangles, std::int64_t pixels, int rank, int ranks);
// A rank's samples for pictures of what can be seen.
std::int64_t visible_sample_bytes(const survey::Index& dims, int ranks);

}  // namespace footwall::service
