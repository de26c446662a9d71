// Between the messages of engine.proto and plain values. Whatever a stranger wrote into a message, these
// throw Error kInvalid that says what is wrong; they never read past an array, and take memory in proportion
// to the message.
#pragma once
#include <span>
#include <vector>

#include "engine/extract/face.h"
#include "engine/extract/face_changes.h"
#include "engine/service/engine.pb.h"
#include "storage/survey/box.h"

namespace footwall::service {

std::vector<extract::Face> faces_from(const v1::Faces& message);
v1::Faces message_of(std::span<const extract::Face> faces);
std::vector<extract::FaceIdentity> names_from(const v1::FaceNames& message);
v1::FaceNames message_of(std::span<const extract::FaceIdentity> names);
// The names of faces alone.
v1::FaceNames names_of(std::span<const extract::Face> faces);

struct NumberedFace {
  extract::FaceIdentity face;
  extract::FaceStatistics statistics;
};
std::vector<NumberedFace> numbers_from(const v1::FaceNumbers& message);
void append(const extract::FaceIdentity& face, const extract::FaceStatistics& statistics,
            v1::FaceNumbers& to);

survey::Box box_from(const v1::Box& message);
v1::Box message_of(const survey::Box& box);
survey::Index index_from(const v1::Index& message);
v1::Index message_of(const survey::Index& index);

// Names as requests give them: empty ones stand for the engine's own choice. threads: of each rank. Throws
// Error kUsage as extract::validate().
extract::Options options_from(const v1::ExtractOptions& message, int threads);

}  // namespace footwall::service
